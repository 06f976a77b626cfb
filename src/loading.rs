//! What acts on a specimen from outside, and the work it does.

mod act;
mod ball;
mod carried;
mod hold;
mod impulse;
mod pace;
mod push;
mod ramp;
mod slab_load;
mod sponge;
mod stretching;
mod together;
mod work;

pub use act::Act;
pub use ball::Ball;
pub use carried::{Carried, mean};
pub use hold::Hold;
pub use pace::longest_step;
pub use push::{Course, Push};
pub use ramp::Ramp;
pub use slab_load::{Booked, SlabLoad};
pub use sponge::{Layers, Sponge};
pub use stretching::{Grip, Stretching};
pub use together::Together;
pub use work::Work;

use std::ops::Range;

use crate::domain::Ranks;
use crate::state::State;

/// Something that acts on a specimen from outside. In every step the nodes move, it damps them, its forces are added to those
/// of the bonds, and its work is booked: half of the step with the forces before, half with those after.
pub trait Load<const D: usize> {
    /// Takes hold of the nodes whose motion it prescribes.
    fn hold(&self, state: &mut State<D>);

    /// Those nodes.
    fn held(&self) -> Vec<u32>;

    /// Adds its forces at the present positions and at a time, ps.
    fn force(&mut self, _state: &mut State<D>, _time: f64) {}

    /// Takes what it takes from the velocities of these ranges of nodes in a time, ps.
    fn damp(&mut self, _state: &mut State<D>, _nodes: &[Range<usize>], _time: f64) {}

    /// Books the work of the present forces over a time, ps, in which nodes have the present velocities.
    fn book(&mut self, state: &State<D>, time: f64);

    /// Work so far, eV. All ranks must ask for it together.
    fn work(&self, ranks: Ranks) -> f64;

    /// What central differences leave open of the energy in a step of this time, ps, with its present forces: dt^2 F^2/(8 m) a
    /// node, eV. It oscillates with the forces and does not grow; where these set in it is as much as their work. All ranks must
    /// ask for it together.
    fn unresolved(&self, _state: &State<D>, _time_step: f64, _ranks: Ranks) -> f64 {
        0.0
    }

    /// The longest step that its motion allows, ps, in a lattice of this spacing, nm.
    fn longest_step(&self, spacing: f64) -> f64;
}

/// A load that may act together with others on a specimen.
pub trait Action<const D: usize>: Load<D> + Send + Sync {
    /// The force with which it acts on the specimen, eV/nm, in a state whose forces have just been computed. All ranks must ask
    /// for it together.
    fn pull(&self, state: &State<D>, ranks: Ranks) -> [f64; D];

    /// What it does, for those that must tell another program.
    fn act(&self) -> Act<D>;

    /// Keeps to the nodes that a rank moves, those in these ranges.
    fn keep_to(&mut self, nodes: &[Range<usize>]);

    fn booked(&self) -> &Work;

    fn booked_mut(&mut self) -> &mut Work;
}
