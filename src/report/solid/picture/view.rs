//! From where a solid is seen.

use std::ops::Range;

/// How a solid is seen: without perspective, to scale.
pub struct View {
    /// To the right, upwards, and towards who looks, of length 1.
    directions: [[f64; 3]; 3],
    /// What the two axes of the picture are.
    pub names: [&'static str; 2],
    /// To the right and upwards, nm.
    pub ranges: [Range<f64>; 2],
}

/// A solid whose shortest side is below this share of the longest is a plate.
const THIN: f64 = 0.2;

/// Who looks aslant looks down by this angle, and from this far beside, degrees.
const DOWN: f64 = 35.0;
const BESIDE: f64 = 25.0;

/// Lengths along x, y and z.
fn lengths(reference: &[[f64; 3]]) -> [f64; 3] {
    [0, 1, 2].map(|axis| {
        let along = || reference.iter().map(|point| point[axis]);
        along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
    })
}

fn shortest(lengths: [f64; 3]) -> usize {
    (0..3).min_by(|&a, &b| lengths[a].total_cmp(&lengths[b])).unwrap_or(2)
}

fn axis(number: usize) -> [f64; 3] {
    let mut direction = [0.0; 3];
    direction[number] = 1.0;
    direction
}

/// Whether a solid is thin along one of its axes.
pub fn is_plate(reference: &[[f64; 3]]) -> bool {
    let lengths = lengths(reference);
    lengths[shortest(lengths)] < THIN * lengths.into_iter().fold(0.0, f64::max)
}

impl View {
    /// Along the shortest side of the reference places, so that all places are seen with a margin around them.
    pub fn from_above(reference: &[[f64; 3]], places: &[[f64; 3]], margin: f64) -> Self {
        let lengths = lengths(reference);
        let shortest = shortest(lengths);
        // Right-handed: z towards who looks shows x and y.
        let mut axes = [(shortest + 1) % 3, (shortest + 2) % 3, shortest];
        if lengths[axes[1]] > lengths[axes[0]] && shortest != 2 {
            axes.swap(0, 1);
        }
        let names = [axes[0], axes[1]].map(|axis| ["x (nm)", "y (nm)", "z (nm)"][axis]);
        Self::of(axes.map(axis), names, places, margin)
    }

    /// Aslant from above: onto a plate, or with y upwards.
    pub fn aslant(reference: &[[f64; 3]], places: &[[f64; 3]], margin: f64) -> Self {
        let up = match is_plate(reference) {
            true => shortest(lengths(reference)),
            false => 1,
        };
        let [right, back, up] = [(up + 1) % 3, (up + 2) % 3, up].map(axis);
        let along = |a: [f64; 3], of_a: f64, b: [f64; 3], of_b: f64| [0, 1, 2].map(|i| of_a * a[i] + of_b * b[i]);
        let [(sine, cosine), (down, level)] = [BESIDE, DOWN].map(|degrees| degrees.to_radians().sin_cos());
        let across = along(right, cosine, back, sine);
        let towards = along(right, sine, back, -cosine);
        let directions = [
            across,
            along(up, level, towards, -down),
            along(up, down, towards, level),
        ];
        Self::of(directions, ["aslant, to scale (nm)", "(nm)"], places, margin)
    }

    fn of(directions: [[f64; 3]; 3], names: [&'static str; 2], places: &[[f64; 3]], margin: f64) -> Self {
        let mut view = Self {
            directions,
            names,
            ranges: [0.0..0.0, 0.0..0.0],
        };
        let is_finite = |place: &&[f64; 3]| place.iter().all(|part| part.is_finite());
        view.ranges = [0, 1].map(|part| {
            let along = || places.iter().filter(is_finite).map(|&place| view.seen(place)[part]);
            along().fold(f64::INFINITY, f64::min) - margin..along().fold(f64::NEG_INFINITY, f64::max) + margin
        });
        view
    }

    /// To the right, upwards, and towards who looks, nm.
    pub fn seen(&self, place: [f64; 3]) -> [f64; 3] {
        let along = |direction: [f64; 3]| (0..3).map(|axis| direction[axis] * place[axis]).sum();
        self.directions.map(along)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_right_handed_and_of_length_one_and_a_block_stands_on_its_feet() {
        let plate = [[0.0; 3], [40.0, 30.0, 2.0]];
        let block = [[0.0; 3], [40.0, 30.0, 20.0]];
        assert!(is_plate(&plate) && !is_plate(&block));
        for points in [plate, block] {
            for view in [
                View::from_above(&points, &points, 1.0),
                View::aslant(&points, &points, 1.0),
            ] {
                let [right, up, near] = view.directions;
                for i in 0..3 {
                    let [j, k] = [(i + 1) % 3, (i + 2) % 3];
                    assert!((right[j] * up[k] - right[k] * up[j] - near[i]).abs() < 1e-12);
                }
            }
        }
        let upwards = |points: [[f64; 3]; 2]| View::aslant(&points, &points, 1.0).directions[1];
        assert!(upwards(plate)[2] > 0.8 && upwards(block)[1] > 0.8);
    }
}
