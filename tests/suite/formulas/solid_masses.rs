//! Masses of tetrahedra and octahedra, coupled or not, against sums over the sites.

use cgaft::integrator::kick;
use cgaft::mesh::solid::element::Element;
use cgaft::mesh::solid::region::{Region, Shape};
use cgaft::mesh::solid::sites::{Frame, Outline, Sites};
use cgaft::mesh::solid::{Plan, Solid};
use cgaft::state::State;
use nalgebra::DMatrix;

use super::ROUNDING;
use crate::suite::specimens::Noise;

const SITE_MASS: f64 = 2.0;
const TIME: f64 = 0.3;

/// Blocks of a size, and atoms at one end.
fn mesh(element: u16) -> Solid {
    let size = i32::from(element);
    Solid::new(&Plan {
        sites: Sites {
            outline: Outline::Rhombohedron([3 * size, size, 2 * size]),
            frame: Frame::of_blocks(1.0),
            removed: vec![],
            cut: None,
        },
        element,
        regions: vec![Region {
            shape: Shape::Ball {
                center: [0.0; 3],
                radius: 1.0,
            },
            element: 1,
        }],
        spacing: 1.0,
    })
}

/// The mass matrix of an element, site by site: a share of m sum_a N_i(a) N_j(a), and of the rest the row sums.
/// [Deng2011] Eq. (3-29)
fn mass_matrix(element: Element, consistent: f64) -> DMatrix<f64> {
    let nodes = element.shape.node_count();
    let mut matrix = DMatrix::zeros(nodes, nodes);
    for local in element.locals() {
        let shape = element.shape_functions(local);
        for i in 0..nodes {
            matrix[(i, i)] += (1.0 - consistent) * SITE_MASS * shape[i];
            (0..nodes).for_each(|j| matrix[(i, j)] += consistent * SITE_MASS * shape[i] * shape[j]);
        }
    }
    matrix
}

/// Elements whose nodes move and are pulled at random.
fn moving(mesh: &Solid, consistent: f64) -> State<3> {
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

#[test]
fn a_kick_gives_tetrahedra_and_octahedra_the_momenta_of_their_forces_and_energy_is_that_of_their_mass_matrices() {
    // [Deng2011] Eq. (3-34)
    for (size, consistent) in [4, 10]
        .into_iter()
        .flat_map(|size| [0.0, 0.6, 1.0].map(|share| (size, share)))
    {
        let mesh = mesh(size);
        assert!(mesh.parts > 3 && mesh.atom_count() > 0);
        let before = moving(&mesh, consistent);
        let mut after = before.clone();
        // Elements and atoms apart, as ranks have them.
        kick(
            &mut after,
            &[0..mesh.part_nodes(), mesh.part_nodes()..mesh.node_count()],
            TIME,
        );
        let mut energy = 0.0;
        for (number, &element) in mesh.elements.iter().enumerate() {
            let matrix = mass_matrix(element, consistent);
            let nodes: Vec<usize> = mesh.nodes_of(number).collect();
            for axis in 0..3 {
                let of = |plane: &[f64]| nodes.iter().map(|&node| plane[node]).collect::<Vec<f64>>();
                let [was, is, force] =
                    [&before.velocity, &after.velocity, &before.force].map(|planes| of(&planes[axis]));
                for i in 0..nodes.len() {
                    let momentum: f64 = (0..nodes.len()).map(|j| matrix[(i, j)] * (is[j] - was[j])).sum();
                    let off = (momentum - TIME * force[i]).abs();
                    assert!(
                        off < ROUNDING,
                        "{element:?} {consistent}: {momentum} for {}",
                        TIME * force[i]
                    );
                    energy += 0.5 * (0..nodes.len()).map(|j| matrix[(i, j)] * was[i] * was[j]).sum::<f64>();
                }
            }
        }
        let found = before.kinetic_energy();
        assert!(
            (found / energy - 1.0).abs() < ROUNDING,
            "{consistent}: {found} for {energy}"
        );
    }
}
