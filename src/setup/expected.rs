//! What is expected of a run, whatever its specimen.

use crate::setup::SetupError;
use crate::setup::intervals::refuse_too_short;
use crate::study::case::Case;

/// Size and cost of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Expected<S> {
    pub nodes: u64,
    pub elements: u64,
    pub represented_atoms: u64,
    pub specimen: S,
    /// ps
    pub time_step: f64,
    /// Largest stable time step, ps.
    pub stability_limit: f64,
    pub steps: u64,
    /// Of all ranks together.
    pub memory_bytes: u64,
    /// Of its pictures, its series and its checkpoint, at most: while they are put together.
    pub disk_bytes: u64,
    /// Wall time on one thread, s.
    pub seconds: f64,
}

impl<S> Expected<S> {
    /// Simulated time of the whole run, ps.
    pub fn time(&self) -> f64 {
        self.steps as f64 * self.time_step
    }

    /// The same of a specimen of any kind.
    pub fn of<T>(self, kind: impl FnOnce(S) -> T) -> Expected<T> {
        Expected {
            nodes: self.nodes,
            elements: self.elements,
            represented_atoms: self.represented_atoms,
            specimen: kind(self.specimen),
            time_step: self.time_step,
            stability_limit: self.stability_limit,
            steps: self.steps,
            memory_bytes: self.memory_bytes,
            disk_bytes: self.disk_bytes,
            seconds: self.seconds,
        }
    }
}

/// More steps than this are a slip in a rate, a mass or an end: they would take years.
const MOST_STEPS: u64 = 1_000_000_000_000;

/// A run that is looked at less often than this has no curves and no moments.
const FEWEST_PROBES: f64 = 10.0;

/// Time of a run of so many steps, ps; refuses what can neither be computed nor looked at.
pub fn time_of_run(case: &Case, strain_rate: Option<f64>, steps: u64, time_step: f64) -> Result<f64, SetupError> {
    if !(1..MOST_STEPS).contains(&steps) {
        return Err(SetupError::Endless { steps, time_step });
    }
    let time = steps as f64 * time_step;
    if time < FEWEST_PROBES * case.probes.every {
        let every = case.probes.every;
        return Err(SetupError::TooFewProbes { every, time });
    }
    refuse_too_short(case, strain_rate, time_step)?;
    Ok(time)
}

pub fn ranks(case: &Case) -> u32 {
    case.execution.ranks.unwrap_or(1)
}
