//! What a case will cost, before anything is computed.

use crate::setup::expected::Expected;
use crate::setup::{SetupError, slab, solid};
use crate::study::case::{Body, Case};

/// Size and cost of a case.
pub type Estimate = Expected<Specimen>;

/// A specimen as it is laid out.
#[derive(Clone, Debug, PartialEq)]
pub enum Specimen {
    Slab(slab::estimate::Specimen),
    Solid(Box<solid::Specimen>),
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

fn of_solid(specimen: solid::Specimen) -> Specimen {
    Specimen::Solid(Box::new(specimen))
}

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
            Body::Slab(slab) => Ok(self.slabs.estimate(case, slab)?.of(Specimen::Slab)),
            Body::Solid(solid) => Ok(self.solids.estimate(case, solid)?.of(of_solid)),
        }
    }

    /// The specimen of a case; an error is that of [`Self::estimate`].
    pub fn specimen(&mut self, case: &Case) -> Result<Specimen, SetupError> {
        match &case.body {
            Body::Slab(slab) => self.slabs.specimen(case, slab).map(Specimen::Slab),
            Body::Solid(solid) => self.solids.specimen(case, solid).map(of_solid),
        }
    }
}
