use crate::forces::ForceError;
use crate::relaxation::RelaxationError;

/// Why a run cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolverError {
    #[error(
        "the time step {given:.5} ps is above the stability limit {limit:.5} ps of this mesh and material; \
         choose a smaller one, or `time-step: auto`"
    )]
    StepTooLong { given: f64, limit: f64 },
    #[error(
        "in a time step of {given:.5} ps the grips outrun the specimen by more than a hundredth of the spacing of the lattice: \
         the step may have {longest:.5} ps at this strain rate; choose a smaller one, or `time-step: auto`, a lower rate, or \
         `ramp: initial-velocity`"
    )]
    OutrunByGrips { given: f64, longest: f64 },
    #[error(
        "step {step}, {time:.3} ps, strain {strain:.5}: {source}, which was at {}; \
         try a smaller fraction of the stability limit or a lower strain rate",
        named(place)
    )]
    BlowUp {
        step: u64,
        time: f64,
        strain: f64,
        /// Where the element was before the loading, nm: in a slab from the left edge, and from the crack plane.
        place: Vec<f64>,
        source: ForceError,
    },
    #[error(
        "step {step}, {time:.3} ps, strain {strain:.5}: energy went astray by {imbalance:.3e} eV, \
         more than {limit:.0} % of the energy put in ({put_in:.3e} eV), with the fastest node at {}; try a smaller \
         fraction of the stability limit",
        named(fastest)
    )]
    EnergyAstray {
        step: u64,
        time: f64,
        strain: f64,
        imbalance: f64,
        put_in: f64,
        limit: f64,
        /// Where the fastest node was before the loading, nm.
        fastest: Vec<f64>,
    },
    #[error(
        "step {step}, {time:.3} ps, strain {strain:.5}: the given time step of {given:.5} ps is no longer stable: the \
         specimen has stiffened and its limit is {limit:.5} ps now; choose a smaller one, or `time-step: auto`, which \
         follows the limit"
    )]
    StepUnstable {
        step: u64,
        time: f64,
        strain: f64,
        given: f64,
        limit: f64,
    },
    #[error("the run cannot start: {0}")]
    NoStart(ForceError),
    #[error("`relax` before the run: {0}")]
    NoRest(RelaxationError),
    #[error(
        "the crack grew from a length of {notch:.3} to {tip:.3} nm while the specimen came to rest under {:.3} % strain: it does not \
         hold this load; start from a lower strain in `run.relax`",
        100.0 * strain
    )]
    RanWhileResting { notch: f64, tip: f64, strain: f64 },
    #[error("this is no checkpoint of this specimen: {0}")]
    OtherSpecimen(&'static str),
}

/// How a run ended, or why not; observers' errors pass through.
#[derive(Debug, thiserror::Error)]
pub enum RunError<E> {
    #[error(transparent)]
    Physics(#[from] SolverError),
    #[error("{0}")]
    Output(E),
}

/// A place with the names of its axes, nm.
fn named(place: &[f64]) -> String {
    let axes = ["x", "y", "z"].iter().zip(place);
    let axes: Vec<String> = axes.map(|(axis, at)| format!("{axis} = {at:.3} nm")).collect();
    axes.join(", ")
}
