//! Which bonds of nearest neighbours of a solid are broken.
//!
//! A bond inside a part of a block does not count, nor does one across an interface that is intact: there the forces see to it
//! that all are whole.

use std::collections::HashMap;

use rayon::prelude::*;

use crate::domain::Domain;
use crate::forces::solid::Forces;
use crate::lattice::fcc::NEAREST;
use crate::mesh::solid::Solid;
use crate::mesh::solid::element::{Element, Shape};

/// No atom.
const NOBODY: u32 = u32::MAX;

/// A site of an element by its local coordinates.
type End = (u32, [i32; 3]);

/// The bonds between elements.
#[derive(Clone, Debug)]
pub struct Bonds {
    /// For each atom the places among the atoms of its neighbours along [`NEAREST`].
    of_atoms: Vec<[u32; 6]>,
    /// Bonds of parts with atoms and with parts of other sizes, and those across interfaces that have opened.
    of_parts: Vec<[End; 2]>,
    /// The interfaces whose bonds are among them, ascending.
    opened: Vec<u32>,
    /// Bonds that touch an element of each shape and size.
    touching: HashMap<(Shape, i32), f64>,
}

impl Bonds {
    pub fn new(forces: &Forces) -> Self {
        let mesh = forces.mesh();
        let mut touching = HashMap::new();
        for element in &mesh.elements {
            let kind = (element.shape, element.size);
            touching.entry(kind).or_insert_with(|| touching_bonds(*element));
        }
        Self {
            of_atoms: (mesh.parts..mesh.elements.len())
                .into_par_iter()
                .map(|atom| {
                    NEAREST.map(|vector| {
                        let other = atom_at(mesh, plus(mesh.elements[atom].anchor, vector));
                        other.map_or(NOBODY, |other| (other - mesh.parts) as u32)
                    })
                })
                .collect(),
            of_parts: beside_others(forces),
            opened: Vec::new(),
            touching,
        }
    }

    /// How many bonds are broken, and of each element the share of the bonds of its sites. All ranks must ask for it together.
    pub fn broken(&mut self, forces: &Forces, position: &mut [Vec<f64>; 3]) -> (u64, Vec<f64>) {
        self.follow(forces);
        let mesh = forces.mesh();
        share(forces.domain(), position);
        let longest = forces.material().breaking_length();
        let is_broken = |a: [f64; 3], b: [f64; 3]| {
            let squared: f64 = (0..3).map(|axis| (a[axis] - b[axis]) * (a[axis] - b[axis])).sum();
            squared > longest * longest
        };
        let at_node = |node: usize| position.each_ref().map(|plane| plane[node]);
        let first = mesh.part_nodes();
        let of_atom = |(atom, others): (usize, &[u32; 6])| -> Vec<[u32; 2]> {
            let here = at_node(first + atom);
            let others = others.iter().filter(|&&other| other != NOBODY);
            let broken = others.filter(|&&other| is_broken(here, at_node(first + other as usize)));
            let number = |atom: usize| (mesh.parts + atom) as u32;
            broken.map(|&other| [number(atom), number(other as usize)]).collect()
        };
        let at = |(element, local): End| {
            let mut place = [0.0; 3];
            for (node, weight) in mesh.carriers(element as usize, local) {
                (0..3).for_each(|axis| place[axis] += weight * position[axis][node]);
            }
            place
        };
        let between_atoms = self.of_atoms.par_iter().enumerate().flat_map_iter(of_atom);
        let of_parts = self.of_parts.par_iter().filter(|[a, b]| is_broken(at(*a), at(*b)));
        let of_parts = of_parts.map(|[a, b]| [a.0, b.0]);
        let broken: Vec<[u32; 2]> = between_atoms.chain(of_parts).collect();
        let mut damage = vec![0.0; mesh.elements.len()];
        broken
            .iter()
            .flatten()
            .for_each(|&element| damage[element as usize] += 1.0);
        for (damage, element) in damage.iter_mut().zip(&mesh.elements) {
            *damage /= self.touching[&(element.shape, element.size)];
        }
        (broken.len() as u64, damage)
    }

    /// Takes in the bonds across interfaces that have opened since.
    fn follow(&mut self, forces: &Forces) {
        let mesh = forces.mesh();
        let open = forces.open_interfaces();
        for &interface in open.iter().filter(|number| self.opened.binary_search(number).is_err()) {
            let [first, second] = forces.beside(interface);
            let other = mesh.elements[second as usize];
            for (local, site) in sites(mesh, first) {
                let neighbours = neighbours(site).filter(|&neighbour| other.contains(neighbour));
                let bonds = neighbours.map(|neighbour| [(first, local), (second, other.local(neighbour))]);
                self.of_parts.extend(bonds);
            }
        }
        self.opened = open;
    }
}

/// Every rank learns where all nodes are: what is broken may lie far apart.
fn share(domain: &Domain, position: &mut [Vec<f64>; 3]) {
    position.iter_mut().for_each(|plane| domain.share_nodes(plane));
}

fn plus(site: [i32; 3], vector: [i32; 3]) -> [i32; 3] {
    std::array::from_fn(|axis| site[axis] + vector[axis])
}

fn neighbours(site: [i32; 3]) -> impl Iterator<Item = [i32; 3]> {
    let both = NEAREST
        .into_iter()
        .flat_map(|vector| [vector, vector.map(|part| -part)]);
    both.map(move |vector| plus(site, vector))
}

/// Local coordinates and sites of an element.
fn sites(mesh: &Solid, element: u32) -> impl Iterator<Item = ([i32; 3], [i32; 3])> {
    let element = mesh.elements[element as usize];
    element.locals().map(move |local| (local, element.site(local)))
}

/// The element that is the atom of a site. Atoms are in the order of k, j and i.
fn atom_at(mesh: &Solid, site: [i32; 3]) -> Option<usize> {
    let key = |[i, j, k]: [i32; 3]| (k, j, i);
    let atoms = &mesh.elements[mesh.parts..];
    let place = atoms.binary_search_by_key(&key(site), |atom| key(atom.anchor));
    place.ok().map(|place| mesh.parts + place)
}

/// The bonds of parts with atoms and with parts of other sizes.
fn beside_others(forces: &Forces) -> Vec<[End; 2]> {
    let mesh = forces.mesh();
    let mut owners: HashMap<[i32; 3], u32> = HashMap::new();
    let parts = forces.beside_others();
    for &part in &parts {
        let element = mesh.elements[part as usize];
        let at_side = sites(mesh, part).filter(|&(_, site)| neighbours(site).any(|other| !element.contains(other)));
        owners.extend(at_side.map(|(_, site)| (site, part)));
    }
    let mut bonds = Vec::new();
    for &part in &parts {
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

/// Bonds that touch the sites of an element: twelve a site, those inside counted once.
fn touching_bonds(element: Element) -> f64 {
    let inside = element.locals().map(|local| {
        let ends = NEAREST.iter().filter(|&&vector| element.has_local(plus(local, vector)));
        ends.count()
    });
    12.0 * element.site_count() as f64 - inside.sum::<usize>() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Material;
    use crate::mesh::solid::Plan;
    use crate::mesh::solid::region::{Region, Shape as RegionShape};
    use crate::mesh::solid::sites::{Frame, Outline, Sites};
    use crate::potential::{AtCutoff, CutPotential, Interaction, LennardJones};

    /// Sites along each axis.
    const EXTENT: [i32; 3] = [12, 12, 12];

    fn forces(element: u16, atoms_from: Option<f64>) -> Forces {
        let law = LennardJones {
            epsilon: 1.0,
            sigma: 1.0,
        };
        let law = CutPotential::new(law, 0.34 / 0.2277, AtCutoff::Truncated);
        let material = Material::face_centred_cubic(Interaction::LennardJones(law), 1.0).unwrap();
        let spacing = material.spacing;
        let atoms = |from: f64| Region {
            shape: RegionShape::Box {
                from: [-100.0, -100.0, from * spacing],
                to: [100.0; 3],
            },
            element: 1,
        };
        let mesh = Solid::new(&Plan {
            sites: Sites {
                outline: Outline::Rhombohedron(EXTENT),
                frame: Frame::of_blocks(spacing),
                removed: vec![],
            },
            element,
            regions: atoms_from.map(atoms).into_iter().collect(),
            spacing,
        });
        Forces::new(mesh, material)
    }

    #[test]
    fn a_solid_that_is_parted_along_a_plane_of_the_lattice_has_lost_three_bonds_a_site_on_any_mesh() {
        // Between the lower six layers of sites and the upper: each site of one has three neighbours in the other, fewer at
        // the sides of the rhombohedron.
        let below = (0..EXTENT[0]).flat_map(|i| (0..EXTENT[1]).map(move |j| [i, j, 5]));
        let is_inside = |site: &[i32; 3]| (0..3).all(|axis| (0..EXTENT[axis]).contains(&site[axis]));
        let above = |site: [i32; 3]| neighbours(site).filter(|other| other[2] == 6).filter(is_inside).count();
        let expected: usize = below.map(above).sum();
        for (element, atoms_from) in [(6, None), (1, None), (6, Some(5.9 * (2f64 / 3.0).sqrt()))] {
            let mut forces = forces(element, atoms_from);
            let mut position = forces.mesh().node_positions();
            let mut force = position.clone();
            let mut bonds = Bonds::new(&forces);
            forces.compute(&mut position, &mut force).unwrap();
            assert_eq!(bonds.broken(&forces, &mut position).0, 0, "{element}, {atoms_from:?}");
            for number in 0..forces.mesh().elements.len() {
                if forces.mesh().elements[number].anchor[2] >= 6 {
                    let nodes: Vec<usize> = forces.mesh().nodes_of(number).collect();
                    nodes.into_iter().for_each(|node| position[2][node] += 1.0);
                }
            }
            forces.compute(&mut position, &mut force).unwrap();
            let (broken, damage) = bonds.broken(&forces, &mut position);
            assert_eq!(broken as usize, expected, "{element}, {atoms_from:?}");
            let elements = forces.mesh().elements.iter().zip(damage);
            let ends: f64 = elements
                .map(|(&element, damage)| damage * touching_bonds(element))
                .sum();
            assert!((ends - 2.0 * expected as f64).abs() < 1e-6);
        }
    }

    #[test]
    fn the_parts_of_a_block_of_ten_have_as_many_bonds_inside_as_the_crystal_has_there() {
        let inside = |shape: Shape| {
            let element = Element {
                shape,
                size: 10,
                anchor: [0; 3],
            };
            12.0 * element.site_count() as f64 - touching_bonds(element)
        };
        assert_eq!(Shape::OF_BLOCK.map(inside), [720.0, 3420.0, 720.0]);
    }
}
