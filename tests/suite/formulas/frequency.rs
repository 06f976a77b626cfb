//! The bound of the highest frequency against the stiffness of every triangle, bond by bond.

use cgaft::forces::Forces;
use cgaft::lattice::triangular::{position, vectors_within};
use cgaft::mesh::element::Element;
use cgaft::mesh::sites::Layout;
use cgaft::mesh::{Mesh, Plan};
use cgaft::state::State;
use nalgebra::Matrix6;

use crate::suite::specimens::nearest_neighbours;

/// Eigenvalues of a matrix of six rows, and the zero of the force at the spacing.
const ROUNDING: f64 = 1e-9;

/// The stiffness of a triangle of the perfect lattice with bonds of this stiffness: (N_a - N_b)^2 of each bond inside it, and
/// 2 N_a^2 of each that leaves it, as if that ended at a wall.
fn stiffness(mesh: &Mesh, element: &Element, of_bond: f64) -> Matrix6<f64> {
    let mut sum = Matrix6::zeros();
    for site in element.sites() {
        let own = element.shape_functions(element.local(site));
        for vector in vectors_within(1.0) {
            let other = [site[0] + vector[0], site[1] + vector[1]];
            if mesh.owner_of(other).is_none() {
                continue;
            }
            // A bond inside is met from both of its ends.
            let (weights, count) = if element.contains(other) {
                let far = element.shape_functions(element.local(other));
                ([0, 1, 2].map(|k| far[k] - own[k]), 0.5)
            } else {
                (own, 2.0)
            };
            let along = position(vector);
            sum += Matrix6::from_fn(|row, column| {
                count * of_bond * weights[row / 2] * weights[column / 2] * along[row % 2] * along[column % 2]
            });
        }
    }
    sum
}

#[test]
fn the_frequency_bound_of_the_perfect_lattice_is_the_largest_eigenvalue_of_its_triangles_bond_by_bond() {
    let material = nearest_neighbours();
    // Second derivative of the Lennard-Jones potential at its minimum.
    let of_bond = 72.0 / (material.spacing * material.spacing);
    for size in [4, 10] {
        let mut mesh = Mesh::new(&Plan {
            layout: Layout {
                block: size,
                rows: 6,
                triangles: 41,
            },
            element: size as u16,
            regions: vec![],
            crack: None,
            grip_rows: size,
            spacing: material.spacing,
        });
        mesh.cut = None;
        let triangles = &mesh.elements[..mesh.triangles];
        let expected: Vec<f64> = triangles
            .iter()
            .map(|element| stiffness(&mesh, element, of_bond).symmetric_eigenvalues().max())
            .collect();
        let mut masses = mesh.lumped_masses();
        // Single atoms along the straight sides are faster; heavy ones leave the triangles alone to set the bound.
        masses[mesh.node(mesh.triangles, 0)..].fill(1e9);
        let state = State::at_rest(mesh.node_positions(), masses);
        let mut forces = Forces::new(mesh.clone(), material);
        let bounds = forces.stiffness_bounds(&state.position).unwrap();
        for (found, expected) in bounds.iter().zip(&expected) {
            assert!(
                (found / expected - 1.0).abs() < ROUNDING,
                "n = {size}: {found} for {expected}"
            );
        }
        let over_mass = expected
            .iter()
            .zip(triangles)
            .map(|(bound, element)| bound / element.lumped_mass());
        let expected = over_mass.fold(0.0, f64::max);
        let found = forces.squared_frequency_bound(&state);
        assert!(
            (found / expected - 1.0).abs() < ROUNDING,
            "n = {size}: {found} for {expected}"
        );
    }
}
