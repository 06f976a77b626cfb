//! Bonds of nearest neighbours between the elements of a solid, one by one.

use std::collections::HashMap;

use rayon::prelude::*;

use super::Solid;
use super::element::Element;
use crate::lattice::fcc::NEAREST;

/// No atom.
const NOBODY: u32 = u32::MAX;

/// A site of an element by its local coordinates.
pub type End = (u32, [i32; 3]);

/// The bonds of atoms, and those of parts of blocks with whatever is no part of equal size.
#[derive(Clone, Debug, Default)]
pub struct Bonds {
    /// For each atom the places among the atoms of its neighbours along [`NEAREST`].
    of_atoms: Vec<[u32; 6]>,
    /// Of parts with atoms and with parts of other sizes.
    pub of_parts: Vec<[End; 2]>,
}

impl Bonds {
    /// `parts` are those beside something else than a part of equal size.
    pub fn new(mesh: &Solid, parts: &[u32]) -> Self {
        let of_atom = |atom: usize| {
            NEAREST.map(|vector| {
                let other = atom_at(mesh, plus(mesh.elements[atom].anchor, vector));
                other.map_or(NOBODY, |other| (other - mesh.parts) as u32)
            })
        };
        Self {
            of_atoms: (mesh.parts..mesh.elements.len()).into_par_iter().map(of_atom).collect(),
            of_parts: beside_others(mesh, parts),
        }
    }

    /// Places among the atoms of the neighbours of one of them, each with the number of its vector in [`NEAREST`].
    pub fn of_atom(&self, atom: usize) -> impl Iterator<Item = (usize, u32)> + use<> {
        let others = self.of_atoms[atom].into_iter().enumerate();
        others.filter(|&(_, other)| other != NOBODY)
    }

    pub fn atom_count(&self) -> usize {
        self.of_atoms.len()
    }
}

/// The bonds between two elements.
pub fn between(mesh: &Solid, first: u32, second: u32) -> impl Iterator<Item = [End; 2]> {
    let other = mesh.elements[second as usize];
    sites(mesh, first).flat_map(move |(local, site)| {
        let there = neighbours(site).filter(move |&neighbour| other.contains(neighbour));
        there.map(move |neighbour| [(first, local), (second, other.local(neighbour))])
    })
}

pub fn plus(site: [i32; 3], vector: [i32; 3]) -> [i32; 3] {
    std::array::from_fn(|axis| site[axis] + vector[axis])
}

/// The twelve nearest sites.
pub fn neighbours(site: [i32; 3]) -> impl Iterator<Item = [i32; 3]> {
    let both = NEAREST
        .into_iter()
        .flat_map(|vector| [vector, vector.map(|part| -part)]);
    both.map(move |vector| plus(site, vector))
}

/// Where a site of an element is.
pub fn place_of(mesh: &Solid, (element, local): End, position: &[Vec<f64>; 3]) -> [f64; 3] {
    let mut place = [0.0; 3];
    for (node, weight) in mesh.carriers(element as usize, local) {
        (0..3).for_each(|axis| place[axis] += weight * position[axis][node]);
    }
    place
}

/// Local coordinates and sites of an element.
fn sites(mesh: &Solid, element: u32) -> impl Iterator<Item = ([i32; 3], [i32; 3])> {
    let element: Element = mesh.elements[element as usize];
    element.locals().map(move |local| (local, element.site(local)))
}

/// The element that is the atom of a site. Atoms are in the order of k, j and i.
fn atom_at(mesh: &Solid, site: [i32; 3]) -> Option<usize> {
    let key = |[i, j, k]: [i32; 3]| (k, j, i);
    let atoms = &mesh.elements[mesh.parts..];
    let place = atoms.binary_search_by_key(&key(site), |atom| key(atom.anchor));
    place.ok().map(|place| mesh.parts + place)
}

fn beside_others(mesh: &Solid, parts: &[u32]) -> Vec<[End; 2]> {
    let mut owners: HashMap<[i32; 3], u32> = HashMap::new();
    for &part in parts {
        let element = mesh.elements[part as usize];
        let at_side = sites(mesh, part).filter(|&(_, site)| neighbours(site).any(|other| !element.contains(other)));
        owners.extend(at_side.map(|(_, site)| (site, part)));
    }
    let mut bonds = Vec::new();
    for &part in parts {
        let element = mesh.elements[part as usize];
        for (local, site) in sites(mesh, part).filter(|(_, site)| owners.contains_key(site)) {
            for neighbour in neighbours(site).filter(|&neighbour| !element.contains(neighbour)) {
                if let Some(atom) = atom_at(mesh, neighbour) {
                    bonds.push([(part, local), (atom as u32, [0; 3])]);
                } else if let Some(&other) = owners.get(&neighbour) {
                    let other_size = mesh.elements[other as usize].size;
                    if part < other && other_size != element.size {
                        bonds.push([(part, local), (other, mesh.elements[other as usize].local(neighbour))]);
                    }
                }
            }
        }
    }
    bonds
}
