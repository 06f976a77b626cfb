use super::error::SolverError;
use crate::integrator::stability_limit;

/// How the time step is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TimeStep {
    /// This fraction of the stability limit of the start; shorter while the specimen is stiffer, as what collides is.
    Auto { fraction: f64 },
    /// ps; refused above the limit, and the end of the run when the limit falls below it.
    Given(f64),
}

/// Steps between looks at the stability limit, and between those of an automatic time step below [`FAR`] of it.
const CHECK_EVERY: u64 = 100;
const CHECK_FAR_EVERY: u64 = 400;

/// From here to the limit itself the stiffness has to grow 2.8 times.
const FAR: f64 = 0.6;

/// Steps between looks at the speed of the nodes, after which an automatic time step may become longer.
const FOLLOW_EVERY: u64 = 20;

/// How much longer it may become then: it keeps short for some hundred steps after parts have collided, as where one pair
/// collides others are about to.
const GROWTH: f64 = 1.1;

/// Share of the lattice spacing that the fastest node may go in an automatic time step. Two nodes that meet go twice as far
/// towards each other, and are found close no later than two steps after they have come within the range of a regular bond.
const FARTHEST: f64 = 0.1;

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

    /// Whether to look at the speed of the nodes after this step.
    pub fn follows_speed(self, step: u64) -> bool {
        matches!(self, Self::Auto { .. }) && step.is_multiple_of(FOLLOW_EVERY)
    }

    /// The time step that follows one of `present`, at most `longest`; `None` where a given one has become unstable. `limit`: the
    /// stability limit without close bonds, which add `added` to the squared highest frequency, 1/ps^2. `farthest`: how far the
    /// fastest node goes in a present step, in spacings of the lattice, where that has been looked at.
    pub fn follow(self, present: f64, longest: f64, [limit, added]: [f64; 2], farthest: Option<f64>) -> Option<f64> {
        match self {
            Self::Auto { fraction } => {
                let grown = farthest.map_or(1.0, |farthest| GROWTH.min(FARTHEST / farthest));
                let calm = longest.min(NEAREST.max(fraction) * limit).min(grown * present);
                // What collides is to be resolved as well as the crystal is.
                Some(if added > 0.0 {
                    calm.min(fraction * with_close_bonds(limit, added))
                } else {
                    calm
                })
            }
            Self::Given(given) => (given <= limit).then_some(given),
        }
    }
}

/// The stability limit where close bonds add this to the squared highest frequency, 1/ps^2.
fn with_close_bonds(limit: f64, added: f64) -> f64 {
    stability_limit(squared_frequency(limit) + added)
}

/// The stability limit without what close bonds add to the squared highest frequency. A look, which has found `found`, sees them
/// too, and may have seen them elsewhere than where the specimen is stiffest: then it is not above what it was `before`, as far
/// as that is above what was found.
pub fn without_close_bonds(found: f64, added: f64, before: f64) -> f64 {
    match added > 0.0 {
        true => {
            let rest = squared_frequency(found) - added;
            stability_limit(rest.max(squared_frequency(before.max(found))))
        }
        false => found,
    }
}

/// For which a limit is the stability limit.
fn squared_frequency(limit: f64) -> f64 {
    4.0 / (limit * limit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_given_step_is_never_above_the_limit_and_an_automatic_one_follows_it() {
        let given = TimeStep::Given(0.2);
        let refused = given.choose(0.1, 1.0);
        assert_eq!(refused, Err(SolverError::StepTooLong { given: 0.2, limit: 0.1 }));
        let [given_step, longest] = [0.2, 0.15];
        let outrun = SolverError::OutrunByGrips {
            given: given_step,
            longest,
        };
        assert_eq!(given.choose(0.3, longest), Err(outrun));
        assert_eq!(
            [0.3, 0.1].map(|limit| given.follow(0.2, 0.2, [limit, 9.0], None)),
            [Some(0.2), None]
        );
        let auto = TimeStep::Auto { fraction: 0.75 };
        assert_eq!([auto.choose(8.0, 7.0), auto.choose(8.0, 5.0)], [Ok(6.0), Ok(5.0)]);
        let follow = |present: f64, limit: f64, farthest| auto.follow(present, 6.0, [limit, 0.0], farthest).unwrap();
        assert_eq!([16.0, 8.0, 4.0].map(|limit| follow(6.0, limit, None)), [6.0, 6.0, 3.0]);
        assert_eq!(follow(3.0, 8.0, None), 3.0, "longer at looks alone");
        assert_eq!(follow(3.0, 8.0, Some(0.01)), 3.0 * GROWTH);
        assert_eq!(follow(5.9, 8.0, Some(0.01)), 6.0);
        assert_eq!(follow(6.0, 8.0, Some(2.0 * FARTHEST)), 3.0);
        assert_eq!(follow(6.0, 8.0, Some(0.0)), 6.0, "at rest");
        let half = TimeStep::Auto { fraction: 0.5 };
        let follow = |limit: f64, added: f64| half.follow(4.0, 4.0, [limit, added], None).unwrap();
        assert_eq!([follow(8.0, 0.0), follow(4.0, 0.0)], [4.0, 3.0]);
        assert_eq!(follow(8.0, 3.0 / 16.0), 2.0, "four times as stiff");
    }

    #[test]
    fn a_look_tells_the_limit_apart_from_close_bonds_and_never_above_what_it_was_before() {
        // The squared frequencies of limits 1 and 2 are 4 and 1.
        assert_eq!(without_close_bonds(1.0, 3.0, 3.0), 2.0);
        assert!((without_close_bonds(1.0, 3.0, 1.5) - 1.5).abs() < 1e-15);
        assert_eq!(without_close_bonds(1.0, 3.0, 0.5), 1.0);
        assert_eq!(without_close_bonds(1.0, 0.0, 0.5), 1.0);
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
