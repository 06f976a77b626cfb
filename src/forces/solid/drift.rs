//! Even motion of points, which brings no new pair within the cutoff.

use nalgebra::{Matrix3, Matrix4, Matrix4x3};

/// How much farther than the cutoff partners are listed, spacings.
const SKIN: f64 = 0.3;

/// Cutoff and radius of the lists, nm.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lengths {
    pub cutoff: f64,
    pub radius: f64,
}

impl Lengths {
    pub fn new(cutoff: f64, spacing: f64) -> Self {
        Self {
            cutoff,
            radius: cutoff + SKIN * spacing,
        }
    }
}

/// How points have moved on the whole: by what they would in a body that is shifted, turned and stretched evenly.
#[derive(Clone, Copy, Debug, Default)]
pub struct Drift {
    shift: [f64; 3],
    /// How the shift changes with the place: a row a component.
    gradient: [[f64; 3]; 3],
}

impl Drift {
    /// Where a point comes to be.
    #[inline(always)]
    pub fn place(&self, then: [f64; 3]) -> [f64; 3] {
        let component = |axis: usize| {
            let [a, b, c] = self.gradient[axis];
            then[axis] + self.shift[axis] + a * then[0] + b * then[1] + c * then[2]
        };
        [component(0), component(1), component(2)]
    }

    /// How far points may stray from it: even motion shortens no distance by more than the norm of its gradient.
    pub fn reach(&self, lengths: Lengths) -> f64 {
        let squares = self.gradient.iter().flatten().map(|entry| entry * entry);
        let norm = squares.sum::<f64>().sqrt();
        0.5 * ((1.0 - norm) * lengths.radius - lengths.cutoff)
    }
}

/// Sums over points from which their even motion follows by least squares.
#[derive(Clone, Copy, Debug, Default)]
pub struct Moments {
    /// 1, x, y, z times each other.
    places: [f64; 16],
    /// 1, x, y, z times the way.
    ways: [f64; 12],
}

impl Moments {
    pub fn add(&mut self, then: [f64; 3], now: [f64; 3]) {
        let terms = [1.0, then[0], then[1], then[2]];
        for (row, first) in terms.into_iter().enumerate() {
            (0..4).for_each(|column| self.places[4 * row + column] += first * terms[column]);
            (0..3).for_each(|axis| self.ways[3 * row + axis] += first * (now[axis] - then[axis]));
        }
    }

    pub fn numbers(&self) -> Vec<f64> {
        [&self.places[..], &self.ways[..]].concat()
    }

    pub fn from_numbers(numbers: &[f64]) -> Self {
        let mut moments = Self::default();
        moments.places.copy_from_slice(&numbers[..16]);
        moments.ways.copy_from_slice(&numbers[16..28]);
        moments
    }

    /// The even motion that is nearest to that of the points; none where they do not span space.
    pub fn drift(&self) -> Drift {
        let places = Matrix4::from_row_slice(&self.places);
        let ways = Matrix4x3::from_row_slice(&self.ways);
        let Some(solution) = places.cholesky().map(|factors| factors.solve(&ways)) else {
            return Drift::default();
        };
        let gradient: Matrix3<f64> = solution.fixed_rows::<3>(1).transpose();
        Drift {
            shift: [0, 1, 2].map(|axis| solution[(0, axis)]),
            gradient: [0, 1, 2].map(|axis| [0, 1, 2].map(|other| gradient[(axis, other)])),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_motion_is_found_and_leaves_nothing_to_stray() {
        let even = Drift {
            shift: [3.0, -1.0, 0.5],
            gradient: [[0.01, 0.02, 0.0], [-0.02, 0.0, 0.003], [0.0, 0.001, -0.01]],
        };
        let mut moments = Moments::default();
        let places: Vec<[f64; 3]> = (0..50u32)
            .map(|k| [7, 11, 13].map(|prime| f64::from(k * prime % 17)))
            .collect();
        places.iter().for_each(|&place| moments.add(place, even.place(place)));
        let found = Moments::from_numbers(&moments.numbers()).drift();
        for place in places {
            let [a, b] = [found.place(place), even.place(place)];
            assert!((0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-10));
        }
        let lengths = Lengths::new(1.3, 1.0);
        assert!(found.reach(lengths) < Drift::default().reach(lengths) && found.reach(lengths) > 0.1);
    }
}
