//! The fast sums against the definition.

use cgaft::forces::{Forces, Planes, referee};
use cgaft::material::Material;
use cgaft::mesh::Mesh;

use super::specimens::{all_materials, all_meshes, nearest_neighbours, states};

/// Sums over the same pairs in another order differ by rounding only.
const ROUNDING: f64 = 1e-12;

fn zeros(mesh: &Mesh) -> Planes {
    [vec![0.0; mesh.node_count()], vec![0.0; mesh.node_count()]]
}

fn largest(planes: &Planes) -> f64 {
    planes.iter().flatten().fold(0.0, |largest: f64, value| largest.max(value.abs()))
}

fn check_against_referee(mesh: &Mesh, material: &Material, position: &Planes, label: &str) {
    let expected = referee::sum_over_all_pairs(mesh, material, position);
    let mut forces = Forces::new(mesh.clone(), *material);
    let mut force = zeros(mesh);
    forces.compute(position, &mut force).expect(label);
    // The forces cancel in the perfect lattice, so they are measured by the bond force at the inflection too.
    let scale = largest(&expected.force).max(material.interaction.curvature(material.spacing) * material.spacing * 0.1);
    for axis in 0..2 {
        for node in 0..mesh.node_count() {
            let difference = (force[axis][node] - expected.force[axis][node]).abs();
            assert!(difference <= ROUNDING * scale, "{label}: node {node}, {difference:e} of {scale:e}");
        }
    }
    let measure = forces.measure(position).expect(label);
    assert_eq!(measure.pairs, expected.pairs, "{label}: pairs within the cutoff");
    let well = 0.01 * material.interaction.curvature(material.spacing) * material.spacing.powi(2);
    let scale = expected.energy.abs().max(expected.pairs * well);
    assert!((measure.energy - expected.energy).abs() <= ROUNDING * scale, "{label}: energy");
}

#[test]
fn fast_sums_equal_the_sum_over_all_pairs_in_every_state_of_every_mesh() {
    for (name, material) in all_materials() {
        for (mesh_name, mesh) in all_meshes(material.spacing) {
            for (state, position) in states(&mesh) {
                check_against_referee(&mesh, &material, &position, &format!("{name}, {mesh_name}, {state}"));
            }
        }
    }
}

#[test]
fn lists_made_earlier_leave_no_trace_in_the_forces() {
    let material = nearest_neighbours();
    for (mesh_name, mesh) in all_meshes(material.spacing) {
        let [early, late] = [0.02, 0.021].map(|strain| {
            super::specimens::displaced(&mesh, |[x, y]| [0.0, strain * y + if y > 26.0 && x < 25.0 { 0.3 } else { 0.0 }])
        });
        let mut kept = Forces::new(mesh.clone(), material);
        let mut fresh = Forces::new(mesh.clone(), material);
        let [mut of_kept, mut of_fresh] = [zeros(&mesh), zeros(&mesh)];
        kept.compute(&early, &mut of_kept).unwrap();
        fresh.restore_open_interfaces(&kept.open_interfaces());
        kept.compute(&late, &mut of_kept).unwrap();
        fresh.compute(&late, &mut of_fresh).unwrap();
        assert!(of_kept == of_fresh, "{mesh_name}");
    }
}

#[test]
fn forces_are_the_same_bits_on_any_number_of_threads() {
    let material = nearest_neighbours();
    for (mesh_name, mesh) in all_meshes(material.spacing) {
        for (state, position) in states(&mesh) {
            let run = |threads: usize| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                pool.install(|| {
                    let mut forces = Forces::new(mesh.clone(), material);
                    let mut force = zeros(&mesh);
                    forces.compute(&position, &mut force).unwrap();
                    (force, forces.measure(&position).unwrap())
                })
            };
            assert!(run(1) == run(3), "{mesh_name}, {state}");
        }
    }
}
