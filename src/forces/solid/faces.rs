//! Bonds across the faces between tetrahedra and octahedra.
//!
//! Each site of the tetrahedron's face has a bond to three sites of the octahedron's. Those to one side are a patch: a
//! triangle of bonds whose vector is affine over it. With K = n - 2 steps along an edge of the tetrahedron, corners T_i and
//! O_i, and volume coordinates l_i, the vector from the octahedron's site is
//! d_b = sum l_i (T_i - K/(K + 1) O_i) - O_b/(K + 1), b = 1, 2, 3.

use pulp::Simd;

use super::certified::Few;
use super::inside::within;
use super::measure::Held;
use super::nodal::bond_count;
use super::rule::Sample;
use super::vector::Vector;
use crate::lanes::{Lanes, Mask};
use crate::potential::{CutPotential, PairShape};

/// Which bonds across a face are looked at.
#[derive(Clone, Copy)]
pub enum Bonds<'a> {
    /// All, or these places that stand for them where they are hardly bent.
    All(Option<&'a Few>),
    /// Those at the corners of the tetrahedron's face, which each stand for half of what a node of the tetrahedron does, and half
    /// of what one of the octahedron does where one is at their other end.
    OfNodes { tetrahedron: f64, octahedron: f64 },
}

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

    /// Where few places stand for all bonds.
    #[inline(always)]
    fn is_hardly_bent(&self, simd: L, few: &Few) -> Mask<L> {
        let [a, b, c] = self.gaps;
        let [least, most] = few.squared_lengths;
        let mut excluded = Mask::all(simd, false);
        for edge in [b - a, c - a, c - b] {
            excluded = excluded.or(edge.squared().is_above(few.squared_bend));
        }
        for patch in 0..3 {
            for corner in 0..3 {
                let squared = self.corner(patch, corner).squared();
                excluded = excluded.or(squared.is_below(least)).or(squared.is_above(most));
            }
        }
        excluded.opposite()
    }

    /// The bonds of a patch with nodes at their ends, where a node of the tetrahedron and one of the octahedron stand for so many
    /// sites: [Deng2011] Eq. (3-33). The bond at a corner ends at the octahedron's node of that corner in one patch alone.
    fn samples_of_nodes(&self, patch: usize, [tetrahedron, octahedron]: [f64; 2]) -> [Sample; 3] {
        let far = f64::from(self.size - 2);
        let corners = [[0.0, 0.0], [far, 0.0], [0.0, far]];
        std::array::from_fn(|corner| Sample {
            at: corners[corner],
            weight: bond_count([tetrahedron, if corner == patch { octahedron } else { 0.0 }]),
        })
    }

    /// The sum over bonds, all of which are within the cutoff; `untouched` if no treatment of the cutoff reaches any.
    #[inline(always)]
    pub fn sum<S: PairShape, const MEASURED: bool>(
        &self,
        simd: L,
        law: &CutPotential<S>,
        untouched: bool,
        bonds: Bonds,
    ) -> (FaceForces<L>, Held<L, MEASURED>) {
        let steps = self.size - 2;
        let per_step = 1.0 / f64::from(steps);
        let along = [
            (self.gaps[1] - self.gaps[0]).scaled(per_step),
            (self.gaps[2] - self.gaps[0]).scaled(per_step),
        ];
        let few = match bonds {
            Bonds::All(few) => few.map(|few| (few, self.is_hardly_bent(simd, few))),
            Bonds::OfNodes { .. } => None,
        };
        let few = few.filter(|(_, mask)| mask.any());
        let all_few = few.is_some_and(|(_, mask)| mask.every());
        let mut held = Held::new(simd);
        // What pulls at T_i, and at O_b along the bonds of its own patch.
        let mut shares = [Vector::zero(simd); 3];
        let mut own = [Vector::zero(simd); 3];
        for patch in 0..3 {
            let start = self.corner(patch, 0);
            let mut of_patch = Held::<L, MEASURED>::new(simd);
            let mut moments = Moments::new(simd);
            if let Bonds::OfNodes {
                tetrahedron,
                octahedron,
            } = bonds
            {
                let samples = self.samples_of_nodes(patch, [tetrahedron, octahedron]);
                moments = sum_few(simd, law, &samples, start, along, untouched, &mut of_patch);
            } else if !all_few {
                moments = sum_all(simd, law, steps, start, along, untouched, &mut of_patch);
            }
            if let Some((few, mask)) = few {
                let mut of_few = Held::<L, MEASURED>::new(simd);
                let by_few = sum_few(simd, law, &few.samples, start, along, true, &mut of_few);
                moments = by_few.where_or(mask, moments);
                of_patch = of_few.where_or(mask, of_patch);
            }
            held.join(of_patch);
            let Moments {
                whole,
                first,
                second,
                both_first,
                mixed,
                both_second,
            } = moments;
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

/// Sums over a patch of phi'/r, times the place p and q of the bond in steps from the first corner: 1, p, q, p p, p q, q q.
#[derive(Clone, Copy)]
struct Moments<L: Simd> {
    whole: Lanes<L>,
    first: Lanes<L>,
    second: Lanes<L>,
    both_first: Lanes<L>,
    mixed: Lanes<L>,
    both_second: Lanes<L>,
}

impl<L: Simd> Moments<L> {
    #[inline(always)]
    fn new(simd: L) -> Self {
        let zero = Lanes::all(simd, 0.0);
        Self {
            whole: zero,
            first: zero,
            second: zero,
            both_first: zero,
            mixed: zero,
            both_second: zero,
        }
    }

    #[inline(always)]
    fn where_or(self, mask: Mask<L>, other: Self) -> Self {
        Self {
            whole: self.whole.where_or(mask, other.whole),
            first: self.first.where_or(mask, other.first),
            second: self.second.where_or(mask, other.second),
            both_first: self.both_first.where_or(mask, other.both_first),
            mixed: self.mixed.where_or(mask, other.mixed),
            both_second: self.both_second.where_or(mask, other.both_second),
        }
    }
}

/// Every bond of a patch.
#[inline(always)]
fn sum_all<S: PairShape, L: Simd, const MEASURED: bool>(
    simd: L,
    law: &CutPotential<S>,
    steps: i32,
    start: Vector<L>,
    along: [Vector<L>; 2],
    untouched: bool,
    held: &mut Held<L, MEASURED>,
) -> Moments<L> {
    let one = Lanes::all(simd, 1.0);
    let mut sums = Moments::new(simd);
    for q in 0..=steps {
        let row = along[1].scaled_add(f64::from(q), start);
        let [mut whole, mut first, mut square] = [Lanes::all(simd, 0.0); 3];
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
            whole = whole + slope;
            first = slope.times_add(at, first);
            square = slope.times_add(at * at, square);
        }
        let q = f64::from(q);
        sums.whole = sums.whole + whole;
        sums.first = sums.first + first;
        sums.both_first = sums.both_first + square;
        sums.second = whole.times_add(q, sums.second);
        sums.mixed = first.times_add(q, sums.mixed);
        sums.both_second = whole.times_add(q * q, sums.both_second);
    }
    sums
}

/// A few places of a patch; `untouched` if no treatment of the cutoff reaches any.
#[inline(always)]
fn sum_few<S: PairShape, L: Simd, const MEASURED: bool>(
    simd: L,
    law: &CutPotential<S>,
    samples: &[Sample],
    start: Vector<L>,
    along: [Vector<L>; 2],
    untouched: bool,
    held: &mut Held<L, MEASURED>,
) -> Moments<L> {
    let mut sums = Moments::new(simd);
    for sample in samples {
        let [p, q] = sample.at;
        let bond = along[0].scaled_add(p, along[1].scaled_add(q, start));
        let squared = bond.squared();
        let slope = if MEASURED || !untouched {
            let values = law.values(simd, squared);
            if MEASURED {
                let weight = Lanes::all(simd, sample.weight);
                held.add(values, bond, within(simd, law, squared), weight);
            }
            values[1]
        } else {
            law.untouched_slopes(simd, squared)
        };
        let slope = slope * sample.weight;
        let [of_first, of_second] = [slope * p, slope * q];
        sums.whole = sums.whole + slope;
        sums.first = sums.first + of_first;
        sums.second = sums.second + of_second;
        sums.both_first = of_first.times_add(p, sums.both_first);
        sums.mixed = of_first.times_add(q, sums.mixed);
        sums.both_second = of_second.times_add(q, sums.both_second);
    }
    sums
}
