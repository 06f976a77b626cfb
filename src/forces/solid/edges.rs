//! Bonds across edges: strings of nearest neighbours between octahedra, and second neighbours that must stay beyond the cutoff.

use pulp::Simd;

use super::inside::within;
use super::measure::Held;
use super::vector::Vector;
use crate::lanes::{Lanes, Mask};
use crate::potential::{CutPotential, PairShape};

/// Edges of two octahedra, site by site: the vector from the second's site to the first's is linear along them.
#[derive(Clone, Copy)]
pub struct Edges<L: Simd> {
    size: i32,
    first: [Vector<L>; 2],
    second: [Vector<L>; 2],
}

impl<L: Simd> Edges<L> {
    /// Edges of octahedra of blocks of so many sites an edge, given by their ends.
    #[inline(always)]
    pub fn new(size: i32, first: [Vector<L>; 2], second: [Vector<L>; 2]) -> Self {
        Self { size, first, second }
    }

    /// Where any bond is longer than these limits, squared.
    #[inline(always)]
    pub fn exceeds(&self, simd: L, limits: [f64; 2]) -> [Mask<L>; 2] {
        let mut exceeds = [Mask::all(simd, false); 2];
        for end in 0..2 {
            let squared = (self.first[end] - self.second[end]).squared();
            exceeds[0] = exceeds[0].or(squared.is_above(limits[0]));
            exceeds[1] = exceeds[1].or(squared.is_above(limits[1]));
        }
        exceeds
    }

    /// Where second neighbours, a site on along the other edge, may be nearer than a limit, squared.
    #[inline(always)]
    pub fn second_neighbours_below(&self, simd: L, limit: f64) -> Mask<L> {
        let per_step = 1.0 / f64::from(self.size - 1);
        let [a, b] = [self.first, self.second];
        let [step_a, step_b] = [(a[1] - a[0]).scaled(per_step), (b[1] - b[0]).scaled(per_step)];
        let forward = [a[0] - (b[0] + step_b), (a[1] - step_a) - b[1]];
        let backward = [(a[0] + step_a) - b[0], a[1] - (b[1] - step_b)];
        let below = string_below(simd, forward, limit);
        below.or(string_below(simd, backward, limit))
    }

    /// Forces on the ends of the first and of the second edges; all bonds are within the cutoff. `of_nodes`: only those at the
    /// ends are looked at, each of which stands for so many.
    #[inline(always)]
    pub fn sum<S: PairShape, const MEASURED: bool>(
        &self,
        simd: L,
        law: &CutPotential<S>,
        of_nodes: Option<f64>,
    ) -> ([[Vector<L>; 2]; 2], Held<L, MEASURED>) {
        let steps = self.size - 1;
        let per_step = 1.0 / f64::from(steps);
        let start = self.first[0] - self.second[0];
        let along = (self.first[1] - self.second[1] - start).scaled(per_step);
        let zero = Lanes::all(simd, 0.0);
        let count = of_nodes.unwrap_or(1.0);
        let between = if of_nodes.is_some() { steps } else { 1 };
        let mut held = Held::new(simd);
        let [mut whole, mut first, mut square] = [zero; 3];
        for p in (0..=steps).step_by(between as usize) {
            let at = f64::from(p);
            let bond = along.scaled_add(at, start);
            let squared = bond.squared();
            let values = law.values(simd, squared);
            if MEASURED {
                held.add(values, bond, within(simd, law, squared), Lanes::all(simd, count));
            }
            let slope = values[1] * count;
            whole = whole + slope;
            first = slope.times_add(at, first);
            square = slope.times_add(at * at, square);
        }
        let force = along.times_add(first, start.times(whole));
        let far = along.times_add(square, start.times(first)).scaled(per_step);
        let near = force - far;
        let none = Vector::zero(simd);
        ([[none - near, none - far], [near, far]], held)
    }
}

/// Where a vector that is linear along a string may be shorter than a limit, squared: its square is convex, so nowhere less than
/// its tangent in the middle.
#[inline(always)]
pub fn string_below<L: Simd>(simd: L, ends: [Vector<L>; 2], limit: f64) -> Mask<L> {
    let middle = (ends[0] + ends[1]).scaled(0.5);
    let squared = middle.squared();
    let mut below = Mask::all(simd, false);
    for end in ends {
        let tangent = middle.dot(end - middle).times_add(2.0, squared);
        below = below.or(tangent.is_below(limit));
    }
    below
}
