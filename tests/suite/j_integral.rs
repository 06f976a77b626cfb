//! The J-integral of fields that are known.

use std::f64::consts::PI;

use cgaft::lattice::triangular::SITE_AREA;
use cgaft::material::{Elasticity, Material};
use cgaft::mesh::cut::Crack;
use cgaft::mesh::region::{Region, Shape};
use cgaft::mesh::sites::Layout;
use cgaft::mesh::{Mesh, Plan};
use cgaft::potential::AtCutoff;
use cgaft::solver::j_integral::{JIntegral, Rings};
use cgaft::state::State;

use super::specimens::{displaced, lennard_jones, nearest_neighbours};

/// Rounding of energies of bonds, over the energy that crosses the rings.
const ROUNDING: f64 = 1e-12;

/// Linear elements take gradients with an error that falls with the square of their edge over the radius, here 1/40 for
/// atoms and 1/4 for the largest triangles at the inner ring; where sizes meet, the edge itself counts.
const ATOMS: f64 = 1e-5;
const SMALL_TRIANGLES: f64 = 1e-4;
const TRIANGLES: f64 = 5e-4;
const BOTH: f64 = 5e-3;

/// Distance of the outermost ring, spacings.
const RADIUS: f64 = 80.0;

/// A cracked slab of atoms, of triangles, and of both.
fn meshes(material: &Material, crack_length: Option<f64>) -> Vec<(&'static str, Mesh, f64)> {
    let band = Region {
        shape: Shape::Band {
            half_width: 40.0 * material.spacing,
        },
        element: 1,
    };
    let mesh = |element, regions| {
        Mesh::new(&Plan {
            layout: Layout {
                block: 10,
                rows: 24,
                triangles: 41,
            },
            element,
            regions,
            crack: crack_length.map(Crack::of_length),
            grip_rows: 10,
            spacing: material.spacing,
        })
    };
    vec![
        ("atoms", mesh(1, vec![]), ATOMS),
        ("n = 4", mesh(4, vec![]), SMALL_TRIANGLES),
        ("n = 10", mesh(10, vec![]), TRIANGLES),
        ("atoms in a band", mesh(10, vec![band]), BOTH),
    ]
}

/// Around the middle of a bond at the end of the cut.
fn rings(mesh: &Mesh) -> Rings {
    let x = (mesh.sites.left() + CRACK) * mesh.spacing;
    Rings::within(RADIUS * mesh.spacing, [x, mesh.middle_height()])
}

const CRACK: f64 = 110.25;

fn evaluate(mesh: &Mesh, material: &Material, displacement: impl Fn([f64; 2]) -> [f64; 2]) -> [f64; 3] {
    let state = State::at_rest(displaced(mesh, displacement), mesh.lumped_masses());
    JIntegral::new(mesh, *material).evaluate(mesh, &state, rings(mesh))
}

#[test]
fn nothing_flows_through_a_homogeneous_field_on_any_mesh() {
    for material in [nearest_neighbours(), lennard_jones(1.9, AtCutoff::Smooth { from: 1.5 })] {
        for (name, mesh, _) in meshes(&material, None) {
            let found = evaluate(&mesh, &material, |[x, y]| [0.01 * x - 0.02 * y, 0.03 * x + 0.02 * y]);
            // Energy density times radius.
            let scale = Elasticity::of(&material).c11 * 0.02 * 0.02 * RADIUS * material.spacing;
            for j in found {
                assert!(j.abs() < ROUNDING * scale, "{name}: {found:?} of {scale}");
            }
        }
    }
}

#[test]
fn the_field_of_a_crack_gives_its_energy_release_rate_on_any_mesh() {
    for material in [nearest_neighbours(), lennard_jones(1.9, AtCutoff::Smooth { from: 1.5 })] {
        let elasticity = Elasticity::of(&material);
        let young = elasticity.young_modulus();
        // So small that the lattice answers linearly: a strain of 1e-6 at a distance of one unit.
        let intensity = 1e-6 * young;
        // nu = 1/3 in two dimensions.
        let kappa = 2.0;
        for (name, mesh, tolerance) in meshes(&material, Some(CRACK)) {
            let middle = mesh.middle_height() / mesh.spacing;
            let tip = mesh.sites.left() + CRACK;
            let field = |[x, y]: [f64; 2]| {
                let [x, y] = [x - tip, y - middle];
                let (r, angle) = (x.hypot(y) * mesh.spacing, y.atan2(x));
                let size = intensity / (2.0 * elasticity.c66) * (r / (2.0 * PI)).sqrt() / mesh.spacing;
                let (sin, cos) = (0.5 * angle).sin_cos();
                [
                    size * cos * (kappa - 1.0 + 2.0 * sin * sin),
                    size * sin * (kappa + 1.0 - 2.0 * cos * cos),
                ]
            };
            let expected = intensity * intensity / young;
            let found = evaluate(&mesh, &material, field);
            for j in found {
                assert!(
                    (j / expected - 1.0).abs() < tolerance,
                    "{name}: {:?}",
                    found.map(|j| j / expected)
                );
            }
        }
    }
}

/// Sites summed instead of an integral, and lumped masses, at the inner ring of 32 spacings.
const MOTION: f64 = 2e-2;

#[test]
fn what_accelerates_a_strained_lattice_counts_with_its_displacement_gradient() {
    const STRAIN: f64 = 0.01;
    let material = nearest_neighbours();
    for (name, mesh, _) in meshes(&material, None) {
        let mut state = State::at_rest(displaced(&mesh, |[x, _]| [STRAIN * x, 0.0]), mesh.lumped_masses());
        // The same force on every site.
        state.force[0].clone_from(&state.mass);
        let found = JIntegral::new(&mesh, material).evaluate(&mesh, &state, rings(&mesh));
        let sites = |radius: f64| PI * (radius * RADIUS).powi(2) / SITE_AREA;
        for (j, [inner, outer]) in found.into_iter().zip([[0.4, 0.6], [0.6, 0.8], [0.8, 1.0]]) {
            // q falls linearly with the square of the radius.
            let expected = STRAIN * 0.5 * (sites(inner) + sites(outer));
            assert!((j / expected - 1.0).abs() < MOTION, "{name}: {found:?}, {expected}");
        }
    }
}

#[test]
fn motion_without_strain_drives_no_crack() {
    let material = nearest_neighbours();
    for (name, mesh, _) in meshes(&material, None) {
        let mut state = State::at_rest(mesh.node_positions(), mesh.lumped_masses());
        let x = (mesh.sites.left() + CRACK) * mesh.spacing;
        let radius = RADIUS * material.spacing;
        for node in 0..state.nodes() {
            let place = (state.position[0][node] - x) / radius;
            state.velocity[0][node] = place;
            state.velocity[1][node] = 0.5 + place;
        }
        let found = JIntegral::new(&mesh, material).evaluate(&mesh, &state, rings(&mesh));
        // Kinetic energy density times radius: what either of the two terms would leave alone.
        let scale = 0.5 / (SITE_AREA * material.spacing.powi(2)) * radius;
        for j in found {
            assert!(j.abs() < MOTION * scale, "{name}: {found:?} of {scale}");
        }
    }
}
