//! When a run has reached its end.

use super::clock::Clock;

/// A run stops at whichever of these comes first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Until {
    /// Nominal strain.
    pub strain: Option<f64>,
    /// ps
    pub time: Option<f64>,
    /// From the edge that the crack comes from, or the middle of a notch inside, to the foremost tip, nm.
    pub crack_length: Option<f64>,
    /// The crack has set out and then stood still for this long, ps.
    pub arrest: Option<f64>,
    /// The crack was first seen to have a branch so long ago, ps.
    pub after_branch: Option<f64>,
    /// The crack has left its plane so long ago, ps.
    pub leaves_plane: Option<f64>,
}

/// Why a run ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ending {
    Strain(f64),
    Time(f64),
    CrackLength(f64),
    Arrest(f64),
    AfterBranch(f64),
    LeavesPlane(f64),
    /// Asked to stop; a checkpoint is there.
    Interrupted,
}

impl std::fmt::Display for Ending {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Self::Strain(strain) => write!(f, "strain {:.4} % reached", 100.0 * strain),
            Self::Time(time) => write!(f, "time {time:.4} ps reached"),
            Self::CrackLength(tip) => write!(f, "crack length {tip:.3} nm reached"),
            Self::Arrest(time) => write!(f, "crack stood still for {time:.3} ps"),
            Self::AfterBranch(time) => write!(f, "crack branched {time:.3} ps ago"),
            Self::LeavesPlane(time) => write!(f, "crack left its plane {time:.3} ps ago"),
            Self::Interrupted => write!(f, "interrupted"),
        }
    }
}

impl Until {
    /// Steps in all if neither the crack nor a change of the time step ends the run otherwise.
    ///
    /// `time_of` tells when a nominal strain is reached, ps.
    pub fn steps(&self, step: u64, time: f64, time_step: f64, time_of: impl FnOnce(f64) -> f64) -> u64 {
        let end = self
            .strain
            .map(time_of)
            .unwrap_or(f64::INFINITY)
            .min(self.time.unwrap_or(f64::INFINITY));
        step.saturating_add(((end - time) / time_step).round().max(0.0) as u64)
    }

    /// Whether a strain or a time is reached: both count within half a step, and a run takes one at least.
    pub fn is_reached(&self, clock: Clock, strain_at: impl Fn(f64) -> f64) -> Option<Ending> {
        let soon = clock.time + 0.5 * clock.time_step;
        let strain_soon = if clock.time > 0.0 { strain_at(soon) } else { 0.0 };
        if self.strain.is_some_and(|end| strain_soon >= end) {
            return Some(Ending::Strain(strain_at(clock.time)));
        }
        self.time.filter(|&end| soon >= end).map(|_| Ending::Time(clock.time))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at_a_thousandth(time: f64) -> f64 {
        1e-3 * time
    }

    fn at(time: f64) -> Clock {
        Clock {
            step: 100,
            time,
            time_step: 0.2,
        }
    }

    #[test]
    fn the_strain_and_the_time_count_within_half_a_step() {
        let until = Until {
            strain: Some(0.02),
            time: Some(25.0),
            ..Until::default()
        };
        assert_eq!(until.is_reached(at(19.0), at_a_thousandth), None);
        let reached = until.is_reached(at(19.95), at_a_thousandth);
        assert_eq!(reached, Some(Ending::Strain(0.01995)));
        let until = Until {
            time: Some(15.0),
            ..until
        };
        let reached = until.is_reached(at(14.95), at_a_thousandth);
        assert_eq!(reached, Some(Ending::Time(14.95)));
    }
}
