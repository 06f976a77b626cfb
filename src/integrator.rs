//! Central differences in time, in the form that knows positions and velocities at the same moment.
//!
//! [Deng2011] Fig. 4-5 and Eq. (3-34): half a kick, a drift, new forces, half a kick.

use std::ops::Range;

use pulp::Arch;
use rayon::prelude::*;

use crate::state::{Coupled, State};

/// Nodes in one parallel task.
const CHUNK: usize = 4096;

/// Advances the velocities of ranges of nodes by the forces over a time.
///
/// Coupled masses are a block m ((1 - 3 c) I + c 1 1^T) a triangle, and its inverse takes c times the sum of the three
/// forces off each before it divides by m (1 - 3 c).
pub fn kick(state: &mut State, nodes: &[Range<usize>], time: f64) {
    nodes.iter().for_each(|nodes| advance(state, nodes, 1, time, None));
}

/// Advances the velocities by so many equal kicks over half a time each, and with them the positions over the time.
///
/// Between two steps in which nobody looks, two kicks follow each other; together with the drift they pass through the
/// memory once.
pub fn kick_and_drift(state: &mut State, nodes: &[Range<usize>], kicks: u32, time: f64) {
    nodes
        .iter()
        .for_each(|nodes| advance(state, nodes, kicks, 0.5 * time, Some(time)));
}

/// A range begins and ends with whole groups of triangles.
fn advance(state: &mut State, nodes: &Range<usize>, kicks: u32, kick: f64, drift: Option<f64>) {
    let State {
        position,
        velocity,
        force,
        mobility,
        coupled,
        ..
    } = state;
    let coupled = coupled.iter().filter(|coupled| nodes.contains(&coupled.nodes.start));
    let parts: Vec<Part> = match coupled.clone().next() {
        None => nodes
            .clone()
            .step_by(CHUNK)
            .map(|from| Part::lumped(from..nodes.end.min(from + CHUNK)))
            .collect(),
        Some(_) => coupled.map(Part::coupled).collect(),
    };
    let planes = |axis: usize, position, velocity| {
        let [mut position, mut velocity]: [&mut [f64]; 2] = [position, velocity];
        let mut at = 0;
        let parts = parts.iter().map(|part| {
            let [position, velocity] = [&mut position, &mut velocity].map(|plane| {
                let own = plane
                    .split_off_mut(..part.nodes.end - at)
                    .expect("parts lie one after the other");
                &mut own[part.nodes.start - at..]
            });
            at = part.nodes.end;
            Motion {
                position,
                velocity,
                force: &force[axis][part.nodes.clone()],
                mobility: &mobility[axis][part.nodes.clone()],
                share: part.share,
            }
        });
        parts.collect::<Vec<Motion>>()
    };
    let [position_x, position_y] = position;
    let [velocity_x, velocity_y] = velocity;
    // Both axes at once, so that threads wait for each other only once.
    let mut motions = planes(0, position_x, velocity_x);
    motions.extend(planes(1, position_y, velocity_y));
    motions.into_par_iter().for_each(|mut motion| {
        Arch::new().dispatch(|| {
            for _ in 0..kicks {
                motion.kick(kick);
            }
            if let Some(time) = drift {
                motion.drift(time);
            }
        });
    });
}

/// Nodes that one thread moves.
struct Part {
    nodes: Range<usize>,
    /// Of triangles with coupled masses.
    share: Option<f64>,
}

impl Part {
    fn lumped(nodes: Range<usize>) -> Self {
        Self { nodes, share: None }
    }

    fn coupled(coupled: &Coupled) -> Self {
        Self {
            nodes: coupled.nodes.clone(),
            share: Some(coupled.share),
        }
    }
}

/// Nodes in motion along one axis.
struct Motion<'a> {
    position: &'a mut [f64],
    velocity: &'a mut [f64],
    force: &'a [f64],
    mobility: &'a [f64],
    share: Option<f64>,
}

impl Motion<'_> {
    #[inline(always)]
    fn kick(&mut self, time: f64) {
        let Some(share) = self.share else {
            let nodes = self.velocity.iter_mut().zip(self.force).zip(self.mobility);
            nodes.for_each(|((velocity, force), mobility)| *velocity += time * mobility * force);
            return;
        };
        let count = self.force.len() / 3;
        for triangle in 0..count {
            let nodes = [triangle, triangle + count, triangle + 2 * count];
            let shared = share * nodes.map(|node| self.force[node]).iter().sum::<f64>();
            for node in nodes {
                self.velocity[node] += time * self.mobility[node] * (self.force[node] - shared);
            }
        }
    }

    #[inline(always)]
    fn drift(&mut self, time: f64) {
        let nodes = self.position.iter_mut().zip(&*self.velocity);
        nodes.for_each(|(position, velocity)| *position += time * velocity);
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
        kick_and_drift(state, &state.every_node(), 1, time);
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
