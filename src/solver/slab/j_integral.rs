//! The energy that goes into the tip of a crack, from the field around it: the J-integral over a domain.
//!
//! With P the first Piola stress, W and T the densities of strain and kinetic energy, a and v acceleration and velocity,
//! all in the reference configuration, the crack along x with faces free of traction,
//!
//! J = int [(P_iJ u_i,x - (W + T) d_xJ) q_,J + rho (a_i u_i,x - v_i v_i,x) q] dA,
//!
//! where q is 1 around the tip and falls to 0 at some distance. The line integral is that of Rice (1968), the domain form
//! that of Li, Shih and Needleman (1985), with the terms of inertia that of Nakamura, Shih and Freund (1985). What force is
//! left on the nodes stands for rho a, so that J does not depend on the domain where the lattice is not at rest either.
//!
//! The integral is a sum over elements, single atoms among them. q is carried by the nodes as the displacements are, and
//! every gradient comes from the bonds of the element by least squares ([`cell`]). In a homogeneous field the gradients
//! of q cancel bond by bond, and J is zero to rounding.

mod cell;
mod rings;

pub use rings::Rings;

use rayon::prelude::*;

use crate::analysis::series::RINGS;
use crate::material::Material;
use crate::mesh::Mesh;
use crate::state::State;
use cell::{BondTable, Field, Nodes};

/// Elements in one parallel task.
const TASK: usize = 64;

/// The bonds of a specimen's elements, for as many evaluations as wanted.
pub struct JIntegral {
    material: Material,
    tables: Vec<BondTable>,
    /// The last rings, kept because a tip at rest keeps them.
    rings: Option<Rings>,
    /// Elements that the rings touch, and for every element of the mesh its place among them plus one, zero for the others.
    touched: Vec<u32>,
    place: Vec<u32>,
}

impl JIntegral {
    pub fn new(mesh: &Mesh, material: Material) -> Self {
        let groups = mesh.groups.all().iter().map(|group| group.size);
        let atoms = (mesh.elements.len() > mesh.triangles).then_some(1);
        let mut sizes: Vec<i32> = groups.chain(atoms).collect();
        sizes.dedup();
        Self {
            tables: sizes.iter().map(|&size| BondTable::new(size, &material)).collect(),
            material,
            rings: None,
            touched: Vec::new(),
            place: vec![0; mesh.elements.len()],
        }
    }

    /// J of every ring for the advance of its tip, eV/nm. The forces of the state must be those of its positions.
    pub fn evaluate(&mut self, mesh: &Mesh, state: &State, rings: Rings) -> [f64; RINGS] {
        self.go_to(mesh, rings);
        let touched = self.touched.par_iter().with_min_len(TASK);
        let nodes: Vec<Nodes> = touched
            .clone()
            .map(|&element| cell::nodes_of(mesh, state, &rings, element as usize))
            .collect();
        let field = Field {
            mesh,
            material: &self.material,
            tables: &self.tables,
            state,
            rings: &rings,
            place: &self.place,
            nodes: &nodes,
        };
        let parts: Vec<[f64; RINGS]> = touched.map(|&element| field.contribution(element as usize)).collect();
        // In the order of the elements, so that threads leave no trace.
        let along_x = parts.into_iter().fold([0.0; RINGS], |mut sum, part| {
            (0..RINGS).for_each(|ring| sum[ring] += part[ring]);
            sum
        });
        along_x.map(|j| rings.direction * j)
    }

    /// Elements that [`Self::evaluate`] reads, ascending: those that the rings touch, and others at the far ends of their
    /// bonds.
    pub fn elements_read(&self, mesh: &Mesh, rings: &Rings) -> Vec<u32> {
        let largest = f64::from(largest_size(mesh));
        let reach = self.material.interaction.cutoff() / mesh.spacing + BondTable::BEYOND_CUTOFF;
        elements_near(mesh, rings, 3.0 * largest + reach)
    }

    /// Finds the elements that may have a bond into the rings, or to an element that reaches into them.
    fn go_to(&mut self, mesh: &Mesh, rings: Rings) {
        if self.rings == Some(rings) {
            return;
        }
        self.touched
            .iter()
            .for_each(|&element| self.place[element as usize] = 0);
        self.touched = elements_near(mesh, &rings, f64::from(largest_size(mesh)));
        for (place, &element) in (1..).zip(&self.touched) {
            self.place[element as usize] = place;
        }
        self.rings = Some(rings);
    }
}

fn largest_size(mesh: &Mesh) -> i32 {
    mesh.elements.first().map_or(0, |element| element.size)
}

/// Elements no farther outside the rings than their own size and a distance in spacings, ascending.
fn elements_near(mesh: &Mesh, rings: &Rings, distance: f64) -> Vec<u32> {
    let elements = (0..mesh.elements.len() as u32).into_par_iter();
    let near = |&number: &u32| {
        let element = &mesh.elements[number as usize];
        let anchor = mesh.reference([element.column, element.row]);
        rings.are_within((f64::from(element.size) + distance) * mesh.spacing, anchor)
    };
    elements.filter(near).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Plan;
    use crate::mesh::sites::Layout;
    use crate::potential::{AtCutoff, CutPotential, Interaction, LennardJones};

    #[test]
    fn every_bond_of_what_the_rings_touch_ends_in_an_element_that_is_known_to_be_read() {
        for (element, cutoff) in [(10, 1.5), (1, 1.5), (10, 2.5), (1, 2.5)] {
            let lennard_jones = LennardJones {
                epsilon: 1.0,
                sigma: 1.0,
            };
            let law = CutPotential::new(lennard_jones, cutoff, AtCutoff::Truncated);
            let material = Material::new(Interaction::LennardJones(law), 1.0).unwrap();
            let layout = Layout {
                block: 10,
                rows: 24,
                triangles: 49,
            };
            let mesh = Mesh::new(&Plan {
                layout,
                element,
                regions: vec![],
                crack: None,
                grip_rows: 10,
                spacing: material.spacing,
            });
            let middle = mesh.reference([120, 120]);
            let rings = Rings::within(30.0 * material.spacing, middle);
            let mut integral = JIntegral::new(&mesh, material);
            integral.go_to(&mesh, rings);
            let read = integral.elements_read(&mesh, &rings);
            assert!(read.len() < mesh.elements.len() && integral.touched.len() > 10);
            let ends = integral.touched.iter().flat_map(|&number| {
                let element = &mesh.elements[number as usize];
                let table = integral.tables.iter().find(|table| table.size == element.size);
                let bonds = table.unwrap().leaving(element);
                bonds.filter_map(|(_, _, end)| mesh.owner_of(end)).collect::<Vec<_>>()
            });
            for end in ends {
                assert!(
                    read.binary_search(&(end as u32)).is_ok(),
                    "n = {element}: element {end}"
                );
            }
        }
    }
}
