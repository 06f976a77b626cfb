//! Which atoms are no longer in the crystal: by coordination and centrosymmetry.

use rayon::prelude::*;

use super::joints::{dot, minus};
use super::nearby::Nearby;
use crate::mesh::solid::Solid;
use crate::mesh::solid::bonds::Bonds;

/// Neighbours of a site of the crystal.
const ALL: usize = 12;

/// Sum of the squares of the vectors to opposite neighbours, over the spacing squared, beyond which an atom is no longer in the
/// crystal: a quarter of that in a stacking fault, where three pairs of six are off by a partial each. Heat of some hundred
/// kelvin makes a tenth of it.
const FAULTED: f64 = 0.25;

/// Between first and second neighbours, spacings: how far what counts as a neighbour is.
const NEIGHBOUR: f64 = 1.207_106_781_186_547_5;

/// Atoms that had all of their neighbours in the crystal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    pub all: u64,
    /// In stacking faults and cores of dislocations.
    pub dislocated: u64,
    /// On new surfaces: with ten neighbours or fewer.
    pub exposed: u64,
}

/// Counts the atoms whose twelve neighbours are atoms, with the nodes at these places.
///
/// An atom is dislocated where its centrosymmetry is broken, [Kelchner1998] Eq. (1), though it has eleven neighbours or more.
pub fn counts(mesh: &Solid, bonds: &Bonds, position: &[Vec<f64>; 3]) -> Counts {
    let (atoms, first) = (bonds.atom_count(), mesh.part_nodes());
    let place = |atom: usize| position.each_ref().map(|plane| plane[first + atom]);
    let limit = FAULTED * mesh.spacing * mesh.spacing;
    let radius = NEIGHBOUR * mesh.spacing;
    let mut backward = vec![[u32::MAX; 6]; atoms];
    for atom in 0..atoms {
        for (vector, other) in bonds.of_atom(atom) {
            backward[other as usize][vector] = atom as u32;
        }
    }
    let inner: Vec<usize> = (0..atoms)
        .filter(|&atom| bonds.of_atom(atom).count() == 6 && !backward[atom].contains(&u32::MAX))
        .collect();
    // Whose own neighbours still stand around it needs no second look.
    let is_off = |&&atom: &&usize| {
        let here = place(atom);
        let pairs = bonds.of_atom(atom).map(|(vector, ahead)| {
            let [ahead, behind] = [ahead, backward[atom][vector]].map(|other| minus(place(other as usize), here));
            let sum = [0, 1, 2].map(|axis| ahead[axis] + behind[axis]);
            let is_near = [ahead, behind].iter().all(|&way| dot(way, way) <= radius * radius);
            if is_near { dot(sum, sum) } else { f64::INFINITY }
        });
        pairs.sum::<f64>() > limit
    };
    let off: Vec<usize> = inner.par_iter().filter(is_off).copied().collect();
    let nearby = Nearby::around(
        off.iter().map(|&atom| place(atom)),
        (0..atoms).map(|atom| (atom as u32, place(atom))),
        radius,
    );
    let of_atom = |&atom: &usize| {
        let here = place(atom);
        let others = nearby.within(here, radius).filter(|&other| other as usize != atom);
        let ways: Vec<[f64; 3]> = others.map(|other| minus(place(other as usize), here)).collect();
        match ways.len() {
            0..=10 => [0, 1],
            ALL => [u64::from(asymmetry(&ways) > limit), 0],
            _ => [1, 0],
        }
    };
    let [dislocated, exposed] = off
        .par_iter()
        .map(of_atom)
        .reduce(|| [0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
    Counts {
        all: inner.len() as u64,
        dislocated,
        exposed,
    }
}

/// [Kelchner1998] Eq. (1): the sum of |R_i + R_j|^2 over the six pairs of neighbours with the smallest, nm^2.
fn asymmetry(ways: &[[f64; 3]]) -> f64 {
    let mut sums: Vec<f64> = Vec::new();
    for (number, one) in ways.iter().enumerate() {
        for other in &ways[number + 1..] {
            let sum = [0, 1, 2].map(|axis| one[axis] + other[axis]);
            sums.push(dot(sum, sum));
        }
    }
    sums.sort_by(f64::total_cmp);
    sums.iter().take(ALL / 2).sum()
}
