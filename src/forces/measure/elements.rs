//! What elements hold: bonds inside them, their part of the strings, and contacts.

use multiversion::multiversion;

use super::strings::add_bond;
use crate::forces::affine::Affine;
use crate::forces::bulk::{BulkBond, Reach};
use crate::forces::lanes::Lanes;
use crate::forces::maps::MapLanes;
use crate::forces::{Forces, Planes};
use crate::potential::{CutPotential, PairShape};

/// Triangles computed at a time.
const WIDTH: usize = 8;

/// Energy and pairs of the elements from this number on, one for each place of `virial`, which it fills. Strings give
/// half of theirs to either side; `across` is what each interface holds.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx2+fma", "x86_64+avx2+fma"))]
pub fn sum<S: PairShape>(
    forces: &Forces,
    law: &CutPotential<S>,
    across: &[[f64; 3]],
    first: usize,
    virial: &mut [[f64; 3]],
    position: &Planes,
) -> [f64; 2] {
    let mut part = Part {
        energy: 0.0,
        pairs: 0.0,
        virial,
    };
    let shapes = &forces.mesh.elements;
    let end = first + part.virial.len();
    let triangles = end.min(forces.mesh.triangles);
    let mut at = first;
    while at < triangles {
        if at + WIDTH <= triangles && shapes[at].size == shapes[at + WIDTH - 1].size {
            add_bulk::<S, WIDTH>(forces, law, at, at - first, position, &mut part);
            at += WIDTH;
        } else {
            add_bulk::<S, 1>(forces, law, at, at - first, position, &mut part);
            at += 1;
        }
    }
    for (place, element) in (first..end).enumerate() {
        if element < forces.mesh.triangles {
            let virial = &mut part.virial[place];
            let numbers = forces.interfaces.of(element).iter();
            let held = numbers.filter_map(|&number| across.get(number as usize));
            held.for_each(|shared| (0..3).for_each(|k| virial[k] += 0.5 * shared[k]));
        }
        add_contacts(forces, law, element, place, &mut part);
    }
    [part.energy, part.pairs]
}

/// The sums of consecutive elements.
struct Part<'a> {
    energy: f64,
    pairs: f64,
    virial: &'a mut [[f64; 3]],
}

/// What is inside some triangles of one size.
#[inline(always)]
fn add_bulk<S: PairShape, const W: usize>(
    forces: &Forces,
    law: &CutPotential<S>,
    from: usize,
    place: usize,
    position: &Planes,
    part: &mut Part,
) {
    let size = forces.mesh.elements[from].size;
    let map: MapLanes<W> = forces.maps.lanes(from);
    let reach = Reach {
        cutoff: law.cutoff(),
        spacing: forces.material.spacing,
    };
    let mut sums = [Lanes::default(); 5];
    if let Some(bonds) = forces.bulk.within_all(size, &map, &reach) {
        add_bonds(law, &map, bonds, &mut sums);
    } else {
        for lane in 0..W {
            let affine = Affine::of_triangle(size, forces.mesh.first_node(from + lane), position);
            let bonds = forces.bulk.within(size, &affine, reach.spacing, reach.cutoff);
            let mut alone = [Lanes::<1>::default(); 5];
            add_bonds(law, &map.lane(lane), bonds, &mut alone);
            (0..5).for_each(|k| sums[k].0[lane] = alone[k][0]);
        }
    }
    for lane in 0..W {
        let [energy, pairs, xx, yy, xy] = sums.map(|component| component[lane]);
        part.energy += energy;
        part.pairs += pairs;
        part.virial[place + lane] = [xx, yy, xy];
    }
}

#[inline(always)]
fn add_bonds<S: PairShape, const W: usize>(
    law: &CutPotential<S>,
    map: &MapLanes<W>,
    bonds: &[BulkBond],
    sums: &mut [Lanes<W>; 5],
) {
    for bond in bonds {
        add_bond(law, map.vector(bond.local), bond.count, sums);
    }
}

/// Adds the bonds of an element that a search has found, half of each.
#[inline(always)]
fn add_contacts<S: PairShape>(forces: &Forces, law: &CutPotential<S>, element: usize, place: usize, part: &mut Part) {
    let Part { energy, pairs, virial } = part;
    let virial = &mut virial[place];
    for site in forces.contacts.sites_of(element) {
        forces.contacts.for_each_partner(site, |[x, y], severed, count| {
            let squared = x * x + y * y;
            let value = forces.pair_value(law, squared, severed);
            let share = 0.5 * count;
            *energy += share * value.energy;
            *pairs += if squared < law.squared_cutoff() && !severed {
                share
            } else {
                0.0
            };
            let pull = share * value.slope;
            virial[0] += pull * x * x;
            virial[1] += pull * y * y;
            virial[2] += pull * x * y;
        });
    }
}
