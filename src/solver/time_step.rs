use super::SolverError;
use crate::forces::{ForceError, Forces};
use crate::integrator::stability_limit;
use crate::state::State;

/// How the time step is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TimeStep {
    /// This fraction of the stability limit; made shorter if the specimen stiffens.
    Auto { fraction: f64 },
    /// ps; refused above the limit.
    Given(f64),
}

/// Steps between looks at the stability limit.
pub const CHECK_EVERY: u64 = 100;

/// How near to the limit an automatic time step may come before it is made shorter.
const NEAREST: f64 = 0.75;

/// Stability limit in the current state, ps.
pub fn limit(forces: &mut Forces, state: &State) -> Result<f64, ForceError> {
    let bound = forces.squared_frequency_bound(state)?;
    Ok(stability_limit(bound))
}

impl TimeStep {
    /// The time step at the start.
    pub fn choose(self, limit: f64) -> Result<f64, SolverError> {
        match self {
            Self::Auto { fraction } => Ok(fraction * limit),
            Self::Given(given) if given > limit => Err(SolverError::StepTooLong { given, limit }),
            Self::Given(given) => Ok(given),
        }
    }

    /// The time step from here on, never longer than before.
    pub fn adapt(self, present: f64, limit: f64) -> f64 {
        match self {
            Self::Auto { fraction } if present > NEAREST.max(fraction) * limit => fraction * limit,
            Self::Auto { .. } | Self::Given(_) => present,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_given_step_above_the_limit_is_refused_and_an_automatic_one_only_shrinks() {
        let refused = TimeStep::Given(0.2).choose(0.1);
        assert_eq!(refused, Err(SolverError::StepTooLong { given: 0.2, limit: 0.1 }));
        let auto = TimeStep::Auto { fraction: 0.75 };
        assert_eq!(auto.choose(8.0), Ok(6.0));
        assert_eq!(auto.adapt(6.0, 16.0), 6.0);
        assert_eq!(auto.adapt(6.0, 8.0), 6.0);
        assert_eq!(auto.adapt(6.0, 4.0), 3.0);
    }
}
