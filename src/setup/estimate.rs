//! What a case will cost, before anything is computed.

use crate::setup::intervals::refuse_too_short;
use crate::setup::{SetupError, slab, solid};
use crate::study::case::{Body, Case};

/// Size and cost of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    pub nodes: u64,
    pub elements: u64,
    pub represented_atoms: u64,
    pub specimen: Specimen,
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

impl Estimate {
    /// Simulated time of the whole run, ps.
    pub fn time(&self) -> f64 {
        self.steps as f64 * self.time_step
    }
}

/// A specimen as it is laid out.
#[derive(Clone, Debug, PartialEq)]
pub enum Specimen {
    Slab(slab::estimate::Specimen),
    Solid(solid::Specimen),
}

impl Specimen {
    /// Equal for cases that are one computation, however they were asked for.
    pub fn computation(&self) -> u64 {
        match self {
            Self::Slab(slab) => slab.computation,
            Self::Solid(solid) => solid.computation,
        }
    }

    /// Share of the sites that are in smaller elements than asked for; `None` where nobody has laid the elements.
    pub fn leftover_share(&self) -> Option<f64> {
        match self {
            Self::Slab(slab) => slab.leftovers.map(|leftovers| leftovers.share()),
            Self::Solid(solid) => solid.leftover_share,
        }
    }
}

/// More steps than this are a slip in a rate, a mass or an end: they would take years.
const MOST_STEPS: u64 = 1_000_000_000_000;

/// A run that is looked at less often than this has no curves and no moments.
const FEWEST_PROBES: f64 = 10.0;

/// Estimates cases, and remembers what many cases of one study have in common.
#[derive(Default)]
pub struct Estimator {
    slabs: slab::estimate::Estimator,
    solids: solid::Estimator,
}

impl Estimator {
    /// The estimate of a case; an error is physical nonsense that only the mesh or the material reveals.
    pub fn estimate(&mut self, case: &Case) -> Result<Estimate, SetupError> {
        match &case.body {
            Body::Slab(slab) => self.slabs.estimate(case, slab),
            Body::Solid(solid) => self.solids.estimate(case, solid),
        }
    }

    /// The specimen of a case; an error is that of [`Self::estimate`].
    pub fn specimen(&mut self, case: &Case) -> Result<Specimen, SetupError> {
        match &case.body {
            Body::Slab(slab) => self.slabs.specimen(case, slab).map(Specimen::Slab),
            Body::Solid(solid) => self.solids.specimen(case, solid).map(Specimen::Solid),
        }
    }
}

/// Time of a run of so many steps, ps; refuses what can neither be computed nor looked at.
pub fn time_of_run(case: &Case, steps: u64, time_step: f64) -> Result<f64, SetupError> {
    if !(1..MOST_STEPS).contains(&steps) {
        return Err(SetupError::Endless { steps, time_step });
    }
    let time = steps as f64 * time_step;
    if time < FEWEST_PROBES * case.probes.every {
        let every = case.probes.every;
        return Err(SetupError::TooFewProbes { every, time });
    }
    refuse_too_short(case, time_step)?;
    Ok(time)
}

pub fn ranks(case: &Case) -> u32 {
    case.execution.ranks.unwrap_or(1)
}
