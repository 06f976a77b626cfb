//! Which bonds of the reference lattice are broken.

use rayon::prelude::*;

use super::affine::site_position;
use super::{CHUNK, Forces, Planes};
use crate::lattice::triangular;

impl Forces {
    /// Nearest-neighbour bonds between different elements that are stretched beyond the breaking length, as
    /// (column, row, direction) by rising row and column. Bonds that the cut severed are not among them.
    ///
    /// An intact interface keeps all its bonds, and what happens inside a triangle is deformation, not a crack. Each rank
    /// looks at its own elements; all must call this together, and get the bonds of all.
    pub fn broken_bonds(&self, position: &Planes) -> Vec<[i32; 3]> {
        let mut candidates = self.elements_that_meet_others();
        candidates.retain(|&element| self.domain.is_mine(element as usize));
        let mine: Vec<[i32; 3]> = candidates
            .par_iter()
            .with_min_len(CHUNK)
            .flat_map_iter(|&element| self.broken_bonds_of(element as usize, position))
            .collect();
        let all = self.domain.ranks().join(mine.into_flattened());
        let mut broken = all.as_chunks().0.to_vec();
        broken.par_sort_unstable_by_key(|&[column, row, direction]| [row, column, direction]);
        broken
    }

    /// Atoms that may have irregular bonds, and triangles that border atoms or interfaces that are not intact.
    fn elements_that_meet_others(&self) -> Vec<u32> {
        let beside = self
            .loosened
            .iter()
            .filter(|known| known.is_open())
            .flat_map(|known| known.both);
        let has_atoms = self.mesh.triangles < self.mesh.elements.len();
        let exposed = self.interfaces.exposed().iter().copied().filter(|_| has_atoms);
        let mut triangles: Vec<u32> = exposed.chain(beside).collect();
        triangles.sort_unstable();
        triangles.dedup();
        let first_atom = self.mesh.triangles as u32;
        let atoms = self.atoms.searched().iter().map(|atom| first_atom + atom);
        triangles.into_iter().chain(atoms).collect()
    }

    fn broken_bonds_of(&self, element: usize, position: &Planes) -> Vec<[i32; 3]> {
        let mesh = &self.mesh;
        let limit = self.material.breaking_length().powi(2);
        let shape = &mesh.elements[element];
        let mut broken = Vec::new();
        for (direction, vector) in triangular::NEAREST.iter().enumerate() {
            let mut last = None;
            for local in shape.locals() {
                let site = shape.site(local);
                let neighbour = [site[0] + vector[0], site[1] + vector[1]];
                if shape.contains(neighbour) {
                    continue;
                }
                last = mesh.owner_beside(neighbour, last);
                let Some(other) = last else {
                    continue;
                };
                if mesh.severed(site, neighbour) || self.is_intact_between(element, other) {
                    continue;
                }
                let there = mesh.elements[other].local(neighbour);
                let [a, b] = [(element, local), (other, there)]
                    .map(|(owner, local)| site_position(mesh, owner, local, position));
                let [x, y] = [b[0] - a[0], b[1] - a[1]];
                if x * x + y * y >= limit {
                    broken.push([site[0], site[1], direction as i32]);
                }
            }
        }
        broken
    }

    fn is_intact_between(&self, a: usize, b: usize) -> bool {
        let triangles = self.mesh.triangles;
        a < triangles
            && b < triangles
            && self
                .interfaces
                .between(a, b)
                .is_some_and(|number| !self.is_open(number))
    }
}
