//! Central differences in time, in the form that knows positions and velocities at the same moment.
//!
//! [Deng2011] Fig. 4-5 and Eq. (3-34): half a kick, a drift, new forces, half a kick.

mod moving;

use std::ops::Range;

use pulp::Arch;
use rayon::prelude::*;

use crate::mesh::Mesh;
use crate::state::{Inertia, State, Strip};
use moving::{Mobility, Moving, Nodes};

/// Nodes in one parallel task.
const CHUNK: usize = 4096;

/// What moves nodes from one moment to the next: so many equal kicks over half of the time each, then a drift over the time.
///
/// Between two steps in which nobody looks, two kicks follow each other; together with the drift they pass through the
/// memory once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    pub kicks: u32,
    /// ps
    pub time: f64,
}

/// Kicks and their time, and the time of the drift after them.
#[derive(Clone, Copy)]
struct Motion {
    kicks: u32,
    kick: f64,
    drift: Option<f64>,
}

/// Advances the velocities of ranges of nodes by the forces over a time.
///
/// Coupled masses are a block m ((1 - 3 c) I + c 1 1^T) a triangle, and its inverse takes c times the sum of the three
/// forces off each before it divides by m (1 - 3 c).
pub fn kick(state: &mut State, nodes: &[Range<usize>], time: f64) {
    let motion = Motion {
        kicks: 1,
        kick: time,
        drift: None,
    };
    nodes.iter().for_each(|nodes| motion.advance(state, nodes));
}

/// Moves ranges of nodes by a step.
pub fn kick_and_drift(state: &mut State, nodes: &[Range<usize>], step: Step) {
    nodes.iter().for_each(|nodes| step.motion().advance(state, nodes));
}

impl Step {
    fn motion(self) -> Motion {
        Motion {
            kicks: self.kicks,
            kick: 0.5 * self.time,
            drift: Some(self.time),
        }
    }

    /// Moves triangles from these positions into the next: the same as [`kick_and_drift`] to the bit.
    pub fn advance(self, strip: Strip, position: &[Vec<f64>; 2], mobility: &[Vec<f64>; 2], inertia: &Inertia) {
        for (axis, corners) in strip.axes.into_iter().enumerate() {
            let corners = corners.map(|corner| Nodes {
                velocity: corner.velocity,
                force: corner.force,
                mobility: match inertia.mobility {
                    Some(mobility) => Mobility::Same(mobility[axis]),
                    None => Mobility::Each(&mobility[axis][corner.nodes.clone()]),
                },
                position: Some(&position[axis][corner.nodes]),
                next: corner.next,
            });
            self.motion().dispatch(corners, inertia.share);
        }
    }

    /// Moves some triangles from their positions into the next, one by one, likewise.
    pub fn advance_triangles(self, state: &mut State, next: &mut [Vec<f64>; 2], mesh: &Mesh, triangles: &[u32]) {
        for &triangle in triangles {
            let nodes = mesh.corners_of(triangle as usize);
            let share = state.coupling_of(nodes[0]);
            for axis in 0..2 {
                let force = nodes.map(|node| state.force[axis][node]);
                let shared = match share > 0.0 {
                    true => (force[0] + force[1] + force[2]) * share,
                    false => 0.0,
                };
                for (node, force) in nodes.into_iter().zip(force) {
                    let push = state.mobility[axis][node] * (0.5 * self.time) * (force - shared);
                    let velocity = &mut state.velocity[axis][node];
                    (0..self.kicks).for_each(|_| *velocity += push);
                    next[axis][node] = state.position[axis][node] + *velocity * self.time;
                }
            }
        }
    }

    /// Moves a range of single atoms from their positions into the next, likewise.
    pub fn advance_atoms(self, state: &mut State, next: &mut [Vec<f64>; 2], nodes: Range<usize>) {
        for axis in 0..2 {
            let tasks = next[axis][nodes.clone()]
                .par_chunks_mut(CHUNK)
                .zip(state.velocity[axis][nodes.clone()].par_chunks_mut(CHUNK))
                .zip(state.position[axis][nodes.clone()].par_chunks(CHUNK))
                .zip(state.force[axis][nodes.clone()].par_chunks(CHUNK))
                .zip(state.mobility[axis][nodes.clone()].par_chunks(CHUNK));
            tasks.for_each(|((((next, velocity), position), force), mobility)| {
                let atoms = Nodes {
                    velocity,
                    force,
                    mobility: Mobility::Each(mobility),
                    position: Some(position),
                    next,
                };
                self.motion().dispatch_lumped(atoms);
            });
        }
    }
}

impl Motion {
    /// A range begins and ends with whole groups of triangles.
    fn advance(self, state: &mut State, nodes: &Range<usize>) {
        let State {
            position,
            velocity,
            force,
            mobility,
            coupled,
            ..
        } = state;
        let coupled = coupled.iter().filter(|coupled| nodes.contains(&coupled.nodes.start));
        let parts: Vec<(Range<usize>, f64)> = match coupled.clone().next() {
            None => {
                let starts = nodes.clone().step_by(CHUNK);
                starts.map(|from| (from..nodes.end.min(from + CHUNK), 0.0)).collect()
            }
            Some(_) => coupled.map(|coupled| (coupled.nodes.clone(), coupled.share)).collect(),
        };
        // Both axes at once, so that threads wait for each other only once.
        let mut tasks = Vec::with_capacity(2 * parts.len());
        for (axis, (position, velocity)) in position.iter_mut().zip(velocity).enumerate() {
            let [mut position, mut velocity] = [position, velocity].map(|plane| &mut plane[nodes.clone()]);
            for (part, share) in &parts {
                let [next, velocity] = [&mut position, &mut velocity].map(|plane| {
                    let own = plane.split_off_mut(..part.len());
                    own.expect("parts lie one after the other")
                });
                let [force, mobility] = [&force[axis][part.clone()], &mobility[axis][part.clone()]];
                let nodes = Nodes {
                    velocity,
                    force,
                    mobility: Mobility::Each(mobility),
                    position: None,
                    next,
                };
                tasks.push((nodes, *share));
            }
        }
        tasks.into_par_iter().for_each(|(nodes, share)| match share > 0.0 {
            true => self.dispatch(nodes.corners(), share),
            false => self.dispatch_lumped(nodes),
        });
    }

    /// Moves the corners of triangles.
    fn dispatch(self, corners: [Nodes; 3], share: f64) {
        if share == 0.0 {
            return corners.into_iter().for_each(|nodes| self.dispatch_lumped(nodes));
        }
        self.dispatch_to(corners, share);
    }

    /// Nodes whose masses are coupled if there are three of them.
    fn dispatch_to<const N: usize>(self, corners: [Nodes; N], share: f64) {
        Arch::new().dispatch(Moving {
            corners,
            share,
            kicks: self.kicks,
            kick: self.kick,
            drift: self.drift,
        });
    }

    fn dispatch_lumped(self, nodes: Nodes) {
        self.dispatch_to([nodes], 0.0);
    }
}

/// The square of what the forces accelerate a node of a range by, coupled masses as if they were not, nm^2/ps^4: the largest.
pub fn largest_squared_acceleration(state: &State, nodes: Range<usize>) -> f64 {
    let largest = |from: usize| {
        let nodes = from..nodes.end.min(from + CHUNK);
        let [x, y] = [0, 1].map(|axis| {
            let [force, mobility] = [&state.force[axis][nodes.clone()], &state.mobility[axis][nodes.clone()]];
            force.iter().zip(mobility).map(|(force, mobility)| force * mobility)
        });
        let squares = x.zip(y).map(|(x, y)| x * x + y * y);
        squares.fold(
            0.0,
            |largest: f64, square| if square > largest { square } else { largest },
        )
    };
    let chunks = nodes.clone().into_par_iter().step_by(CHUNK);
    chunks.map(largest).reduce(|| 0.0, f64::max)
}

/// Largest stable time step of central differences, 2/omega, for a bound of the squared highest frequency.
pub fn stability_limit(squared_frequency: f64) -> f64 {
    2.0 / squared_frequency.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn oscillator() -> State {
        let mut state = State::at_rest([vec![1.0], vec![0.0]], vec![1.0]);
        state.force[0][0] = -1.0;
        state
    }

    fn step(state: &mut State, time: f64) {
        let step = Step { kicks: 1, time };
        kick_and_drift(state, &state.every_node(), step);
        state.force[0][0] = -state.position[0][0];
        kick(state, &state.every_node(), 0.5 * time);
    }

    #[test]
    fn the_largest_acceleration_is_that_of_the_node_with_most_force_to_its_mass() {
        let nodes = 3 * CHUNK + 7;
        let mut state = State::at_rest([vec![0.0; nodes], vec![0.0; nodes]], vec![2.0; nodes]);
        state.force[0].fill(1.0);
        [state.force[0][CHUNK + 3], state.force[1][CHUNK + 3]] = [-6.0, 8.0];
        assert_eq!(largest_squared_acceleration(&state, 0..nodes), 25.0);
        assert_eq!(largest_squared_acceleration(&state, CHUNK + 4..nodes), 0.25);
        assert_eq!(largest_squared_acceleration(&state, 0..0), 0.0);
    }

    #[test]
    fn central_differences_are_second_order_and_stable_up_to_two_over_omega() {
        // [Deng2011] Fig. 4-5 and Eq. (3-34) for one spring: x = cos t.
        let error = |steps: u32| {
            let mut state = oscillator();
            (0..steps).for_each(|_| step(&mut state, 1.0 / f64::from(steps)));
            (state.position[0][0] - 1f64.cos()).abs()
        };
        let order = (error(50) / error(100)).log2();
        assert!((order - 2.0).abs() < 0.01, "order {order}");
        let swing = |time: f64| {
            let mut state = oscillator();
            (0..200).for_each(|_| step(&mut state, time));
            state.position[0][0].abs()
        };
        assert_eq!(stability_limit(1.0), 2.0);
        assert!(swing(1.99) < 20.0 && swing(2.01) > 1e3);
    }
}
