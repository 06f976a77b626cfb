//! The stiffness of atoms, several side by side.

use std::ops::Range;

use pulp::{Simd, WithSimd};

use super::{against_a_wall, alike, hessian};
use crate::forces::Forces;
use crate::forces::contact::tally::{Sums, Tally};
use crate::forces::maps::squared;
use crate::lanes::Lanes;
use crate::potential::{CutPotential, PairShape};

/// Bounds of the stiffness of some atoms, by the number of their element, eV/nm^2.
pub struct Bounds<'a, S> {
    forces: &'a Forces,
    walls: Walls<S>,
    atoms: Range<usize>,
}

/// Twice the stiffness of every bond, as if its other end stood still: xx, yy, xy.
struct Walls<S> {
    law: CutPotential<S>,
    spacing: f64,
}

impl<'a, S: PairShape> Bounds<'a, S> {
    pub fn new(forces: &'a Forces, law: &CutPotential<S>, atoms: Range<usize>) -> Self {
        let walls = Walls {
            law: *law,
            spacing: forces.material.spacing,
        };
        Self { forces, walls, atoms }
    }
}

impl<S: PairShape> WithSimd for Bounds<'_, S> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn with_simd<L: Simd>(self, simd: L) -> Vec<f64> {
        let Forces { contacts, mesh, .. } = self.forces;
        let [first, last] = [self.atoms.start, self.atoms.end - 1].map(|atom| contacts.sites_of(mesh, atom));
        let mut bounds = Vec::with_capacity(self.atoms.len());
        contacts.tally(simd, first.start..last.end, &self.walls, |_, [xx, yy, xy]| {
            bounds.push(0.5 * (xx + yy) + (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt());
        });
        bounds
    }
}

impl<S: PairShape> Tally for Walls<S> {
    #[inline(always)]
    fn add<L: Simd>(&self, simd: L, vector: [Lanes<L>; 2], count: f64, sums: &mut Sums<L>) {
        let squared_lengths = squared(vector);
        let none = Lanes::all(simd, 0.0);
        let wall = |stiffness: Lanes<L>| stiffness.where_or(stiffness.is_above(0.0), none) * (2.0 * count);
        let stiffnesses = [
            wall(self.law.curvatures(simd, squared_lengths)),
            wall(self.law.slopes(simd, squared_lengths)),
        ];
        let added = alike::hessian(vector, stiffnesses);
        for k in 0..3 {
            sums[k] = sums[k] + added[k];
        }
    }

    fn add_severed(&self, vector: [f64; 2], count: f64, sums: &mut [f64; 3]) {
        let [x, y] = vector;
        let squared = x * x + y * y;
        let along = self.law.repulsion_curvature(squared.sqrt(), self.spacing);
        let across = self.law.repulsion(squared, self.spacing).slope;
        let added = hessian(
            vector,
            [along, across].map(|stiffness| count * against_a_wall(stiffness)),
        );
        (0..3).for_each(|k| sums[k] += added[k]);
    }
}
