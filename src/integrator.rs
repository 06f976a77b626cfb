//! Central differences in time, in the form that knows positions and velocities at the same moment.
//!
//! [Deng2011] Fig. 4-5 and Eq. (3-34): half a kick, a drift, new forces, half a kick.

use std::ops::Range;

use pulp::Arch;
use rayon::prelude::*;

use crate::state::State;

/// Triangles in one parallel task.
const CHUNK: usize = 1024;

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

/// A range begins with the first node of an element.
fn advance(state: &mut State, nodes: &Range<usize>, kicks: u32, kick: f64, drift: Option<f64>) {
    let State {
        position,
        velocity,
        force,
        mobility,
        coupling,
        ..
    } = state;
    let coupling = &coupling[coupling.len().min(nodes.start / 3)..];
    let [position_x, position_y] = position.each_mut().map(|plane| &mut plane[nodes.clone()]);
    let [velocity_x, velocity_y] = velocity.each_mut().map(|plane| &mut plane[nodes.clone()]);
    let [force_x, force_y] = force.each_ref().map(|plane| &plane[nodes.clone()]);
    let [mobility_x, mobility_y] = mobility.each_ref().map(|plane| &plane[nodes.clone()]);
    let along_x = tasks(position_x, velocity_x, force_x, mobility_x);
    let along_y = tasks(position_y, velocity_y, force_y, mobility_y);
    // Both axes at once, so that threads wait for each other only once.
    along_x.chain(along_y).for_each(|(chunk, (moved, (force, mobility)))| {
        let (position, velocity) = moved;
        let first = coupling.len().min(chunk * CHUNK);
        let coupling = &coupling[first..coupling.len().min(first + position.len() / 3)];
        let nodes = 3 * coupling.len();
        Arch::new().dispatch(|| {
            for _ in 0..kicks {
                kick_coupled(
                    &mut velocity[..nodes],
                    &force[..nodes],
                    &mobility[..nodes],
                    coupling,
                    kick,
                );
                let single = velocity[nodes..]
                    .iter_mut()
                    .zip(&force[nodes..])
                    .zip(&mobility[nodes..]);
                single.for_each(|((v, f), mobility)| *v += kick * mobility * f);
            }
            if let Some(time) = drift {
                position.iter_mut().zip(&*velocity).for_each(|(x, v)| *x += time * v);
            }
        });
    });
}

type Task<'a> = (usize, ((&'a mut [f64], &'a mut [f64]), (&'a [f64], &'a [f64])));

/// The motion along one axis, nodes in tasks.
fn tasks<'a>(
    position: &'a mut [f64],
    velocity: &'a mut [f64],
    force: &'a [f64],
    mobility: &'a [f64],
) -> impl IndexedParallelIterator<Item = Task<'a>> {
    let positions = position.par_chunks_mut(3 * CHUNK);
    let velocities = velocity.par_chunks_mut(3 * CHUNK);
    let forces = force.par_chunks(3 * CHUNK);
    let mobilities = mobility.par_chunks(3 * CHUNK);
    positions.zip(velocities).zip(forces.zip(mobilities)).enumerate()
}

/// Triangles whose nodes have coupled masses.
#[inline(always)]
fn kick_coupled(velocity: &mut [f64], force: &[f64], mobility: &[f64], coupling: &[f64], time: f64) {
    for (triangle, share) in coupling.iter().enumerate() {
        let nodes = 3 * triangle..3 * triangle + 3;
        let shared = share * force[nodes.clone()].iter().sum::<f64>();
        nodes.for_each(|node| velocity[node] += time * mobility[node] * (force[node] - shared));
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
