//! Who looks at a run, and what it is shown.

use super::body::Instruments;
use super::checkpoint::Checkpoint;
use super::cost::Cost;
use super::slab::Slab;
use crate::state::State;

/// Takes what a run gives. An error ends the run: a lost output must never go unnoticed.
pub trait Observer<B: Instruments<D> = Slab, const D: usize = 2> {
    type Error;
    fn probe(&mut self, reading: &B::Reading) -> Result<(), Self::Error>;
    fn snapshot(&mut self, moment: &Moment<B, D>) -> Result<(), Self::Error>;
    /// All probes and snapshots up to here must be safe before the checkpoint is.
    /// `cost` is that of this part of the run.
    fn checkpoint(&mut self, checkpoint: &Checkpoint<B::Kept, D>, cost: &Cost) -> Result<(), Self::Error>;
    /// Called at every probe, and again and again while the specimen comes to rest.
    fn progress(&mut self, progress: &Progress);
}

/// A moment of a run as its observers see it.
pub struct Moment<'a, B: Instruments<D> = Slab, const D: usize = 2> {
    pub step: u64,
    /// ps
    pub time: f64,
    /// Nominal strain.
    pub strain: f64,
    pub mesh: &'a B::Mesh,
    pub state: &'a State<D>,
    pub measure: &'a B::Measure,
    pub broken: &'a B::Broken,
    /// Whether the mesh of the run changes.
    pub mesh_changes: bool,
}

/// How far a run is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    pub step: u64,
    /// Steps that the run would take if the crack did not end it.
    pub of: u64,
    /// ps
    pub time: f64,
    /// Nominal.
    pub strain: f64,
    /// Distance of the foremost tip from the left edge, nm.
    pub tip: Option<f64>,
    /// While the specimen comes to rest: the largest force left on a node, over the strength of a bond.
    pub residual: Option<f64>,
}
