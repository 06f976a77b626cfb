//! Sites that may meet others: single atoms, and sites of parts along whatever is open, borders on something else, or is free
//! and near such sites.

use std::collections::HashSet;
use std::ops::Range;

use super::Planes;
use crate::lanes::MOST;
use crate::mesh::solid::Solid;
use crate::mesh::solid::interfaces::{Interfaces, Side};

/// Sites by rising number of their element and then in the order of the element, each with the nodes that carry it.
#[derive(Clone, Debug, Default)]
pub struct Points {
    /// Where the carriers of each point of a part start.
    starts: Vec<u32>,
    carriers: Vec<(u32, f64)>,
    /// The element of each.
    pub element: Vec<u32>,
    of_parts: usize,
    first_atom: usize,
    first_atom_node: usize,
}

/// The element of places that are no points.
const NOBODY: u32 = u32::MAX;

/// Parts whose boxes are so near to a site are looked at, spacings.
const NEAR: f64 = 3.0;

impl Points {
    /// `intact` tells which interfaces are.
    pub fn new(mesh: &Solid, interfaces: &Interfaces, intact: &[f64], position: &Planes) -> Self {
        let mut sides: Vec<(u32, Side)> = Vec::new();
        for (number, _) in (0..).zip(intact).filter(|(_, intact)| **intact == 0.0) {
            let parts = interfaces.pairs[number as usize];
            sides.extend(parts.map(|part| (part, interfaces.side(number, part))));
        }
        let lonely = interfaces.lonely.iter();
        sides.extend(
            lonely
                .clone()
                .filter(|side| !side.is_free)
                .map(|side| (side.element, side.side)),
        );
        if sides.is_empty() && mesh.atom_count() == 0 {
            return Self::default();
        }
        let near = Near::new(mesh, &sides, position);
        let free = lonely.filter(|side| side.is_free);
        sides.extend(
            free.filter(|side| near.is_near(side.element, position))
                .map(|side| (side.element, side.side)),
        );
        sides.sort_unstable_by_key(|&(part, side)| (part, side.border, side.is_second));
        let mut points = Self {
            starts: vec![0],
            first_atom_node: mesh.part_nodes(),
            ..Self::default()
        };
        for of_part in sides.chunk_by(|a, b| a.0 == b.0) {
            let part = of_part[0].0;
            let element = mesh.elements[part as usize];
            let mut locals: Vec<[i32; 3]> = of_part
                .iter()
                .flat_map(|&(_, side)| interfaces.facing(element, side).to_vec())
                .collect();
            locals.sort_unstable_by_key(|&[p, q, r]| (r, q, p));
            locals.dedup();
            for local in locals {
                let carriers = mesh.carriers(part as usize, local);
                points
                    .carriers
                    .extend(carriers.map(|(node, weight)| (node as u32, weight)));
                points.starts.push(points.carriers.len() as u32);
                points.element.push(part);
            }
        }
        points.of_parts = points.element.len();
        // Atoms begin where lanes do.
        points.element.resize(points.of_parts.next_multiple_of(MOST), NOBODY);
        points.first_atom = points.element.len();
        points.element.extend(mesh.parts as u32..mesh.elements.len() as u32);
        points
    }

    /// How many numbers there are; see [`Self::is_point`].
    pub fn len(&self) -> usize {
        self.element.len()
    }

    /// Whether there is a point of this number: a few between those of parts and the atoms are left out.
    #[inline(always)]
    pub fn is_point(&self, number: usize) -> bool {
        number < self.of_parts || number >= self.first_atom && number < self.element.len()
    }

    #[inline(always)]
    pub fn is_of_part(&self, point: usize) -> bool {
        point < self.of_parts
    }

    /// How many belong to parts; they come first.
    pub fn of_parts(&self) -> usize {
        self.of_parts
    }

    /// The number of the first atom, a multiple of [`MOST`].
    pub fn first_atom(&self) -> usize {
        self.first_atom
    }

    /// The points of consecutive elements among those of a range.
    pub fn of_elements(&self, elements: Range<usize>, points: Range<usize>) -> Range<usize> {
        let of = &self.element[points.clone()];
        let first = |element: usize| points.start + of.partition_point(|&other| (other as usize) < element);
        first(elements.start)..first(elements.end)
    }

    /// Nodes that carry a point of a part, and their weights.
    pub fn carriers(&self, point: usize) -> &[(u32, f64)] {
        &self.carriers[self.starts[point] as usize..self.starts[point + 1] as usize]
    }

    /// The node of an atom among the points.
    pub fn atom_node(&self, point: usize) -> usize {
        self.first_atom_node + point - self.first_atom
    }

    /// Where a point is.
    #[inline(always)]
    pub fn place(&self, point: usize, position: &Planes) -> [f64; 3] {
        if point >= self.first_atom {
            let node = self.atom_node(point);
            return [position[0][node], position[1][node], position[2][node]];
        }
        if !self.is_of_part(point) {
            return [0.0; 3];
        }
        let mut place = [0.0; 3];
        for &(node, weight) in self.carriers(point) {
            for axis in 0..3 {
                place[axis] = position[axis][node as usize].mul_add(weight, place[axis]);
            }
        }
        place
    }
}

/// Where there are sites that may meet others, coarsely.
struct Near {
    width: f64,
    cells: HashSet<[i32; 3]>,
    nodes: Vec<Vec<usize>>,
}

impl Near {
    fn new(mesh: &Solid, sides: &[(u32, Side)], position: &Planes) -> Self {
        let largest = mesh.elements.first().map_or(1, |element| element.size);
        let width = (f64::from(largest) + NEAR) * mesh.spacing;
        let mut near = Self {
            width,
            cells: HashSet::new(),
            nodes: (0..mesh.parts).map(|part| mesh.nodes_of(part).collect()).collect(),
        };
        let parts = sides.iter().map(|&(part, _)| part as usize);
        let nodes = parts
            .flat_map(|part| mesh.nodes_of(part))
            .chain(mesh.part_nodes()..mesh.node_count());
        for node in nodes {
            let cell = near.cell(position.each_ref().map(|plane| plane[node]));
            near.cells.insert(cell);
        }
        near
    }

    fn cell(&self, place: [f64; 3]) -> [i32; 3] {
        place.map(|component| (component / self.width).floor() as i32)
    }

    /// Whether such a site may be near a part: in its cells or in those beside them.
    fn is_near(&self, part: u32, position: &Planes) -> bool {
        let nodes = &self.nodes[part as usize];
        let bound = |axis: usize, fold: fn(f64, f64) -> f64| {
            nodes
                .iter()
                .map(|&node| position[axis][node])
                .reduce(fold)
                .unwrap_or(0.0)
        };
        let from = self.cell([0, 1, 2].map(|axis| bound(axis, f64::min)));
        let to = self.cell([0, 1, 2].map(|axis| bound(axis, f64::max)));
        (from[0] - 1..=to[0] + 1).any(|x| {
            (from[1] - 1..=to[1] + 1).any(|y| (from[2] - 1..=to[2] + 1).any(|z| self.cells.contains(&[x, y, z])))
        })
    }
}
