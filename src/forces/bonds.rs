//! Which bonds of the reference lattice are broken.

use rayon::prelude::*;

use super::affine::site_position;
use super::{Forces, Planes};
use crate::lattice::triangular;

impl Forces {
    /// Nearest-neighbour bonds between different elements that are stretched beyond the breaking length, as
    /// (column, row, direction) by rising row and column. Bonds that the cut severed are not among them.
    ///
    /// An intact interface keeps all its bonds, and what happens inside a triangle is deformation, not a crack.
    pub fn broken_bonds(&self, position: &Planes) -> Vec<[i32; 3]> {
        let quiet: Vec<bool> = (0..self.mesh.triangles)
            .map(|triangle| !self.meets_others(triangle))
            .collect();
        let rows = (0..self.mesh.sites.rows()).into_par_iter();
        rows.flat_map_iter(|row| self.broken_bonds_of_row(row, &quiet, position))
            .collect()
    }

    fn broken_bonds_of_row(&self, row: i32, quiet: &[bool], position: &Planes) -> Vec<[i32; 3]> {
        let mesh = &self.mesh;
        let limit = self.material.breaking_length().powi(2);
        let mut broken = Vec::new();
        for column in mesh.sites.columns(row) {
            let site = [column, row];
            let element = mesh.owner_of(site).expect("the site is in the set");
            if element < mesh.triangles && quiet[element] {
                continue;
            }
            for (direction, vector) in triangular::NEAREST.iter().enumerate() {
                let neighbour = [column + vector[0], row + vector[1]];
                let Some(other) = mesh.owner_of(neighbour) else {
                    continue;
                };
                if other == element || mesh.severed(site, neighbour) || self.is_intact_between(element, other) {
                    continue;
                }
                let [a, b] = [(element, site), (other, neighbour)]
                    .map(|(owner, site)| site_position(mesh, owner, mesh.elements[owner].local(site), position));
                let [x, y] = [b[0] - a[0], b[1] - a[1]];
                if x * x + y * y >= limit {
                    broken.push([column, row, direction as i32]);
                }
            }
        }
        broken
    }

    /// Whether a triangle borders anything but intact interfaces.
    fn meets_others(&self, triangle: usize) -> bool {
        let opened = || {
            self.interfaces
                .of(triangle)
                .iter()
                .any(|&number| self.is_open(number as usize))
        };
        self.interfaces.exposed[triangle] || opened()
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
