//! Velocities that a specimen starts with, so that no shock enters from a face that moves.

use crate::state::State;

/// Velocity that grows evenly along an axis from one face to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramp<const D: usize> {
    /// The direction in which it grows, of length one.
    pub along: [f64; D],
    /// How far along it the two faces stand, nm.
    pub from: f64,
    pub to: f64,
    /// Velocities there, nm/ps.
    pub velocities: [[f64; D]; 2],
}

impl<const D: usize> Ramp<D> {
    /// Gives every node the velocity of its reference place.
    pub fn set(&self, reference: &[Vec<f64>; D], state: &mut State<D>) {
        for node in 0..state.nodes() {
            if !state.has(node) {
                continue;
            }
            let place: f64 = (0..D).map(|axis| self.along[axis] * reference[axis][node]).sum();
            let share = ((place - self.from) / (self.to - self.from)).clamp(0.0, 1.0);
            let [low, high] = self.velocities;
            for axis in 0..D {
                state.velocity[axis][node] = low[axis] + share * (high[axis] - low[axis]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn velocities_grow_evenly_from_face_to_face_and_not_beyond() {
        let reference = [vec![0.0, 9.0, 9.0, 9.0], vec![0.0, 1.0, 2.0, 7.0]];
        let mut state = State::at_rest(reference.clone(), vec![1.0; 4]);
        let ramp = Ramp {
            along: [0.0, 1.0],
            from: 1.0,
            to: 3.0,
            velocities: [[0.0, 0.0], [0.5, 2.0]],
        };
        ramp.set(&reference, &mut state);
        assert_eq!(state.velocity, [vec![0.0, 0.0, 0.25, 0.5], vec![0.0, 0.0, 1.0, 2.0]]);
    }
}
