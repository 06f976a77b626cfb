//! Which bonds of nearest neighbours of a solid are broken.
//!
//! A bond inside a part of a block does not count, nor does one across an interface that is intact: there the forces see to it
//! that all are whole. What a cut severs is damage from the start; it is not among the bonds that have broken.

use std::collections::HashMap;

use rayon::prelude::*;

use crate::domain::Domain;
use crate::forces::solid::Forces;
use crate::lattice::fcc::NEAREST;
use crate::mesh::solid::bonds::{self, End, place_of, plus};
use crate::mesh::solid::element::{Element, Shape};

/// How a bond was lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Lost {
    Broken,
    Severed,
}

/// The bonds between elements.
#[derive(Clone, Debug)]
pub struct Bonds {
    /// Those of atoms, of parts with them and with parts of other sizes, and those across interfaces that have opened.
    single: bonds::Bonds,
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
            single: bonds::Bonds::new(mesh, &forces.beside_others()),
            opened: Vec::new(),
            touching,
        }
    }

    /// How many bonds are broken, and of each element the share of the bonds of its sites that are broken or severed. All ranks
    /// must ask for it together.
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
        let of_atom = |atom: usize| -> Vec<([u32; 2], Lost)> {
            let here = at_node(first + atom);
            let others = self.single.of_atom(atom).map(|(_, other)| other);
            let number = |atom: usize| (mesh.parts + atom) as u32;
            let ends = |other: u32| [number(atom), number(other as usize)];
            let is_severed = |ends: [u32; 2]| {
                let [a, b] = ends.map(|end| mesh.elements[end as usize].anchor);
                mesh.sites.severs(a, b)
            };
            let lost = others.filter_map(|other| match is_severed(ends(other)) {
                true => Some((ends(other), Lost::Severed)),
                false => is_broken(here, at_node(first + other as usize)).then_some((ends(other), Lost::Broken)),
            });
            lost.collect()
        };
        let at = |end: End| place_of(mesh, end, position);
        let between_atoms = (0..self.single.atom_count()).into_par_iter().flat_map_iter(of_atom);
        let of_parts = self.single.of_parts.par_iter();
        let site = |end: End| mesh.elements[end.0 as usize].site(end.1);
        let of_parts = of_parts.filter_map(|&[a, b]| match mesh.sites.severs(site(a), site(b)) {
            true => Some(([a.0, b.0], Lost::Severed)),
            false => is_broken(at(a), at(b)).then_some(([a.0, b.0], Lost::Broken)),
        });
        let lost: Vec<([u32; 2], Lost)> = between_atoms.chain(of_parts).collect();
        let mut damage = vec![0.0; mesh.elements.len()];
        let elements = lost.iter().flat_map(|(elements, _)| elements);
        elements.for_each(|&element| damage[element as usize] += 1.0);
        let broken = lost.iter().filter(|(_, how)| *how == Lost::Broken);
        for (damage, element) in damage.iter_mut().zip(&mesh.elements) {
            *damage /= self.touching[&(element.shape, element.size)];
        }
        (broken.count() as u64, damage)
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
            let (broken, damage) = Bonds::new(&forces).broken(&forces, &mut position);
            assert_eq!(broken, 0);
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
