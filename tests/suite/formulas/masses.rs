//! Masses, coupled or not, against sums over the sites.

use cgaft::integrator::kick;
use cgaft::mesh::Mesh;
use cgaft::mesh::element::Element;
use cgaft::state::State;

use super::ROUNDING;
use crate::suite::specimens::{Noise, slab};

const SITE_MASS: f64 = 2.0;

/// The mass matrix of an element, site by site: a share of m sum_a N_i(a) N_j(a), and of the rest the row sums.
/// [Deng2011] Eq. (3-29)
fn mass_matrix(element: &Element, consistent: f64) -> [[f64; 3]; 3] {
    let mut matrix = [[0.0; 3]; 3];
    for local in element.locals() {
        let shape = element.shape_functions(local);
        for i in 0..3 {
            matrix[i][i] += (1.0 - consistent) * SITE_MASS * shape[i];
            (0..3).for_each(|j| matrix[i][j] += consistent * SITE_MASS * shape[i] * shape[j]);
        }
    }
    matrix
}

/// A specimen of triangles whose nodes move and are pulled at random.
fn moving(mesh: &Mesh, consistent: f64) -> State {
    let masses = mesh.lumped_masses().into_iter().map(|mass| mass * SITE_MASS);
    let mut state = State::at_rest(mesh.node_positions(), masses.collect());
    if consistent > 0.0 {
        state.couple_masses(mesh, consistent);
    }
    let mut noise = Noise(5);
    for plane in state.velocity.iter_mut().chain(&mut state.force) {
        plane.iter_mut().for_each(|value| *value = noise.next());
    }
    state
}

const SHARES: [f64; 3] = [0.0, 0.65, 1.0];

fn meshes() -> [Mesh; 2] {
    [4, 10].map(|element| slab(element, vec![], 1.0))
}

#[test]
fn a_kick_gives_each_triangle_the_momenta_of_its_forces_through_its_mass_matrix() {
    // [Deng2011] Eq. (3-34)
    const TIME: f64 = 0.3;
    for mesh in meshes() {
        for consistent in SHARES {
            let before = moving(&mesh, consistent);
            let mut after = before.clone();
            kick(&mut after, &before.every_node(), TIME);
            for (number, element) in mesh.elements[..mesh.triangles].iter().enumerate() {
                let matrix = mass_matrix(element, consistent);
                let nodes = mesh.corners_of(number);
                for axis in 0..2 {
                    for i in 0..3 {
                        let change = |j: usize| after.velocity[axis][nodes[j]] - before.velocity[axis][nodes[j]];
                        let momentum: f64 = (0..3).map(|j| matrix[i][j] * change(j)).sum();
                        let impulse = TIME * before.force[axis][nodes[i]];
                        assert!(
                            (momentum - impulse).abs() < ROUNDING,
                            "{consistent}: {momentum} for {impulse}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn the_kinetic_energy_is_that_of_the_mass_matrices() {
    for mesh in meshes() {
        for consistent in SHARES {
            let state = moving(&mesh, consistent);
            let mut expected = 0.0;
            for (number, element) in mesh.elements[..mesh.triangles].iter().enumerate() {
                let matrix = mass_matrix(element, consistent);
                let nodes = mesh.corners_of(number);
                for plane in &state.velocity {
                    for i in 0..3 {
                        (0..3).for_each(|j| expected += 0.5 * matrix[i][j] * plane[nodes[i]] * plane[nodes[j]]);
                    }
                }
            }
            let atoms = mesh.node(mesh.triangles, 0)..state.nodes();
            let squared = |node: usize| state.velocity[0][node].powi(2) + state.velocity[1][node].powi(2);
            expected += atoms.map(|node| 0.5 * SITE_MASS * squared(node)).sum::<f64>();
            let found = state.kinetic_energy();
            assert!(
                (found / expected - 1.0).abs() < ROUNDING,
                "{consistent}: {found} for {expected}"
            );
        }
    }
}
