use super::error::SolverError;
use crate::integrator::stability_limit;

/// How the time step is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TimeStep {
    /// This fraction of the stability limit; made shorter if the specimen stiffens, as what collides does.
    Auto { fraction: f64 },
    /// ps; refused above the limit, and the end of the run when the limit falls below it.
    Given(f64),
}

/// Steps between looks at the stability limit, and between those of an automatic time step below [`FAR`] of it.
const CHECK_EVERY: u64 = 100;
const CHECK_FAR_EVERY: u64 = 400;

/// From here to the limit itself the stiffness has to grow 2.8 times.
const FAR: f64 = 0.6;

/// Steps between looks at the forces of an automatic time step.
const FOLLOW_EVERY: u64 = 20;

/// Where a force moves its node by more than this share of the lattice spacing within a step, parts collide, and are stiffer
/// than the crystal: while cracks run it is seen in half a per cent of the looks, and where it is not seen, the limit has not
/// been found within [`NEAREST`] of the time step.
const ROUGH: f64 = 0.03;

/// Whether a push, as a share of the spacing, calls for a look at the stability limit.
pub fn is_rough(push: f64) -> bool {
    push > ROUGH
}

/// How near to the limit an automatic time step may come before it is made shorter.
const NEAREST: f64 = 0.75;

/// The stability limit for a squared frequency, ps, to nine digits: what rounding does to the rest may depend on which
/// elements are computed together, and must not get into a time step.
pub fn nine_digits(squared_frequency: f64) -> f64 {
    const DROPPED_BITS: u64 = (1 << 22) - 1;
    f64::from_bits(stability_limit(squared_frequency).to_bits() & !DROPPED_BITS)
}

impl TimeStep {
    /// The time step at the start, where the motion of the grips allows none longer than `longest`, ps.
    pub fn choose(self, limit: f64, longest: f64) -> Result<f64, SolverError> {
        match self {
            Self::Auto { fraction } => Ok(longest.min(fraction * limit)),
            Self::Given(given) if given > limit => Err(SolverError::StepTooLong { given, limit }),
            Self::Given(given) if given > longest => Err(SolverError::OutrunByGrips { given, longest }),
            Self::Given(given) => Ok(given),
        }
    }

    /// Whether to look at the stability limit after this step; it was `limit` when it was last looked at.
    pub fn is_to_be_checked(self, step: u64, present: f64, limit: f64) -> bool {
        let every = match self {
            Self::Auto { .. } if present < FAR * limit => CHECK_FAR_EVERY,
            _ => CHECK_EVERY,
        };
        step.is_multiple_of(every)
    }

    /// Whether to look at the forces after this step, by which [`is_rough`] tells that the limit may have fallen meanwhile.
    pub fn follows_forces(self, step: u64) -> bool {
        matches!(self, Self::Auto { .. }) && step.is_multiple_of(FOLLOW_EVERY)
    }

    /// The time step from here on, never longer than before; `None` where a given one has become unstable.
    pub fn adapt(self, present: f64, limit: f64) -> Option<f64> {
        match self {
            Self::Auto { fraction } if present > NEAREST.max(fraction) * limit => Some(fraction * limit),
            Self::Auto { .. } => Some(present),
            Self::Given(given) => (given <= limit).then_some(given),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_given_step_is_never_above_the_limit_and_an_automatic_one_only_shrinks() {
        let given = TimeStep::Given(0.2);
        let refused = given.choose(0.1, 1.0);
        assert_eq!(refused, Err(SolverError::StepTooLong { given: 0.2, limit: 0.1 }));
        let [given_step, longest] = [0.2, 0.15];
        let outrun = SolverError::OutrunByGrips {
            given: given_step,
            longest,
        };
        assert_eq!(given.choose(0.3, longest), Err(outrun));
        assert_eq!([given.adapt(0.2, 0.3), given.adapt(0.2, 0.1)], [Some(0.2), None]);
        let auto = TimeStep::Auto { fraction: 0.75 };
        assert_eq!([auto.choose(8.0, 7.0), auto.choose(8.0, 5.0)], [Ok(6.0), Ok(5.0)]);
        assert_eq!(auto.adapt(6.0, 16.0), Some(6.0));
        assert_eq!(auto.adapt(6.0, 8.0), Some(6.0));
        assert_eq!(auto.adapt(6.0, 4.0), Some(3.0));
    }

    #[test]
    fn a_limit_that_is_far_is_looked_at_less_often() {
        let auto = TimeStep::Auto { fraction: 0.5 };
        let looks = |time_step: TimeStep, limit: f64| {
            let steps = 1..=800;
            steps
                .filter(|&step| time_step.is_to_be_checked(step, 5.0, limit))
                .count()
        };
        assert_eq!([looks(auto, 10.0), looks(auto, 8.0)], [2, 8]);
        assert_eq!(looks(TimeStep::Given(5.0), 10.0), 8);
    }
}
