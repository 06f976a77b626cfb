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
use cell::{BondTable, Field};

/// The bonds of a specimen's elements, for as many evaluations as wanted.
pub struct JIntegral {
    material: Material,
    tables: Vec<BondTable>,
    /// Elements that the last rings touched: a tip at rest keeps them.
    touched: Option<(Rings, Vec<u32>)>,
}

impl JIntegral {
    pub fn new(mesh: &Mesh, material: Material) -> Self {
        let mut sizes: Vec<i32> = mesh.elements.iter().map(|element| element.size).collect();
        sizes.dedup();
        Self {
            tables: sizes.iter().map(|&size| BondTable::new(size, &material)).collect(),
            material,
            touched: None,
        }
    }

    /// J of every ring, eV/nm. The forces of the state must be those of its positions.
    pub fn evaluate(&mut self, mesh: &Mesh, state: &State, rings: Rings) -> [f64; RINGS] {
        let (_, touched) = match self.touched.take() {
            Some(known) if known.0 == rings => self.touched.insert(known),
            _ => self.touched.insert((rings, touched(mesh, &rings))),
        };
        let field = Field {
            mesh,
            material: &self.material,
            tables: &self.tables,
            state,
            rings: &rings,
        };
        let parts: Vec<[f64; RINGS]> = touched
            .par_iter()
            .map(|&element| field.contribution(element as usize))
            .collect();
        // In the order of the elements, so that threads leave no trace.
        parts.into_iter().fold([0.0; RINGS], |mut sum, part| {
            (0..RINGS).for_each(|ring| sum[ring] += part[ring]);
            sum
        })
    }
}

/// Elements that may have a bond into the rings, or to an element that reaches into them.
fn touched(mesh: &Mesh, rings: &Rings) -> Vec<u32> {
    let largest = mesh.elements.first().map_or(0, |element| element.size);
    let elements = (0..mesh.elements.len() as u32).into_par_iter();
    let near = |&number: &u32| {
        let element = &mesh.elements[number as usize];
        let anchor = mesh.reference([element.column, element.row]);
        rings.reach(anchor) <= f64::from(element.size + largest) * mesh.spacing
    };
    elements.filter(near).collect()
}
