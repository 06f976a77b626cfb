//! Bonds across the faces between tetrahedra and octahedra.
//!
//! Each site of the tetrahedron's face has a bond to three sites of the octahedron's. Those to one side are a patch: a
//! triangle of bonds whose vector is affine over it. With K = n - 2 steps along an edge of the tetrahedron, corners T_i and
//! O_i, and volume coordinates l_i, the vector from the octahedron's site is
//! d_b = sum l_i (T_i - K/(K + 1) O_i) - O_b/(K + 1), b = 1, 2, 3.

use pulp::Simd;

use super::inside::within;
use super::measure::Held;
use super::vector::Vector;
use crate::lanes::{Lanes, Mask};
use crate::potential::{CutPotential, PairShape};

/// Forces on the corners of both faces.
pub struct FaceForces<L: Simd> {
    pub on_tetrahedron: [Vector<L>; 3],
    pub on_octahedron: [Vector<L>; 3],
}

/// The corner vectors of a face.
#[derive(Clone, Copy)]
pub struct Face<L: Simd> {
    size: i32,
    tetrahedron: [Vector<L>; 3],
    octahedron: [Vector<L>; 3],
    /// T_i - K/(K + 1) O_i
    gaps: [Vector<L>; 3],
}

impl<L: Simd> Face<L> {
    /// A face between parts of blocks of so many sites an edge.
    #[inline(always)]
    pub fn new(size: i32, tetrahedron: [Vector<L>; 3], octahedron: [Vector<L>; 3]) -> Self {
        let share = -f64::from(size - 2) / f64::from(size - 1);
        let gaps = [
            octahedron[0].scaled_add(share, tetrahedron[0]),
            octahedron[1].scaled_add(share, tetrahedron[1]),
            octahedron[2].scaled_add(share, tetrahedron[2]),
        ];
        Self {
            size,
            tetrahedron,
            octahedron,
            gaps,
        }
    }

    /// The bond at a corner of a patch.
    #[inline(always)]
    fn corner(&self, patch: usize, corner: usize) -> Vector<L> {
        self.octahedron[patch].scaled_add(-1.0 / f64::from(self.size - 1), self.gaps[corner])
    }

    /// Whether any bond is longer than the first limit, and where any is longer than the second, squared. |d| is convex over a
    /// patch, so that its corners tell.
    #[inline(always)]
    pub fn exceeds(&self, simd: L, limits: [f64; 2]) -> [Mask<L>; 2] {
        let mut exceeds = [Mask::all(simd, false); 2];
        for patch in 0..3 {
            for corner in 0..3 {
                let squared = self.corner(patch, corner).squared();
                exceeds[0] = exceeds[0].or(squared.is_above(limits[0]));
                exceeds[1] = exceeds[1].or(squared.is_above(limits[1]));
            }
        }
        exceeds
    }

    /// Where second neighbours across the face may be nearer than a limit, squared. Those to one side are a triangle of n - 3
    /// steps an edge, over which the square is convex: nowhere less than its tangent in the middle.
    #[inline(always)]
    pub fn second_neighbours_below(&self, simd: L, limit: f64) -> Mask<L> {
        let (t, o, n) = (&self.tetrahedron, &self.octahedron, f64::from(self.size));
        let [of_t, of_o] = [(n - 3.0) / (n - 2.0), -(n - 3.0) / (n - 1.0)];
        let ends = [
            o[0].scaled_add(of_o, t[0].scaled(of_t)),
            o[1].scaled_add(of_o, t[1].scaled(of_t)),
            o[2].scaled_add(of_o, t[2].scaled(of_t)),
        ];
        let middle = (ends[0] + ends[1] + ends[2]).scaled(1.0 / 3.0);
        let mut below = Mask::all(simd, false);
        for side in 0..3 {
            let others = o[(side + 1) % 3] + o[(side + 2) % 3];
            let bond = others.scaled_add(-1.0 / (n - 1.0), t[side].scaled_add(1.0 / (n - 2.0), middle));
            let squared = bond.squared();
            for end in ends {
                let tangent = bond.dot(end - middle).times_add(2.0, squared);
                below = below.or(tangent.is_below(limit));
            }
        }
        below
    }

    /// The sum over all bonds, all of which are within the cutoff; `untouched` if no treatment of the cutoff reaches any.
    #[inline(always)]
    pub fn sum<S: PairShape, const MEASURED: bool>(
        &self,
        simd: L,
        law: &CutPotential<S>,
        untouched: bool,
    ) -> (FaceForces<L>, Held<L, MEASURED>) {
        let zero = Lanes::all(simd, 0.0);
        let one = Lanes::all(simd, 1.0);
        let steps = self.size - 2;
        let per_step = 1.0 / f64::from(steps);
        let along = [
            (self.gaps[1] - self.gaps[0]).scaled(per_step),
            (self.gaps[2] - self.gaps[0]).scaled(per_step),
        ];
        let mut held = Held::new(simd);
        // What pulls at T_i, and at O_b along the bonds of its own patch.
        let mut shares = [Vector::zero(simd); 3];
        let mut own = [Vector::zero(simd); 3];
        for patch in 0..3 {
            let start = self.corner(patch, 0);
            let [mut whole, mut first, mut second] = [zero; 3];
            let [mut both_first, mut mixed, mut both_second] = [zero; 3];
            for q in 0..=steps {
                let row = along[1].scaled_add(f64::from(q), start);
                let [mut row_whole, mut row_first, mut row_square] = [zero; 3];
                for p in 0..=steps - q {
                    let at = f64::from(p);
                    let bond = along[0].scaled_add(at, row);
                    let squared = bond.squared();
                    let slope = if MEASURED || !untouched {
                        let values = law.values(simd, squared);
                        if MEASURED {
                            held.add(values, bond, within(simd, law, squared), one);
                        }
                        values[1]
                    } else {
                        law.untouched_slopes(simd, squared)
                    };
                    row_whole = row_whole + slope;
                    row_first = slope.times_add(at, row_first);
                    row_square = slope.times_add(at * at, row_square);
                }
                let q = f64::from(q);
                whole = whole + row_whole;
                first = first + row_first;
                both_first = both_first + row_square;
                second = row_whole.times_add(q, second);
                mixed = row_first.times_add(q, mixed);
                both_second = row_whole.times_add(q * q, both_second);
            }
            let force = along[1].times_add(second, along[0].times_add(first, start.times(whole)));
            let of_first = along[1].times_add(mixed, along[0].times_add(both_first, start.times(first)));
            let of_second = along[1].times_add(both_second, along[0].times_add(mixed, start.times(second)));
            let [l1, l2] = [of_first.scaled(per_step), of_second.scaled(per_step)];
            shares[0] = shares[0] + (force - l1 - l2);
            shares[1] = shares[1] + l1;
            shares[2] = shares[2] + l2;
            own[patch] = force;
        }
        let [of_all, of_own] = [f64::from(self.size - 2), 1.0].map(|share| share / f64::from(self.size - 1));
        let none = Vector::zero(simd);
        let forces = FaceForces {
            on_tetrahedron: [none - shares[0], none - shares[1], none - shares[2]],
            on_octahedron: [
                own[0].scaled_add(of_own, shares[0].scaled(of_all)),
                own[1].scaled_add(of_own, shares[1].scaled(of_all)),
                own[2].scaled_add(of_own, shares[2].scaled(of_all)),
            ],
        };
        (forces, held)
    }
}
