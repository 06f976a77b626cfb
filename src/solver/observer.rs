//! Who looks at a run, and what it is shown.

use super::body::Instruments;
use super::checkpoint::Checkpoint;
use super::cost::Cost;
use super::slab::Slab;
use crate::domain::{Domain, Of};
use crate::state::State;

/// Takes what a run gives. An error ends the run: a lost output must never go unnoticed.
pub trait Observer<B: Instruments<D> = Slab, const D: usize = 2> {
    type Error;
    fn probe(&mut self, reading: &B::Reading) -> Result<(), Self::Error>;
    /// Called on all ranks, which together give the first what it asks the moment for.
    fn snapshot(&mut self, moment: &Moment<B, D>) -> Result<(), Self::Error>;
    /// All probes and snapshots up to here must be safe before the checkpoint is, which has no positions and velocities: these
    /// are asked for one by one. `cost` is that of this part of the run.
    fn checkpoint(
        &mut self,
        checkpoint: &Checkpoint<B::Kept, D>,
        motion: &Motion<D>,
        cost: &Cost,
    ) -> Result<(), Self::Error>;
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
    pub domain: &'a Domain,
    /// That of this rank.
    pub state: &'a State<D>,
    /// What the elements of this rank hold.
    pub measure: &'a B::Measure,
    pub broken: &'a B::Broken,
    /// Whether the mesh of the run changes.
    pub mesh_changes: bool,
}

/// Positions and velocities of all nodes, of which this rank holds its own.
pub struct Motion<'a, const D: usize> {
    pub domain: &'a Domain,
    pub state: &'a State<D>,
}

impl<const D: usize> Motion<'_, D> {
    /// How many nodes the specimen has.
    pub fn nodes(&self) -> usize {
        self.state.position[0].len()
    }

    /// How many planes there are: the positions, an axis after the other, then the velocities.
    pub const PLANES: usize = 2 * D;

    /// Gives the first rank a plane block by block. All ranks must ask for it together.
    pub fn plane(&self, number: usize, give: &mut dyn FnMut(&[f64])) {
        let State { position, velocity, .. } = self.state;
        let plane = [position, velocity][number / D][number % D].as_slice();
        match self.domain.ranks().count() {
            1 => give(plane),
            _ => self
                .domain
                .gather_in_blocks(Of::Nodes, |node| [plane[node]], |_, rows| give(rows.as_flattened())),
        }
    }

    /// A checkpoint with these.
    pub fn complete<K: Clone>(&self, checkpoint: &Checkpoint<K, D>) -> Checkpoint<K, D> {
        let mut complete = checkpoint.clone();
        let places = complete.position.iter_mut().chain(&mut complete.velocity);
        for (number, place) in places.enumerate() {
            place.clear();
            self.plane(number, &mut |block| place.extend_from_slice(block));
        }
        complete
    }
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
