//! A plane across a part of which no bond holds, though nothing has been taken out.
//!
//! A pair of sites is severed where the line between them, in the reference state, crosses the plane before its end. One that
//! crosses it exactly at the end is whole. What is severed stays so, wherever the two sites come to be.

use nalgebra::Vector3;

/// The primitive vectors in the laboratory, nm.
type Vectors = [[f64; 3]; 3];

/// A severed plane between two layers of sites, from a face of the solid up to its end.
///
/// Layers are told by whole numbers: the sum of the coordinates of a site, each times a number of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cut {
    /// The factors of the coordinates for layers parallel to the plane.
    pub normal: [i32; 3],
    /// It lies midway between this layer and the one before.
    pub layer: i32,
    /// The factors for layers that rise from the face at which it begins.
    pub into: [i32; 3],
    /// It ends midway between this layer of those and the one before.
    pub end: i32,
}

/// A cut in the laboratory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Out of its plane, and along it from the face at which it begins, of length 1.
    pub up: [f64; 3],
    pub ahead: [f64; 3],
    /// A place at its end, nm.
    pub end: [f64; 3],
}

/// The layer of a site.
#[inline(always)]
pub fn layer([a, b, c]: [i32; 3], [i, j, k]: [i32; 3]) -> i32 {
    a * i + b * j + c * k
}

impl Cut {
    /// Whether a pair of sites is severed.
    #[inline(always)]
    pub fn severs(&self, a: [i32; 3], b: [i32; 3]) -> bool {
        let [from, to] = [a, b].map(|site| layer(self.normal, site));
        (from < self.layer) != (to < self.layer) && self.is_crossed_before_its_end(a, b, [from, to])
    }

    #[cold]
    fn is_crossed_before_its_end(&self, a: [i32; 3], b: [i32; 3], [from, to]: [i32; 2]) -> bool {
        // The line crosses the plane at `across` of `whole` half layers; all in whole numbers.
        let [across, whole] = [2 * self.layer - 1 - 2 * from, 2 * (to - from)].map(i64::from);
        let [start, stop] = [a, b].map(|site| i64::from(layer(self.into, site)));
        let at = 2 * (start * whole + across * (stop - start));
        let end = i64::from(2 * self.end - 1) * whole;
        if whole > 0 { at < end } else { at > end }
    }

    /// Where it lies in a crystal with these primitive vectors, nm.
    pub fn placed(&self, vectors: &Vectors) -> Placed {
        let [up, into] = [self.normal, self.into].map(|factors| gradient(factors, vectors));
        let normal = up.normalize();
        let ahead = (into - normal * normal.dot(&into)).normalize();
        // The place where both numbers are those of the end, in the plane of the two gradients.
        let [layer, end] = [self.layer, self.end].map(|layer| f64::from(layer) - 0.5);
        let height = layer / up.dot(&normal);
        let way = (end - into.dot(&normal) * height) / into.dot(&ahead);
        Placed {
            up: normal.into(),
            ahead: ahead.into(),
            end: (normal * height + ahead * way).into(),
        }
    }
}

impl Placed {
    /// How far a place is ahead of the end and above the plane, nm.
    pub fn coordinates(&self, place: [f64; 3]) -> [f64; 2] {
        let way = Vector3::from(place) - Vector3::from(self.end);
        [self.ahead, self.up].map(|direction| way.dot(&Vector3::from(direction)))
    }

    /// How far a place is from the severed part of the plane, nm.
    pub fn distance(&self, place: [f64; 3]) -> f64 {
        let [ahead, above] = self.coordinates(place);
        ahead.max(0.0).hypot(above)
    }
}

/// How fast the number of the layer rises, 1/nm.
fn gradient(factors: [i32; 3], vectors: &Vectors) -> Vector3<f64> {
    let [a, b, c] = vectors.map(Vector3::from);
    let volume = a.dot(&b.cross(&c));
    let [i, j, k] = factors.map(f64::from);
    (b.cross(&c) * i + c.cross(&a) * j + a.cross(&b) * k) / volume
}

/// Distance between neighbouring layers, nm.
pub fn height(factors: [i32; 3], vectors: &Vectors) -> f64 {
    1.0 / gradient(factors, vectors).norm()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::fcc::half_vectors_within;
    use crate::mesh::solid::sites::Frame;

    const CUT: Cut = Cut {
        normal: [0, 1, 0],
        layer: 6,
        into: [1, 0, 0],
        end: 10,
    };

    #[test]
    fn a_pair_is_severed_where_its_line_crosses_the_plane_before_its_end_and_only_there() {
        assert!(
            CUT.severs([3, 5, 0], [3, 6, 2]) && CUT.severs([3, 6, 2], [3, 5, 0]),
            "in either order"
        );
        assert!(
            !CUT.severs([3, 5, 0], [4, 5, 0]) && !CUT.severs([3, 6, 0], [3, 7, 0]),
            "on one side"
        );
        assert!(!CUT.severs([10, 5, 0], [10, 6, 0]), "ahead of its end");
        assert!(
            !CUT.severs([10, 5, 0], [9, 6, 0]) && !CUT.severs([9, 6, 0], [10, 5, 0]),
            "exactly at its end"
        );
        assert!(
            CUT.severs([9, 5, 0], [9, 6, 0]) && CUT.severs([12, 2, 0], [8, 7, 0]),
            "it crosses at 9.2"
        );
        let from_the_other_side = Cut {
            into: [-1, 0, 0],
            end: -9,
            ..CUT
        };
        for vector in half_vectors_within(3.0) {
            for i in 4..16 {
                let [a, b] = [[i, 5, 0], [0, 1, 2].map(|axis| [i, 5, 0][axis] + vector[axis])];
                if a[1].max(b[1]) > 5 {
                    let crossing = f64::from(a[0]) + 0.5 / f64::from(b[1] - a[1]) * f64::from(b[0] - a[0]);
                    assert_eq!(CUT.severs(a, b), crossing < 9.5, "{a:?} {b:?}");
                    assert_eq!(from_the_other_side.severs(a, b), crossing > 9.5, "{a:?} {b:?}");
                }
            }
        }
    }

    #[test]
    fn a_cut_lies_midway_between_layers_and_ends_midway_between_those_along_it() {
        const ROUNDING: f64 = 1e-12;
        let frames = [
            Frame::of_blocks(0.25),
            Frame::along([[1, 1, -2], [-1, 1, 0], [1, 1, 1]], 0.25),
        ];
        for frame in frames {
            for (normal, into) in [([0, 1, 0], [1, 0, 0]), ([1, 1, 1], [1, -1, 0])] {
                let cut = Cut { normal, into, ..CUT };
                let placed = cut.placed(&frame.vectors);
                let lattice = frame.lattice(placed.end);
                let number =
                    |factors: [i32; 3]| (0..3).map(|axis| f64::from(factors[axis]) * lattice[axis]).sum::<f64>();
                assert!((number(normal) - 5.5).abs() < ROUNDING && (number(into) - 9.5).abs() < ROUNDING);
                let behind = [0, 1, 2].map(|axis| placed.end[axis] - 2.0 * placed.ahead[axis] + 0.3 * placed.up[axis]);
                let ahead = [0, 1, 2].map(|axis| placed.end[axis] + 0.4 * placed.ahead[axis] - 0.3 * placed.up[axis]);
                assert!(
                    (placed.distance(behind) - 0.3).abs() < ROUNDING && (placed.distance(ahead) - 0.5).abs() < ROUNDING
                );
            }
            assert!((height([0, 1, 0], &frame.vectors) - 0.25 * (2f64 / 3.0).sqrt()).abs() < ROUNDING);
            assert!((height([1, 1, 1], &frame.vectors) - 0.25 * (2f64 / 3.0).sqrt()).abs() < ROUNDING);
        }
    }
}
