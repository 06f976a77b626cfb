//! Solids of a face-centred cubic crystal: blocks in tetrahedra and octahedra of any size, atoms, and all of them mixed.
//!
//! Elements share no nodes: the parts of blocks come first, row by row along a1, then the atoms. Parts of one shape and size
//! side by side are a group, whose first nodes have consecutive numbers, then their second, as in [`super::groups`].

pub mod bonds;
pub mod cut;
pub mod element;
pub mod interfaces;
pub mod region;
pub mod severed;
pub mod sites;
pub mod template;
#[cfg(test)]
mod tests;
mod tiling;

use std::collections::HashMap;
use std::ops::Range;
use std::slice;

use super::grouped::{self, Grouped, MassCoupling};
use element::{Element, Shape};
use region::Region;
use sites::Sites;
pub use tiling::SMALLEST_BLOCK;

/// What the mesh of a solid is made from.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    pub sites: Sites,
    /// Atoms an edge of the blocks outside the regions; 1 for atoms everywhere.
    pub element: u16,
    pub regions: Vec<Region>,
    /// Distance of nearest neighbours, nm.
    pub spacing: f64,
}

/// Elements, nodes and sites of a solid in its reference state.
#[derive(Clone, Debug)]
pub struct Solid {
    pub sites: Sites,
    /// Distance of nearest neighbours, nm.
    pub spacing: f64,
    pub elements: Vec<Element>,
    /// Number of elements that are no atoms.
    pub parts: usize,
    groups: Vec<Group>,
    of_part: Vec<u32>,
    part_nodes: usize,
}

/// Parts of blocks side by side along a1, alike in shape and size.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    pub shape: Shape,
    /// Sites along an edge of the block.
    pub size: i32,
    pub elements: Range<usize>,
    first_node: usize,
}

impl Group {
    pub fn len(&self) -> usize {
        self.elements.len()
    }

    pub fn is_empty(&self) -> bool {
        self.elements.is_empty()
    }

    /// The node at a corner of one of its elements.
    #[inline(always)]
    pub fn node(&self, element: usize, corner: usize) -> usize {
        self.first_node + corner * self.len() + (element - self.elements.start)
    }

    pub fn nodes(&self) -> Range<usize> {
        self.first_node..self.first_node + self.shape.node_count() * self.len()
    }
}

impl Solid {
    pub fn new(plan: &Plan) -> Self {
        let (elements, parts) = tiling::tile(&plan.sites, i32::from(plan.element), &plan.regions);
        let follows = |one: &Element, next: &Element| {
            let [i, j, k] = one.anchor;
            let anchor = [i + one.size, j, k];
            *next == Element { anchor, ..*one }
        };
        let (mut groups, mut of_part) = (Vec::new(), Vec::with_capacity(parts));
        let (mut start, mut first_node) = (0, 0);
        for run in elements[..parts].chunk_by(follows) {
            of_part.resize(start + run.len(), groups.len() as u32);
            let Element { shape, size, .. } = run[0];
            let elements = start..start + run.len();
            groups.push(Group {
                shape,
                size,
                elements,
                first_node,
            });
            start += run.len();
            first_node += shape.node_count() * run.len();
        }
        Self {
            sites: plan.sites.clone(),
            spacing: plan.spacing,
            elements,
            parts,
            groups,
            of_part,
            part_nodes: first_node,
        }
    }

    pub fn node_count(&self) -> usize {
        self.part_nodes + self.elements.len() - self.parts
    }

    /// Nodes of elements that are no atoms; those of atoms come after them.
    pub fn part_nodes(&self) -> usize {
        self.part_nodes
    }

    pub fn atom_count(&self) -> usize {
        self.elements.len() - self.parts
    }

    /// Sites along an edge of the blocks of its elements, ascending.
    pub fn sizes(&self) -> Vec<i32> {
        let of_atoms = (self.atom_count() > 0).then_some(1);
        let mut sizes: Vec<i32> = self.groups.iter().map(|group| group.size).chain(of_atoms).collect();
        sizes.sort_unstable();
        sizes.dedup();
        sizes
    }

    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// The group of an element that is no atom.
    #[inline(always)]
    pub fn group_of(&self, part: usize) -> &Group {
        &self.groups[self.of_part[part] as usize]
    }

    /// The place of an element's group among [`Self::groups`].
    #[inline(always)]
    pub fn group_number(&self, part: usize) -> usize {
        self.of_part[part] as usize
    }

    /// Number of the node at a corner of an element; an atom is its only one.
    #[inline(always)]
    pub fn node(&self, element: usize, corner: usize) -> usize {
        if element < self.parts {
            self.group_of(element).node(element, corner)
        } else {
            self.part_nodes + element - self.parts
        }
    }

    /// Numbers of an element's nodes, corner by corner.
    pub fn nodes_of(&self, element: usize) -> impl Iterator<Item = usize> + Clone + use<> {
        let first = self.node(element, 0);
        let (count, step) = match element < self.parts {
            true => (self.elements[element].shape.node_count(), self.group_of(element).len()),
            false => (1, 1),
        };
        (0..count).map(move |corner| first + corner * step)
    }

    /// The element that a node belongs to.
    pub fn element_of_node(&self, node: usize) -> usize {
        match node.checked_sub(self.part_nodes) {
            Some(atom) => self.parts + atom,
            None => {
                let after = self.groups.partition_point(|group| group.first_node <= node);
                let group = &self.groups[after - 1];
                group.elements.start + (node - group.first_node) % group.len()
            }
        }
    }

    /// Reference positions of the nodes, x, y and z, nm.
    pub fn node_positions(&self) -> [Vec<f64>; 3] {
        self.node_positions_of(slice::from_ref(&(0..self.elements.len())))
    }

    /// The same of the nodes of some ranges of elements; the others are untouched zeros, which take no memory.
    pub fn node_positions_of(&self, elements: &[Range<usize>]) -> [Vec<f64>; 3] {
        let mut planes = [0, 1, 2].map(|_| vec![0.0; self.node_count()]);
        for number in elements.iter().cloned().flatten() {
            let element = &self.elements[number];
            for (node, corner) in self.nodes_of(number).zip(element.corners()) {
                let place = self.sites.frame.place(element.site(corner));
                (0..3).for_each(|axis| planes[axis][node] = place[axis]);
            }
        }
        planes
    }

    /// Reference position of a node, nm.
    pub fn node_position(&self, node: usize) -> [f64; 3] {
        let number = self.element_of_node(node);
        let element = &self.elements[number];
        let mut corners = self.nodes_of(number).zip(element.corners());
        let own = corners.find(|(other, _)| *other == node);
        own.map_or([f64::NAN; 3], |(_, corner)| {
            self.sites.frame.place(element.site(corner))
        })
    }

    /// Largest coordinate of a node in its reference position, nm.
    pub fn farthest(&self) -> f64 {
        let elements = self.elements.iter();
        let corners = elements.flat_map(|element| element.corners().into_iter().map(|corner| element.site(corner)));
        let places = corners.flat_map(|site| self.sites.frame.place(site));
        places.fold(0.0, |most: f64, place| most.max(place.abs()))
    }

    /// Lumped mass of every node in site masses.
    pub fn lumped_masses(&self) -> Vec<f64> {
        grouped::masses_of(self, slice::from_ref(&(0..self.elements.len())))
    }

    pub fn site_count(&self) -> u64 {
        let of_groups = self.groups.iter().map(|group| {
            let element = &self.elements[group.elements.start];
            element.site_count() * group.len() as u64
        });
        of_groups.sum::<u64>() + self.atom_count() as u64
    }

    /// What a site of an element that is no atom is made of: nodes and their weights.
    pub fn carriers(&self, element: usize, local: [i32; 3]) -> impl Iterator<Item = (usize, f64)> + use<> {
        let weights = self.elements[element].shape_functions(local);
        self.nodes_of(element).zip(weights).filter(|(_, weight)| *weight != 0.0)
    }
}

impl Grouped for Solid {
    fn element_count(&self) -> usize {
        self.elements.len()
    }

    fn node_count(&self) -> usize {
        Self::node_count(self)
    }

    fn grouped(&self) -> usize {
        self.parts
    }

    fn group_number(&self, element: usize) -> usize {
        Self::group_number(self, element)
    }

    fn group_count(&self) -> usize {
        self.groups.len()
    }

    fn group(&self, number: usize) -> [Range<usize>; 2] {
        let group = &self.groups[number];
        [group.elements.clone(), group.nodes()]
    }

    fn lumped_mass(&self, element: usize) -> f64 {
        self.elements[element].lumped_mass()
    }

    fn mass_couplings(&self) -> Vec<MassCoupling> {
        let mut known: HashMap<(Shape, i32), MassCoupling> = HashMap::new();
        let groups = self.groups.iter();
        let couplings = groups.map(|group| {
            let element = &self.elements[group.elements.start];
            *known
                .entry((group.shape, group.size))
                .or_insert_with(|| element.mass_coupling())
        });
        couplings.collect()
    }
}
