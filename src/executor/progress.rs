use std::fmt;

use serde::{Deserialize, Serialize};

/// How far a case is: one JSON object a line on the standard output of the solver.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    pub step: u64,
    /// Steps in all, if the case runs to its last limit.
    pub of: u64,
    pub time_ps: f64,
    /// Nominal strain.
    pub strain: f64,
    /// Foremost crack tip from the left edge, nm; `None` without a crack.
    pub tip_nm: Option<f64>,
    /// While the specimen comes to rest: the largest force left on a node, over the strength of a bond.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub residual: Option<f64>,
    pub percent: f64,
}

impl fmt::Display for Progress {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if let Some(residual) = self.residual {
            return write!(f, "coming to rest: forces down to {residual:.0e} of a bond's strength");
        }
        write!(f, "strain {:.3} %", 100.0 * self.strain)?;
        if let Some(tip) = self.tip_nm {
            write!(f, "  tip {tip:.1} nm")?;
        }
        write!(f, "  step {}/{}", self.step, self.of)
    }
}

impl Progress {
    /// A line of the solver's output; `None` if it is something else.
    pub fn parse(line: &str) -> Option<Progress> {
        serde_json::from_str(line).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_progress_line_reads_back_as_it_was_written() {
        let progress = Progress {
            step: 7,
            of: 10,
            time_ps: 0.1,
            strain: 0.01,
            tip_nm: None,
            residual: None,
            percent: 70.0,
        };
        assert_eq!(
            Progress::parse(&serde_json::to_string(&progress).unwrap()),
            Some(progress)
        );
    }

    #[test]
    fn other_output_is_not_taken_for_progress() {
        assert_eq!(Progress::parse("reading the mesh"), None);
        assert_eq!(Progress::parse(r#"{"step": 3}"#), None);
    }
}
