//! Which bonds of nearest neighbours of a solid are broken.
//!
//! A bond inside a part of a block does not count, nor does one across an interface that is intact: there the forces see to it
//! that all are whole. What a cut severs is damage from the start; it is not among the bonds that have broken.

use std::collections::HashMap;

use rayon::prelude::*;

use crate::domain::Domain;
use crate::forces::solid::Forces;
use crate::lattice::fcc::NEAREST;
use crate::mesh::solid::Solid;
use crate::mesh::solid::bonds::{self, End, place_of, plus};
use crate::mesh::solid::element::{Element, Shape};

/// The bonds between elements.
#[derive(Clone, Debug)]
pub struct Bonds {
    /// Those of atoms, of parts with them and with parts of other sizes, and those across interfaces that have opened.
    single: bonds::Bonds,
    /// Whether there are parts beside those of other sizes.
    has_unlike_parts: bool,
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
        let single = bonds::Bonds::new(mesh, &forces.beside_others());
        Self {
            has_unlike_parts: !single.of_parts.is_empty(),
            single,
            opened: Vec::new(),
            touching,
        }
    }

    /// The elements at both ends of every bond that has broken, in any order. All ranks must ask for it together, and get those of
    /// all.
    pub fn broken(&mut self, forces: &Forces, position: &mut [Vec<f64>; 3]) -> Vec<[u32; 2]> {
        self.follow(forces);
        let mesh = forces.mesh();
        let domain = forces.domain();
        if mesh.atom_count() > 0 || self.has_unlike_parts {
            share(domain, position);
        }
        let is_mine = |element: usize| domain.is_mine(element);
        let longest = forces.material().breaking_length();
        let is_broken = |a: [f64; 3], b: [f64; 3]| {
            let squared: f64 = (0..3).map(|axis| (a[axis] - b[axis]) * (a[axis] - b[axis])).sum();
            squared > longest * longest
        };
        let at_node = |node: usize| position.each_ref().map(|plane| plane[node]);
        let first = mesh.part_nodes();
        let of_atom = |atom: usize| -> Vec<[u32; 2]> {
            let here = at_node(first + atom);
            let number = |atom: usize| (mesh.parts + atom) as u32;
            let others = self.single.of_atom(atom).map(|(_, other)| other as usize);
            let broken = others.filter(|&other| is_broken(here, at_node(first + other)));
            let broken = broken.map(|other| [atom, other].map(number));
            let broken = broken.filter(|ends| !is_severed(mesh, ends.map(|end| (end, [0; 3]))));
            broken.collect()
        };
        let at = |end: End| place_of(mesh, end, position);
        let between_atoms = domain.atoms().into_par_iter().flat_map_iter(of_atom);
        let of_parts = self.single.of_parts.par_iter();
        let of_parts = of_parts.filter(|[a, _]| is_mine(a.0 as usize));
        let of_parts = of_parts.filter(|[a, b]| !is_severed(mesh, [*a, *b]) && is_broken(at(*a), at(*b)));
        let of_parts = of_parts.map(|[a, b]| [a.0, b.0]);
        let mine: Vec<[u32; 2]> = between_atoms.chain(of_parts).collect();
        domain.ranks().join(mine.into_flattened()).as_chunks().0.to_vec()
    }

    /// Of each element the share of the bonds of its sites that are broken or severed.
    pub fn damage(&self, mesh: &Solid, broken: &[[u32; 2]]) -> Vec<f64> {
        let mut damage = vec![0.0; mesh.elements.len()];
        for element in broken.iter().copied().chain(self.severed(mesh)).flatten() {
            damage[element as usize] += 1.0;
        }
        for (damage, element) in damage
            .iter_mut()
            .zip(&mesh.elements)
            .filter(|(damage, _)| **damage > 0.0)
        {
            *damage /= self.touching[&(element.shape, element.size)];
        }
        damage
    }

    /// The elements at both ends of every bond that a cut severs.
    fn severed(&self, mesh: &Solid) -> Vec<[u32; 2]> {
        if mesh.sites.cut.is_none() {
            return Vec::new();
        }
        let number = |atom: usize| (mesh.parts + atom) as u32;
        let of_atom = |atom: usize| {
            self.single
                .of_atom(atom)
                .map(move |(_, other)| [atom, other as usize].map(number))
        };
        let between_atoms = (0..self.single.atom_count()).flat_map(of_atom);
        let between_atoms = between_atoms.filter(|ends| is_severed(mesh, ends.map(|end| (end, [0; 3]))));
        let of_parts = self.single.of_parts.iter().filter(|ends| is_severed(mesh, **ends));
        between_atoms.chain(of_parts.map(|[a, b]| [a.0, b.0])).collect()
    }

    /// Takes in the bonds across interfaces that have opened since.
    fn follow(&mut self, forces: &Forces) {
        let mesh = forces.mesh();
        let open = forces.open_interfaces();
        for &interface in open.iter().filter(|number| self.opened.binary_search(number).is_err()) {
            let [first, second] = forces.beside(interface);
            self.single.of_parts.extend(bonds::between(mesh, first, second));
        }
        self.opened = open;
    }
}

/// Whether a cut severs the bond between two sites.
fn is_severed(mesh: &Solid, ends: [End; 2]) -> bool {
    let [a, b] = ends.map(|(element, local)| mesh.elements[element as usize].site(local));
    mesh.sites.severs(a, b)
}

/// Every rank learns where all nodes are: what is broken may lie far apart.
fn share(domain: &Domain, position: &mut [Vec<f64>; 3]) {
    position.iter_mut().for_each(|plane| domain.share_nodes(plane));
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
    use crate::mesh::solid::bonds::neighbours;
    use crate::mesh::solid::cut::Cut;
    use crate::mesh::solid::region::{Region, Shape as RegionShape};
    use crate::mesh::solid::sites::{Frame, Outline, Sites};
    use crate::mesh::solid::{Plan, Solid};
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
                cut: None,
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
            assert_eq!(
                bonds.broken(&forces, &mut position).len(),
                0,
                "{element}, {atoms_from:?}"
            );
            for number in 0..forces.mesh().elements.len() {
                if forces.mesh().elements[number].anchor[2] >= 6 {
                    let nodes: Vec<usize> = forces.mesh().nodes_of(number).collect();
                    nodes.into_iter().for_each(|node| position[2][node] += 1.0);
                }
            }
            forces.compute(&mut position, &mut force).unwrap();
            let broken = bonds.broken(&forces, &mut position);
            let damage = bonds.damage(forces.mesh(), &broken);
            assert_eq!(broken.len(), expected, "{element}, {atoms_from:?}");
            let elements = forces.mesh().elements.iter().zip(damage);
            let ends: f64 = elements
                .map(|(&element, damage)| damage * touching_bonds(element))
                .sum();
            assert!((ends - 2.0 * expected as f64).abs() < 1e-6);
        }
    }

    #[test]
    fn what_a_cut_severs_is_damage_at_rest_and_no_bond_that_broke_on_any_mesh() {
        let cut = Cut {
            normal: [0, 0, 1],
            layer: 6,
            into: [1, 0, 0],
            end: 6,
        };
        // Sites i < 6 below have three neighbours above, fewer at the sides; what leans over the end is whole.
        let below = (0..EXTENT[0]).flat_map(|i| (0..EXTENT[1]).map(move |j| [i, j, 5]));
        let is_inside = |site: &[i32; 3]| (0..3).all(|axis| (0..EXTENT[axis]).contains(&site[axis]));
        let severed = |site: [i32; 3]| {
            let above = neighbours(site).filter(|other| other[2] == 6).filter(is_inside);
            above.filter(|other| site[0] + other[0] < 11).count()
        };
        let expected: usize = below.map(severed).sum();
        for (element, atoms_from) in [(6, None), (1, None), (6, Some(5.9 * (2f64 / 3.0).sqrt()))] {
            let whole = forces(element, atoms_from);
            let mut mesh = whole.mesh().clone();
            mesh.sites.cut = Some(cut);
            let forces = Forces::new(mesh, *whole.material());
            let mut position = forces.mesh().node_positions();
            let mut bonds = Bonds::new(&forces);
            let broken = bonds.broken(&forces, &mut position);
            assert_eq!(broken.len(), 0);
            let damage = bonds.damage(forces.mesh(), &broken);
            let elements = forces.mesh().elements.iter().zip(damage);
            let ends: f64 = elements
                .map(|(&element, damage)| damage * touching_bonds(element))
                .sum();
            assert!(
                (ends - 2.0 * expected as f64).abs() < 1e-6,
                "{element}: {ends} {expected}"
            );
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
