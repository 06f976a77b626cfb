//! Central differences in time, in the form that knows positions and velocities at the same moment.
//!
//! [Deng2011] Fig. 4-5 and Eq. (3-34): half a kick, a drift, new forces, half a kick.

mod moving;

use std::ops::Range;

use pulp::Arch;
use rayon::prelude::*;

use crate::mesh::Mesh;
use crate::mesh::grouped::{Answer, MassCoupling};
use crate::state::{Inertia, Leap, State, Strip};
use moving::{Mobility, Moving, Nodes};

/// Nodes in one parallel task.
const CHUNK: usize = 4096;

/// Fewer nodes than this are not worth a parallel task.
const FEW: usize = 512;

/// A leap of a time step, ps, that begins with so many kicks over half of it.
///
/// Between two steps in which nobody looks, two kicks follow each other; together with the drift they pass through the
/// memory once.
pub fn leap(kicks: u32, time: f64) -> Leap {
    Leap {
        kicks,
        kick: 0.5 * time,
        drift: time,
    }
}

/// Advances the velocities of ranges of nodes by the forces over a time.
///
/// Coupled masses are a block m ((1 - 3 c) I + c 1 1^T) a triangle, and its inverse takes c times the sum of the three
/// forces off each before it divides by m (1 - 3 c). A tetrahedron has four, and in an octahedron the force on the opposite
/// node counts beside: [`Answer`].
pub fn kick<const D: usize>(state: &mut State<D>, nodes: &[Range<usize>], time: f64) {
    let kick = Leap {
        kicks: 1,
        kick: time,
        drift: 0.0,
    };
    nodes.iter().for_each(|nodes| advance(state, nodes, kick, false));
}

/// Moves ranges of nodes by a leap.
pub fn kick_and_drift<const D: usize>(state: &mut State<D>, nodes: &[Range<usize>], leap: Leap) {
    nodes.iter().for_each(|nodes| advance(state, nodes, leap, true));
}

/// The same into planes of their own: from where nodes are and how fast they were, where and how fast they come to be. All of
/// it is the same to the bit as [`kick_and_drift`].
pub struct Ahead<'a> {
    pub leap: Leap,
    /// How fast nodes were.
    pub before: &'a Planes,
    pub mobility: &'a Planes,
    /// How each group of triangles answers to forces.
    pub inertias: &'a [Inertia],
}

/// A plane for x and one for y, an entry a node.
type Planes = [Vec<f64>; 2];

impl Ahead<'_> {
    /// Moves triangles side by side from these positions.
    pub fn strip(&self, strip: Strip, position: &Planes) {
        let inertia = &self.inertias[strip.group];
        for (axis, corners) in strip.axes.into_iter().enumerate() {
            let corners = corners.map(|corner| Nodes {
                before: Some(&self.before[axis][corner.nodes.clone()]),
                velocity: corner.velocity,
                force: corner.force,
                mobility: match inertia.mobility {
                    Some(mobility) => Mobility::Same(mobility[axis]),
                    None => Mobility::Each(&self.mobility[axis][corner.nodes.clone()]),
                },
                position: Some(&position[axis][corner.nodes]),
                next: corner.next,
            });
            dispatch(corners, self.leap, true, inertia.share);
        }
    }

    /// Moves some triangles one by one, given where all nodes are and the forces on them.
    pub fn triangles(
        &self,
        mesh: &Mesh,
        triangles: &[u32],
        [position, force]: [&Planes; 2],
        [velocity, next]: [&mut Planes; 2],
    ) {
        for &triangle in triangles {
            let nodes = mesh.corners_of(triangle as usize);
            let share = self.inertias[mesh.groups.number_of(triangle as usize)].share;
            for axis in 0..2 {
                let forces = nodes.map(|node| force[axis][node]);
                let shared = match share > 0.0 {
                    true => (forces[0] + forces[1] + forces[2]) * share,
                    false => 0.0,
                };
                for (node, force) in nodes.into_iter().zip(forces) {
                    let before = self.before[axis][node];
                    let [mobility, position] = [self.mobility[axis][node], position[axis][node]];
                    [velocity[axis][node], next[axis][node]] =
                        self.leap.of_one(force - shared, mobility, before, position);
                }
            }
        }
    }

    /// Moves a range of single atoms.
    pub fn atoms(&self, nodes: &Range<usize>, [position, force]: [&Planes; 2], [velocity, next]: [&mut Planes; 2]) {
        if nodes.len() < FEW {
            for node in nodes.clone() {
                for axis in 0..2 {
                    let before = self.before[axis][node];
                    let [mobility, position] = [self.mobility[axis][node], position[axis][node]];
                    [velocity[axis][node], next[axis][node]] =
                        self.leap.of_one(force[axis][node], mobility, before, position);
                }
            }
            return;
        }
        for axis in 0..2 {
            let tasks = next[axis][nodes.clone()]
                .par_chunks_mut(CHUNK)
                .zip(velocity[axis][nodes.clone()].par_chunks_mut(CHUNK))
                .zip(nodes.clone().into_par_iter().step_by(CHUNK));
            tasks.for_each(|((next, velocity), from)| {
                let part = from..from + next.len();
                let atoms = Nodes {
                    before: Some(&self.before[axis][part.clone()]),
                    velocity,
                    force: &force[axis][part.clone()],
                    mobility: Mobility::Each(&self.mobility[axis][part.clone()]),
                    position: Some(&position[axis][part]),
                    next,
                };
                dispatch_to([atoms], self.leap, true, Answer::LUMPED);
            });
        }
    }
}

/// A range begins and ends with whole groups of triangles.
fn advance<const D: usize>(state: &mut State<D>, nodes: &Range<usize>, leap: Leap, drifts: bool) {
    let State {
        position,
        velocity,
        force,
        mobility,
        coupled,
        ..
    } = state;
    let coupled = coupled.iter().filter(|coupled| nodes.contains(&coupled.nodes.start));
    let parts: Vec<(Range<usize>, Option<MassCoupling>)> = match coupled.clone().next() {
        None => {
            let starts = nodes.clone().step_by(CHUNK);
            starts.map(|from| (from..nodes.end.min(from + CHUNK), None)).collect()
        }
        Some(_) => coupled
            .map(|coupled| (coupled.nodes.clone(), Some(coupled.coupling)))
            .collect(),
    };
    // All axes at once, so that threads wait for each other only once.
    let mut tasks = Vec::with_capacity(D * parts.len());
    for (axis, (position, velocity)) in position.iter_mut().zip(velocity).enumerate() {
        let [mut position, mut velocity] = [position, velocity].map(|plane| &mut plane[nodes.clone()]);
        for (part, coupling) in &parts {
            let [next, velocity] = [&mut position, &mut velocity].map(|plane| {
                let own = plane.split_off_mut(..part.len());
                own.expect("parts lie one after the other")
            });
            let nodes = Nodes {
                before: None,
                velocity,
                force: &force[axis][part.clone()],
                mobility: Mobility::Each(&mobility[axis][part.clone()]),
                position: None,
                next,
            };
            tasks.push((nodes, *coupling));
        }
    }
    tasks.into_par_iter().for_each(|(nodes, coupling)| {
        let Some(coupling) = coupling else {
            return dispatch_to([nodes], leap, drifts, Answer::LUMPED);
        };
        let answer = coupling.answer();
        match coupling.corners {
            3 => dispatch(nodes.corners(), leap, drifts, coupling.share),
            4 => dispatch_to::<4>(nodes.corners(), leap, drifts, answer),
            6 => dispatch_to::<6>(nodes.corners(), leap, drifts, answer),
            corners => unreachable!("no element has {corners} corners"),
        }
    });
}

/// Moves the corners of triangles.
fn dispatch(corners: [Nodes; 3], leap: Leap, drifts: bool, share: f64) {
    let answer = Answer {
        of_sum: share,
        ..Answer::LUMPED
    };
    match share > 0.0 {
        true => dispatch_to(corners, leap, drifts, answer),
        false => corners
            .into_iter()
            .for_each(|nodes| dispatch_to([nodes], leap, drifts, answer)),
    }
}

/// Nodes whose masses are coupled if there are several of them.
fn dispatch_to<const N: usize>(corners: [Nodes; N], leap: Leap, drifts: bool, answer: Answer) {
    Arch::new().dispatch(Moving {
        corners,
        answer,
        leap,
        drifts,
    });
}

/// The square of the speed of a node of a range, nm^2/ps^2: the largest.
pub fn largest_squared_speed<const D: usize>(state: &State<D>, nodes: Range<usize>) -> f64 {
    let squared = |node: usize| -> f64 { state.velocity.iter().map(|plane| plane[node] * plane[node]).sum() };
    let largest = |from: usize| {
        let squares = (from..nodes.end.min(from + CHUNK)).map(squared);
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
        kick_and_drift(state, &state.every_node(), leap(1, time));
        state.force[0][0] = -state.position[0][0];
        kick(state, &state.every_node(), 0.5 * time);
    }

    #[test]
    fn the_largest_speed_is_that_of_the_fastest_node() {
        let nodes = 3 * CHUNK + 7;
        let mut state = State::at_rest([vec![0.0; nodes], vec![0.0; nodes]], vec![2.0; nodes]);
        state.velocity[0].fill(0.5);
        [state.velocity[0][CHUNK + 3], state.velocity[1][CHUNK + 3]] = [-3.0, 4.0];
        assert_eq!(largest_squared_speed(&state, 0..nodes), 25.0);
        assert_eq!(largest_squared_speed(&state, CHUNK + 4..nodes), 0.25);
        assert_eq!(largest_squared_speed(&state, 0..0), 0.0);
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
