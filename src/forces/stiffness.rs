//! An upper bound of the highest frequency, for a time step that is stable for certain.

use nalgebra::Matrix6;
use rayon::prelude::*;

use super::measure::{Bond, BondKind};
use super::{CHUNK, ForceError, Forces, Planes};
use crate::state::State;

impl Forces {
    /// Upper bound of the squared highest angular frequency in the current state, 1/ps^2.
    ///
    /// The bonds inside a triangle couple its own nodes only. A bond between two elements stores at most twice what
    /// its two ends would store each against a wall, (u_a - u_b) H (u_a - u_b)/2 <= u_a H+ u_a + u_b H+ u_b with H+
    /// the positive part of the bond's stiffness. So the system is no stiffer than its elements one by one, and the
    /// largest eigenvalue of the small matrices bounds that of the large one. For the perfect crystal of atoms the
    /// bound 6 k/m is exact.
    pub fn squared_frequency_bound(&mut self, state: &State) -> Result<f64, ForceError> {
        let position = &state.position;
        self.refresh(position)?;
        self.contacts.place_sites(&self.mesh, position);
        let chunks = self.mesh.elements.len().div_ceil(CHUNK);
        let of_chunk = |chunk: usize| {
            let elements = chunk * CHUNK..self.mesh.elements.len().min((chunk + 1) * CHUNK);
            elements.fold(0.0, |largest: f64, element| {
                let mut stiffness = self.element_stiffness(element, position);
                if let Some(&share) = state.coupling.get(element) {
                    stiffness = over_coupled_masses(stiffness, share);
                }
                let nodes = self.mesh.elements[element].node_count();
                let mass = state.mass[self.mesh.first_node(element)];
                largest.max(largest_eigenvalue(&stiffness, nodes, mass, largest))
            })
        };
        Ok((0..chunks).into_par_iter().map(of_chunk).reduce(|| 0.0, f64::max))
    }

    /// Upper bound of every element's stiffness in the current state, eV/nm^2: with these for masses no frequency is
    /// above 1.
    pub fn stiffness_bounds(&mut self, position: &Planes) -> Result<Vec<f64>, ForceError> {
        self.refresh(position)?;
        self.contacts.place_sites(&self.mesh, position);
        let of_element = |element: usize| {
            let stiffness = self.element_stiffness(element, position);
            largest_eigenvalue(&stiffness, self.mesh.elements[element].node_count(), 1.0, 0.0)
        };
        let elements = (0..self.mesh.elements.len()).into_par_iter();
        Ok(elements.with_min_len(CHUNK).map(of_element).collect())
    }

    /// Bound of an element's stiffness, rows by node and component; an atom fills the first two.
    fn element_stiffness(&self, element: usize, position: &Planes) -> Matrix6<f64> {
        let shape = &self.mesh.elements[element];
        let edge = f64::from((shape.size - 1).max(1));
        let mut stiffness = Matrix6::zeros();
        self.for_each_bond(element, position, |bond| {
            let (weights, stiffnesses) = match bond.kind {
                BondKind::Inside { local } => {
                    let [p, q] = local.map(|step| f64::from(step) / edge);
                    ([-p - q, p, q], self.bond_stiffness(&bond, false))
                }
                BondKind::Across { local, severed } => {
                    let [along, across] = self.bond_stiffness(&bond, severed);
                    (
                        shape.shape_functions_between_sites(local),
                        [2.0 * along.max(0.0), 2.0 * across.max(0.0)],
                    )
                }
            };
            let hessian = hessian(bond.vector, stiffnesses);
            for a in 0..3 {
                for b in 0..3 {
                    let weight = weights[a] * weights[b];
                    for (i, row) in hessian.iter().enumerate() {
                        for (j, entry) in row.iter().enumerate() {
                            stiffness[(2 * a + i, 2 * b + j)] += weight * entry;
                        }
                    }
                }
            }
        });
        stiffness
    }

    /// Stiffness of a bond along its direction and across it: phi'' and phi'/r.
    fn bond_stiffness(&self, bond: &Bond, severed: bool) -> [f64; 2] {
        let [x, y] = bond.vector;
        let squared = x * x + y * y;
        let along = self.contacts.curvature(&self.material, squared.sqrt(), severed);
        let across = self.contacts.value(&self.material, squared, severed).slope;
        [bond.count * along, bond.count * across]
    }
}

/// The stiffness between two inverse roots of the mass matrix over the lumped mass, (1 - 3 c) I + c 1 1^T: the mean of
/// the three nodes keeps its mass, what they move against each other has 1 - 3 c of it.
fn over_coupled_masses(stiffness: Matrix6<f64>, share: f64) -> Matrix6<f64> {
    let apart = 1.0 / (1.0 - 3.0 * share).sqrt();
    let root = Matrix6::from_fn(|row, column| {
        let mean = if row % 2 == column % 2 {
            (1.0 - apart) / 3.0
        } else {
            0.0
        };
        mean + if row == column { apart } else { 0.0 }
    });
    root * stiffness * root
}

/// Second derivative of a bond's energy with its vector.
fn hessian([x, y]: [f64; 2], [along, across]: [f64; 2]) -> [[f64; 2]; 2] {
    let difference = (along - across) / (x * x + y * y);
    let mixed = difference * x * y;
    [
        [across + difference * x * x, mixed],
        [mixed, across + difference * y * y],
    ]
}

/// Largest eigenvalue over the mass; where the sum over a row shows that it is no larger than `known`, that instead.
fn largest_eigenvalue(stiffness: &Matrix6<f64>, nodes: usize, mass: f64, known: f64) -> f64 {
    let row_sum = stiffness
        .row_iter()
        .map(|row| row.iter().map(|entry| entry.abs()).sum::<f64>())
        .fold(0.0, f64::max);
    if row_sum <= known * mass {
        return known;
    }
    if nodes == 1 {
        return stiffness.fixed_view::<2, 2>(0, 0).symmetric_eigenvalues().max() / mass;
    }
    stiffness.symmetric_eigenvalues().max() / mass
}
