//! What elements hold: bonds inside them, their part of the strings, and contacts.

use pulp::{Scalar, Simd, WithSimd};

use super::strings::{BondSums, add_bond};
use crate::forces::affine::Affine;
use crate::forces::bulk::BulkBond;
use crate::forces::contact::tally::{Sums, Tally};
use crate::forces::maps::MapLanes;
use crate::forces::{Forces, Planes};
use crate::lanes::{Lanes, MOST, Mask};
use crate::potential::{CutPotential, PairShape};

/// Energy and pairs of the elements from this number on, one for each place of `virial`, which it fills. Strings give
/// half of theirs to either side; `across` is what each interface holds.
pub fn sum<S: PairShape>(
    forces: &Forces,
    law: &CutPotential<S>,
    across: &[[f64; 3]],
    first: usize,
    virial: &mut [[f64; 3]],
    position: &Planes,
) -> [f64; 2] {
    forces.arch.dispatch(Sum {
        forces,
        law: *law,
        across,
        first,
        position,
        energy: 0.0,
        pairs: 0.0,
        virial,
    })
}

/// The sums of consecutive elements, and what they are taken over.
struct Sum<'a, S> {
    forces: &'a Forces,
    law: CutPotential<S>,
    across: &'a [[f64; 3]],
    first: usize,
    position: &'a Planes,
    energy: f64,
    pairs: f64,
    virial: &'a mut [[f64; 3]],
}

impl<S: PairShape> WithSimd for Sum<'_, S> {
    type Output = [f64; 2];

    #[inline(always)]
    fn with_simd<L: Simd>(mut self, simd: L) -> [f64; 2] {
        let forces = self.forces;
        let shapes = &forces.mesh.elements;
        let end = self.first + self.virial.len();
        let triangles = end.min(forces.mesh.triangles);
        let mut at = self.first;
        while at < triangles {
            let size = shapes[at].size;
            let most = triangles.min(at + Lanes::<L>::COUNT);
            let count = (at..most).take_while(|&next| shapes[next].size == size).count();
            self.add_bulk(simd, size, at, count);
            at += count;
        }
        for (place, element) in (self.first..end).enumerate() {
            if element < forces.mesh.triangles {
                let virial = &mut self.virial[place];
                let numbers = forces.interfaces.of(element).iter();
                let held = numbers.filter_map(|&number| self.across.get(number as usize));
                held.for_each(|shared| (0..3).for_each(|k| virial[k] += 0.5 * shared[k]));
            }
        }
        self.add_contacts(simd, end);
        [self.energy, self.pairs]
    }
}

impl<S: PairShape> Sum<'_, S> {
    /// What is inside so many triangles of one size from one on.
    #[inline(always)]
    fn add_bulk<L: Simd>(&mut self, simd: L, size: i32, from: usize, count: usize) {
        let forces = self.forces;
        let map = forces.maps.lanes(simd, from);
        let sums = self.bond_sums(simd, &map, forces.bulk.listed(size));
        let regular = forces.limit.regular_inside(&map).map_or([false; MOST], Mask::answers);
        let [energies, pairs, xx, yy, xy] = sums.map(Lanes::numbers);
        for lane in 0..count {
            let of_lane = if regular[lane] {
                [energies, pairs, xx, yy, xy].map(|numbers| numbers[lane])
            } else {
                self.alone(size, from + lane)
            };
            self.energy += of_lane[0];
            self.pairs += of_lane[1];
            self.virial[from + lane - self.first].copy_from_slice(&of_lane[2..]);
        }
    }

    /// What is inside a triangle that is strongly deformed, with all the lattice vectors that it needs.
    #[cold]
    fn alone(&self, size: i32, triangle: usize) -> [f64; 5] {
        let forces = self.forces;
        let affine = Affine::of_triangle(size, forces.mesh.first_node(triangle), self.position);
        let bonds = forces
            .bulk
            .within(size, &affine, forces.material.spacing, self.law.cutoff());
        let map = forces.maps.lanes(Scalar, triangle);
        self.bond_sums(Scalar, &map, bonds).map(|sum| sum.numbers()[0])
    }

    #[inline(always)]
    fn bond_sums<L: Simd>(&self, simd: L, map: &MapLanes<L>, bonds: &[BulkBond]) -> BondSums<L> {
        let mut sums = [Lanes::all(simd, 0.0); 5];
        for bond in bonds {
            add_bond(
                simd,
                &self.law,
                map.vector(bond.vector),
                Lanes::all(simd, bond.count),
                &mut sums,
            );
        }
        sums
    }

    /// Adds half of each bond that the sites of elements up to `end` have with others' sites.
    #[inline(always)]
    fn add_contacts<L: Simd>(&mut self, simd: L, end: usize) {
        let forces = self.forces;
        let worth = Worth {
            law: self.law,
            spacing: forces.material.spacing,
        };
        let sites_of = |element: usize| forces.contacts.sites_of(&forces.mesh, element);
        let triangles = self.first..end.min(forces.mesh.triangles);
        for element in triangles.clone() {
            let virial = &mut self.virial[element - self.first];
            let [energy, pairs] = [&mut self.energy, &mut self.pairs];
            forces.contacts.tally(simd, sites_of(element), &worth, |_, sums| {
                add_half(sums, energy, pairs, virial);
            });
        }
        let first_atom = self.first.max(triangles.end);
        if first_atom < end {
            let sites = sites_of(first_atom).start..sites_of(end - 1).end;
            let start = sites.start;
            let virial = &mut self.virial[first_atom - self.first..];
            let [energy, pairs] = [&mut self.energy, &mut self.pairs];
            forces.contacts.tally(simd, sites, &worth, |site, sums| {
                add_half(sums, energy, pairs, &mut virial[site - start]);
            });
        }
    }
}

/// Adds to one side of some bonds its half of what they are worth.
#[inline(always)]
fn add_half(sums: [f64; 5], energy: &mut f64, pairs: &mut f64, virial: &mut [f64; 3]) {
    *energy += 0.5 * sums[0];
    *pairs += 0.5 * sums[1];
    (0..3).for_each(|k| virial[k] += 0.5 * sums[2 + k]);
}

/// Energy, number of pairs and virial of bonds.
struct Worth<S> {
    law: CutPotential<S>,
    spacing: f64,
}

impl<S: PairShape> Tally for Worth<S> {
    #[inline(always)]
    fn add<L: Simd>(&self, simd: L, vector: [Lanes<L>; 2], count: f64, sums: &mut Sums<L>) {
        add_bond(simd, &self.law, vector, Lanes::all(simd, count), sums);
    }

    fn add_severed(&self, [x, y]: [f64; 2], count: f64, sums: &mut [f64; 5]) {
        let pair = self.law.repulsion(x * x + y * y, self.spacing);
        let pull = count * pair.slope;
        let worth = [count * pair.energy, 0.0, pull * x * x, pull * y * y, pull * x * y];
        (0..5).for_each(|k| sums[k] += worth[k]);
    }
}
