//! An upper bound of the highest frequency, for a time step that is stable for certain.

mod alike;
mod atoms;
mod bonds;

use std::ops::Range;

use nalgebra::Matrix6;
use rayon::prelude::*;

use super::{CHUNK, ForceError, Forces, Planes};
use crate::potential::{CutPotential, PairShape, with_law};
use crate::state::State;
use bonds::{Bond, BondKind};

/// Elements in one parallel task. The largest of a task is found from the first on, so that it sets what is looked at
/// closely, but not the result.
const TASK: usize = 1024;

impl Forces {
    /// Upper bound of the squared highest angular frequency, 1/ps^2, in a state whose forces have just been computed: lists
    /// and interfaces must be those of its positions. Its last digits depend on which triangles are looked at together, up
    /// to [`Self::FREQUENCY_SLACK`].
    ///
    /// The bonds inside a triangle couple its own nodes only. A bond between two elements stores at most twice what
    /// its two ends would store each against a wall, (u_a - u_b) H (u_a - u_b)/2 <= u_a H+ u_a + u_b H+ u_b with H+
    /// the positive part of the bond's stiffness. So the system is no stiffer than its elements one by one, and the
    /// largest eigenvalue of the small matrices bounds that of the large one. For the perfect crystal of atoms the
    /// bound 6 k/m is exact.
    pub fn squared_frequency_bound(&self, state: &State) -> f64 {
        self.largest(state, self.domain.elements(), false)
    }

    /// The part of it that atoms have.
    pub fn squared_frequency_bound_of_atoms(&self, state: &State) -> f64 {
        let [_, atoms] = self.domain.elements();
        self.largest(state, [atoms], false)
    }

    /// The same to the last bit, by a closer and slower look at every triangle.
    pub fn squared_frequency_bound_one_by_one(&self, state: &State) -> f64 {
        self.largest(state, self.domain.elements(), true)
    }

    /// Largest relative error of [`Self::squared_frequency_bound`], with some room.
    pub const FREQUENCY_SLACK: f64 = 2.0 * alike::SLACK;

    fn largest<const N: usize>(&self, state: &State, elements: [Range<usize>; N], one_by_one: bool) -> f64 {
        let tasks = tasks(elements).into_par_iter();
        let bounds = tasks
            .map(|task| with_law!(self.material.interaction, law => self.largest_of(&law, task, state, one_by_one)));
        self.domain.ranks().largest(bounds.reduce(|| 0.0, f64::max))
    }

    fn largest_of<S: PairShape>(
        &self,
        law: &CutPotential<S>,
        elements: Range<usize>,
        state: &State,
        one_by_one: bool,
    ) -> f64 {
        let mut largest: f64 = 0.0;
        let mut at = elements.start;
        while at < elements.end {
            let mass = state.mass[self.mesh.node(at, 0)];
            let is_alike = !one_by_one && state.coupled.is_empty() && self.are_alike(at, elements.end);
            let of_alike = is_alike
                .then(|| alike::largest(self, law, &state.position, at, [mass, largest]))
                .flatten();
            if at >= self.mesh.triangles {
                let atoms = self.arch.dispatch(atoms::Bounds::new(self, law, at..elements.end));
                return atoms
                    .into_iter()
                    .fold(largest, |largest, bound| largest.max(bound / mass));
            } else if let Some(found) = of_alike {
                largest = found;
                at += alike::WIDTH;
            } else {
                let mut stiffness = self.triangle_stiffness(law, at, &state.position);
                let share = state.coupling_of(self.mesh.node(at, 0));
                if share > 0.0 {
                    stiffness = over_coupled_masses(stiffness, share);
                }
                let known = if one_by_one { 0.0 } else { largest };
                largest = largest.max(largest_eigenvalue(&stiffness, mass, known));
                at += 1;
            }
        }
        largest
    }

    /// Upper bound of every element's stiffness in the current state, eV/nm^2: with these for masses no frequency is
    /// above 1.
    pub fn stiffness_bounds(&mut self, position: &Planes) -> Result<Vec<f64>, ForceError> {
        self.refresh(position)?;
        let [triangles, atoms] = self.domain.elements();
        let mut bounds = vec![0.0; self.mesh.elements.len()];
        with_law!(self.material.interaction, law => {
            let of_triangle =
                |triangle: usize| largest_eigenvalue(&self.triangle_stiffness(&law, triangle, position), 1.0, 0.0);
            let of_triangles = triangles.clone().into_par_iter().with_min_len(CHUNK).map(of_triangle);
            of_triangles.zip(&mut bounds[triangles]).for_each(|(found, bound)| *bound = found);
            if !atoms.is_empty() {
                let found = self.arch.dispatch(atoms::Bounds::new(self, &law, atoms.clone()));
                bounds[atoms].copy_from_slice(&found);
            }
        });
        self.domain.share_elements(&mut bounds);
        Ok(bounds)
    }

    /// Bound of a triangle's stiffness, rows by node and component.
    fn triangle_stiffness<S: PairShape>(
        &self,
        law: &CutPotential<S>,
        element: usize,
        position: &Planes,
    ) -> Matrix6<f64> {
        let shape = &self.mesh.elements[element];
        let mut stiffness = Matrix6::zeros();
        self.for_each_bond(element, position, |bond| {
            let (weights, stiffnesses) = match bond.kind {
                BondKind::Inside { local } => (
                    inside_weights(local, shape.size),
                    self.bond_stiffness(law, &bond, false),
                ),
                BondKind::Across { local, severed } => (
                    shape.shape_functions_between_sites(local),
                    self.bond_stiffness(law, &bond, severed).map(against_a_wall),
                ),
            };
            let [xx, yy, xy] = hessian(bond.vector, stiffnesses);
            let hessian = [[xx, xy], [xy, yy]];
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
    #[inline(always)]
    fn bond_stiffness<S: PairShape>(&self, law: &CutPotential<S>, bond: &Bond, severed: bool) -> [f64; 2] {
        let [x, y] = bond.vector;
        let squared = x * x + y * y;
        let along = if severed {
            law.repulsion_curvature(squared.sqrt(), self.material.spacing)
        } else {
            law.curvature(squared.sqrt())
        };
        let across = self.pair_value(law, squared, severed).slope;
        [bond.count * along, bond.count * across]
    }
}

/// How the nodes of a triangle of this size share in a bond inside it.
fn inside_weights(local: [i32; 2], size: i32) -> [f64; 3] {
    let edge = f64::from(size - 1);
    let [p, q] = local.map(|step| f64::from(step) / edge);
    [-p - q, p, q]
}

fn against_a_wall(stiffness: f64) -> f64 {
    2.0 * stiffness.max(0.0)
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

/// Second derivative of a bond's energy with its vector, xx, yy, xy.
#[inline(always)]
fn hessian([x, y]: [f64; 2], [along, across]: [f64; 2]) -> [f64; 3] {
    let difference = (along - across) / (x * x + y * y);
    [
        across + difference * x * x,
        across + difference * y * y,
        difference * x * y,
    ]
}

/// Largest eigenvalue over the mass; where the sum over a row shows that it is no larger than `known`, that instead.
fn largest_eigenvalue(stiffness: &Matrix6<f64>, mass: f64, known: f64) -> f64 {
    let row_sum = stiffness
        .row_iter()
        .map(|row| row.iter().map(|entry| entry.abs()).sum::<f64>())
        .fold(0.0, f64::max);
    if row_sum <= known * mass {
        return known;
    }
    stiffness.symmetric_eigenvalues().max() / mass
}

/// Ranges of elements, some elements at a time.
fn tasks<const N: usize>(elements: [Range<usize>; N]) -> Vec<Range<usize>> {
    let parts = elements.into_iter().flat_map(|elements| {
        let starts = elements.clone().step_by(TASK);
        starts.map(move |start| start..elements.end.min(start + TASK))
    });
    parts.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of products of matrices of six rows.
    const ROUNDING: f64 = 1e-12;

    #[test]
    fn over_coupled_masses_the_mass_matrix_itself_is_the_identity() {
        for share in [0.05, 0.15, 0.24] {
            let mass = Matrix6::from_fn(|row, column| {
                let own = if row == column { 1.0 - 3.0 * share } else { 0.0 };
                own + if row % 2 == column % 2 { share } else { 0.0 }
            });
            let difference = over_coupled_masses(mass, share) - Matrix6::identity();
            assert!(difference.amax() < ROUNDING, "{share}: {difference}");
        }
    }
}
