//! Central differences in time, in the form that knows positions and velocities at the same moment.
//!
//! [Deng2011] Fig. 4-5 and Eq. (3-34): half a kick, a drift, new forces, half a kick.

use rayon::prelude::*;

use crate::state::State;

/// Nodes in one parallel task.
const CHUNK: usize = 4096;

/// Advances the velocities by the forces over a time.
///
/// Coupled masses are a block m ((1 - 3 c) I + c 1 1^T) a triangle, and its inverse takes c times the sum of the three
/// forces off each before it divides by m (1 - 3 c).
pub fn kick(state: &mut State, time: f64) {
    let State {
        velocity,
        force,
        mobility,
        coupling,
        ..
    } = state;
    let coupled = 3 * coupling.len();
    for axis in 0..2 {
        let (triangles, rest) = velocity[axis].split_at_mut(coupled);
        let planes = triangles.par_chunks_mut(3 * CHUNK);
        let planes = planes
            .zip(force[axis].par_chunks(3 * CHUNK))
            .zip(mobility[axis].par_chunks(3 * CHUNK))
            .zip(coupling.par_chunks(CHUNK));
        planes.for_each(|(((velocity, force), mobility), coupling)| {
            for (triangle, share) in coupling.iter().enumerate() {
                let nodes = 3 * triangle..3 * triangle + 3;
                let shared = share * force[nodes.clone()].iter().sum::<f64>();
                nodes.for_each(|node| velocity[node] += time * mobility[node] * (force[node] - shared));
            }
        });
        let planes = rest.par_chunks_mut(CHUNK);
        let planes = planes
            .zip(force[axis][coupled..].par_chunks(CHUNK))
            .zip(mobility[axis][coupled..].par_chunks(CHUNK));
        planes.for_each(|((velocity, force), mobility)| {
            for ((v, f), mobility) in velocity.iter_mut().zip(force).zip(mobility) {
                *v += time * mobility * f;
            }
        });
    }
}

/// Advances the positions by the velocities over a time.
pub fn drift(state: &mut State, time: f64) {
    let State { position, velocity, .. } = state;
    for axis in 0..2 {
        let planes = position[axis]
            .par_chunks_mut(CHUNK)
            .zip(velocity[axis].par_chunks(CHUNK));
        planes.for_each(|(position, velocity)| {
            position.iter_mut().zip(velocity).for_each(|(x, v)| *x += time * v);
        });
    }
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
        kick(state, 0.5 * time);
        drift(state, time);
        state.force[0][0] = -state.position[0][0];
        kick(state, 0.5 * time);
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
