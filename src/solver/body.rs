//! What a run moves and what is read of it: the roles that a specimen plays in the loop.

use std::sync::atomic::AtomicBool;

use super::clock::Clock;
use super::cost::Cost;
use super::error::SolverError;
use super::ledger::Balance;
use super::until::{Ending, Until};
use crate::domain::Domain;
use crate::forces::ForceError;
use crate::loading::Load;
use crate::state::State;

/// A specimen and what acts on it: all that a step in time asks for.
pub trait Body<const D: usize> {
    type Load: Load<D>;

    fn domain(&self) -> &Domain;

    fn domain_mut(&mut self) -> &mut Domain;

    fn load(&self) -> &Self::Load;

    fn load_mut(&mut self) -> &mut Self::Load;

    /// Of the lattice, nm.
    fn spacing(&self) -> f64;

    /// What the energy of a pair jumps by when it comes within the cutoff, eV.
    fn jump_at_cutoff(&self) -> f64;

    /// Sets the velocities of the start and takes hold of what is held.
    fn start(&self, state: &mut State<D>);

    /// Forces at the present positions and at a time, ps, and what elements hold if it is to be `measured`.
    fn compute(&mut self, state: &mut State<D>, time: f64, measured: bool) -> Result<(), ForceError>;

    /// Forces at the present positions, and with them the motion of the next step where that is worth while; then true.
    fn compute_and_move(&mut self, state: &mut State<D>, clock: Clock) -> Result<bool, ForceError> {
        self.compute(state, clock.time, false).map(|()| false)
    }

    /// Potential energy, eV, and pairs within the cutoff when they were last measured. All ranks must ask for it together.
    fn stored(&self) -> [f64; 2];

    /// Largest stable time step of a state whose forces have just been computed, ps, the same on all ranks.
    fn stability_limit(&self, state: &State<D>) -> f64;

    /// What close bonds may add to the squared highest frequency of a state whose forces have just been computed, 1/ps^2, the
    /// same on all ranks.
    fn stiffened(&self, state: &State<D>) -> f64;

    /// The length of the shortest bond between sites whose neighbours are searched that has been closer than in a regular
    /// lattice, nm; infinite before there is one. All ranks must ask for it together.
    fn closest_approach(&self) -> f64;

    /// Goes on from what was seen before.
    fn restore_closest_approach(&mut self, length: f64);

    /// Whether ranks have had unequal work since they were last asked. All must be asked together.
    fn is_unbalanced(&mut self) -> bool {
        false
    }

    /// Cuts the specimen anew among the ranks. It leaves no trace in the results.
    fn cut_anew(&mut self, _state: &mut State<D>) {}

    /// Largest stable time step of the atoms of a state whose forces have just been computed, ps, the same on all ranks.
    fn stability_limit_of_atoms(&self, state: &State<D>) -> f64 {
        self.stability_limit(state)
    }

    /// How often to look whether the mesh is fine enough, ps; `None` where it stays as it is.
    fn looks_every(&self) -> Option<f64> {
        None
    }

    /// Whether the mesh is too coarse for what it carries. All ranks must ask for it together, and get the same answer.
    fn is_too_coarse(&mut self, _state: &mut State<D>) -> bool {
        false
    }

    /// Goes over to the mesh that is fine enough, after [`Self::is_too_coarse`], with a state that moves on as it did. Nothing
    /// is computed yet.
    fn refine(&mut self, _state: &mut State<D>) {}

    /// Brings the specimen to rest; `tell` hears about what is left of the forces, again and again.
    fn relax(&mut self, state: &mut State<D>, stop: &AtomicBool, tell: &mut dyn FnMut(f64)) -> Result<(), SolverError>;

    /// Nominal strain at a time.
    fn strain(&self, time: f64) -> f64;

    /// When a nominal strain is reached, ps.
    fn time_of(&self, strain: f64) -> f64;

    /// The site of the lattice at which a node stands.
    fn site_of(&self, node: usize) -> [i32; D];

    /// Where a node was before the loading, nm, in the frame of the specimen.
    fn reference_place(&self, node: usize) -> Vec<f64>;

    /// The same of an element.
    fn place_of_element(&self, element: usize) -> Vec<f64>;

    /// Books as phases of their own what the loop has booked as set-up and forces.
    fn rebook(&self, cost: &mut Cost);
}

/// What is read of a body in motion, and what must be kept so that reading goes on where it was left.
pub trait Instruments<const D: usize>: Body<D> + Sized {
    type Mesh;
    /// What its elements hold at one moment.
    type Measure;
    /// What of it is broken.
    type Broken;
    /// What a probe reads.
    type Reading;
    /// What a checkpoint keeps beside positions, velocities and energies.
    type Kept: Clone;

    fn mesh(&self) -> &Self::Mesh;

    /// The mesh alone.
    fn into_mesh(self) -> Self::Mesh;

    fn measure(&self) -> &Self::Measure;

    /// The first reason to stop at this moment.
    fn ending(&self, until: &Until, clock: Clock) -> Option<Ending>;

    /// Distance of the foremost tip of a crack from the left edge, nm.
    fn tip(&self) -> Option<f64> {
        None
    }

    /// Reads a state that has been measured; all ranks take part, and the first alone is given a reading.
    fn read(&mut self, state: &mut State<D>, totals: &Totals) -> Option<Self::Reading>;

    /// What is broken. All ranks must ask for it together.
    fn picture(&mut self, state: &mut State<D>) -> Self::Broken;

    /// Interfaces that have left the intact path, ascending.
    fn open_interfaces(&self) -> Vec<u32>;

    /// All ranks must call this together; only the first has the whole.
    fn keep(&self) -> Self::Kept;

    /// Goes over to the mesh of so many nodes on which something was kept, with a state on it; refuses that of another specimen,
    /// says by what, and changes nothing then.
    fn go_to_mesh_of(&mut self, _kept: &Self::Kept, nodes: usize, state: &mut State<D>) -> Result<(), &'static str> {
        match nodes == state.nodes() {
            true => Ok(()),
            false => Err("it has another number of nodes"),
        }
    }

    /// Refuses open interfaces and what was kept of another specimen, and says by what.
    fn check_is_own(&self, open_interfaces: &[u32], kept: &Self::Kept) -> Result<(), &'static str>;

    /// Goes back to where these were kept.
    fn restore(&mut self, open_interfaces: &[u32], kept: &Self::Kept);
}

/// The energies of a moment, and which probe it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Totals {
    /// Counted from 0.
    pub probe: u64,
    pub clock: Clock,
    /// eV
    pub kinetic: f64,
    pub balance: Balance,
}
