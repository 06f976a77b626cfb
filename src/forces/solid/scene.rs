//! What a neighbour search starts from.

use std::ops::Range;

use super::Planes;
use super::drift::Lengths;
use super::points::Points;
use crate::mesh::solid::Solid;

/// The points among which partners are searched, and all that decides who they are.
pub struct Scene<'a> {
    pub points: Points,
    pub ready: Vec<u32>,
    /// The elements of this rank, all in groups and all atoms.
    pub elements: [Range<usize>; 2],
    pub watched: Vec<Range<usize>>,
    /// Parts that carry points or may come near any.
    pub parts: &'a [u32],
    pub mesh: &'a Solid,
    pub position: &'a Planes,
    pub lengths: Lengths,
}

impl Scene<'_> {
    /// Where the nodes of the parts and of all atoms are; the others are untouched zeros, which take no memory.
    pub fn places(&self) -> Planes {
        self.position.each_ref().map(|plane| {
            let mut places = vec![0.0; plane.len()];
            let of_parts = self.parts.iter().flat_map(|&part| self.mesh.nodes_of(part as usize));
            let all = of_parts.chain(self.mesh.part_nodes()..plane.len());
            all.for_each(|node| places[node] = plane[node]);
            places
        })
    }
}
