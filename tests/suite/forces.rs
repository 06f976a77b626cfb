//! The fast sums against the definition.

use cgaft::domain::Burden;
use cgaft::forces::{Forces, Planes, Summation, burdens, referee};
use cgaft::material::Material;
use cgaft::mesh::sites::Layout;
use cgaft::mesh::{Mesh, Plan};
use cgaft::potential::AtCutoff;
use cgaft::relaxation::bond_strength;
use cgaft::state::State;

use super::specimens::{all_materials, all_meshes, displaced, lennard_jones, nearest_neighbours, slab, states};

/// Sums over the same pairs in another order differ by rounding only.
const ROUNDING: f64 = 1e-12;

fn zeros(mesh: &Mesh) -> Planes {
    [vec![0.0; mesh.node_count()], vec![0.0; mesh.node_count()]]
}

fn largest(planes: &Planes) -> f64 {
    planes
        .iter()
        .flatten()
        .fold(0.0, |largest: f64, value| largest.max(value.abs()))
}

fn check_against_referee(mesh: &Mesh, material: &Material, position: &Planes, summation: Summation, label: &str) {
    let expected = referee::sum_over_all_pairs(mesh, material, position, summation);
    let mut forces = Forces::with_summation(mesh.clone(), *material, summation);
    let mut force = zeros(mesh);
    forces.compute(&mut position.clone(), &mut force).expect(label);
    // The forces cancel in the perfect lattice, so they are measured by the bond force at the inflection too.
    let scale = largest(&expected.force).max(material.interaction.curvature(material.spacing) * material.spacing * 0.1);
    for axis in 0..2 {
        for node in 0..mesh.node_count() {
            let difference = (force[axis][node] - expected.force[axis][node]).abs();
            assert!(
                difference <= ROUNDING * scale,
                "{label}: node {node}, {difference:e} of {scale:e}"
            );
        }
    }
    let measure = forces.measure(position).expect(label);
    let missing = (measure.pairs(forces.domain()) - expected.pairs).abs();
    assert!(
        missing <= ROUNDING * expected.pairs,
        "{label}: {missing} pairs within the cutoff"
    );
    let well = 0.01 * material.interaction.curvature(material.spacing) * material.spacing.powi(2);
    let scale = expected.energy.abs().max(expected.pairs * well);
    assert!(
        (measure.energy(forces.domain()) - expected.energy).abs() <= ROUNDING * scale,
        "{label}: energy"
    );
    // In the perfect lattice the virials of an element's many bonds cancel as forces do.
    let stiffness = material.interaction.curvature(material.spacing) * material.spacing.powi(2);
    let scale = scale_of_virial(&expected.virial).max(stiffness);
    for (element, expected) in expected.virial.iter().enumerate() {
        let virial = measure.virial(element);
        let difference = (0..3).map(|k| (virial[k] - expected[k]).abs()).fold(0.0, f64::max);
        assert!(
            difference <= ROUNDING * scale,
            "{label}: virial of element {element}, {difference:e} of {scale:e}"
        );
    }
}

fn scale_of_virial(virial: &[[f64; 3]]) -> f64 {
    let parts = virial.iter().flatten();
    parts.fold(0.0, |largest: f64, part| largest.max(part.abs()))
}

#[test]
fn fast_sums_equal_the_sum_over_all_pairs_in_every_state_of_every_mesh() {
    for (name, material) in all_materials() {
        for (mesh_name, mesh) in all_meshes(material.spacing) {
            for (state, position) in states(&mesh) {
                let label = format!("{name}, {mesh_name}, {state}");
                check_against_referee(&mesh, &material, &position, Summation::Exact, &label);
            }
        }
    }
}

/// In spacings: the shortest bonds that no string holds have 11, so that a compression by 3 % brings them within it.
const MANY_SHELLS: f64 = 10.69;

#[test]
fn bonds_that_a_small_compression_brings_within_a_long_cutoff_are_found() {
    let spacing = lennard_jones(12.0, AtCutoff::Truncated).spacing;
    let material = lennard_jones(MANY_SHELLS * spacing, AtCutoff::Truncated);
    // Without a crack, next to which all interfaces are tested one by one.
    let mut mesh = slab(10, vec![], material.spacing);
    mesh.cut = None;
    let compressed = displaced(&mesh, |[x, y]| [-0.0295 * x, -0.0295 * y]);
    check_against_referee(&mesh, &material, &compressed, Summation::Exact, "compressed");
}

#[test]
fn bonds_of_nodes_alone_are_the_weighed_sum_over_all_pairs() {
    // [Deng2011] Eq. (3-33)
    let material = nearest_neighbours();
    for (mesh_name, mesh) in all_meshes(material.spacing) {
        for (state, position) in states(&mesh) {
            let label = format!("{mesh_name}, {state}");
            check_against_referee(&mesh, &material, &position, Summation::Nodal, &label);
        }
    }
}

#[test]
fn as_many_gauss_points_as_bonds_are_the_sum_over_all_pairs() {
    // [Deng2011] Eq. (3-31)
    let material = nearest_neighbours();
    for (mesh_name, mesh) in all_meshes(material.spacing) {
        for (state, position) in states(&mesh) {
            let [gauss, exact] = [Summation::Gauss { points: 8 }, Summation::Exact].map(|summation| {
                let mut forces = Forces::with_summation(mesh.clone(), material, summation);
                let mut force = zeros(&mesh);
                forces.compute(&mut position.clone(), &mut force).unwrap();
                force
            });
            // Where every bond is summed, few places stand for all to a share of 1e-12 of the force at 1 % strain.
            for (gauss, exact) in gauss.iter().flatten().zip(exact.iter().flatten()) {
                let error = (gauss - exact).abs() / bond_strength(&material);
                assert!(error < FEW_PLACES, "{mesh_name}, {state}: {error:e}");
            }
        }
    }
}

/// Some ten strings of ten bonds, each of whose forces is good to 1e-12, and rounding.
const FEW_PLACES: f64 = 1e-11;

#[test]
fn a_strict_rule_of_as_many_points_as_bonds_is_the_sum_over_all_pairs_also_where_triangles_have_parted() {
    // [Deng2011] Eq. (3-31)
    let material = nearest_neighbours();
    for (mesh_name, mesh) in all_meshes(material.spacing) {
        // In rubble sites lie all but on top of each other, where forces show any rounding of their places.
        for (state, position) in states(&mesh).into_iter().filter(|(state, _)| *state != "rubble") {
            let rule = Summation::StrictGauss { points: 8 };
            check_against_referee(&mesh, &material, &position, rule, &format!("{mesh_name}, {state}"));
        }
    }
}

/// A smooth curve of so many points has third differences of some 1e-6 of its height.
const SMOOTH_CURVE: f64 = 1e-5;

#[test]
fn a_strict_rule_is_one_energy_without_a_jump_while_two_halves_part() {
    // [Deng2011] Eq. (3-31): the potential is smooth, so that a jump could come from the rule alone.
    let material = lennard_jones(1.9, AtCutoff::Smooth { from: 1.5 });
    let mut mesh = slab(10, vec![], material.spacing);
    mesh.cut = None;
    let middle = mesh.middle_height() / mesh.spacing;
    let parted = |gap: f64| {
        displaced(&mesh, |[x, y]| {
            let opening = gap * (1.0 - x / 60.0);
            [0.0, if y > middle { opening } else { 0.0 }]
        })
    };
    let mut forces = Forces::with_summation(mesh.clone(), material, Summation::StrictGauss { points: 2 });
    let mut force = zeros(&mesh);
    let (step, count) = (2e-3, 500);
    let mut energies = Vec::new();
    for number in 0..count {
        let position = parted(step * f64::from(number));
        forces.compute(&mut position.clone(), &mut force).unwrap();
        energies.push(forces.measure(&position).unwrap().energy(forces.domain()));
    }
    assert!(!forces.open_interfaces().is_empty(), "some have opened on the way");
    // A smooth curve has third differences far below those of a jump.
    let third = |k: usize| energies[k + 3] - 3.0 * energies[k + 2] + 3.0 * energies[k + 1] - energies[k];
    let worst = (0..energies.len() - 3).fold(0.0, |most: f64, k| most.max(third(k).abs()));
    let whole = energies[energies.len() - 1] - energies[0];
    assert!(worst < SMOOTH_CURVE * whole, "{worst:e} of {whole}");
}

/// Each Gauss point divides the error of a smooth sum by the square of (bend over wavelength of the potential), here
/// some hundreds; an eighth is asked.
const CONVERGENCE: f64 = 0.125;

#[test]
fn gauss_points_converge_on_the_sum_over_all_bonds() {
    // [Deng2011] Eq. (3-31)
    let material = lennard_jones(1.9, AtCutoff::Smooth { from: 1.5 });
    let mut mesh = slab(20, vec![], material.spacing);
    mesh.cut = None;
    let bent = displaced(&mesh, |[x, y]| [2e-4 * x * y, 1e-2 * y - 2e-4 * x * x]);
    let energy = |summation| {
        let mut forces = Forces::with_summation(mesh.clone(), material, summation);
        forces.measure(&bent).unwrap().energy(forces.domain())
    };
    let exact = energy(Summation::Exact);
    let error = |points| (energy(Summation::Gauss { points }) - exact).abs();
    let errors = [1, 2, 3].map(error);
    assert!(errors[0] > 0.0, "{errors:?}");
    assert!(
        errors[1] < CONVERGENCE * errors[0] && errors[2] < CONVERGENCE * errors[1],
        "{errors:?}"
    );
}

#[test]
fn lists_made_earlier_leave_no_trace_in_the_forces() {
    let material = nearest_neighbours();
    for (mesh_name, mesh) in all_meshes(material.spacing) {
        let [early, late] = [0.02, 0.021].map(|strain| {
            displaced(&mesh, |[x, y]| {
                [0.0, strain * y + if y > 26.0 && x < 25.0 { 0.3 } else { 0.0 }]
            })
        });
        let mut kept = Forces::new(mesh.clone(), material);
        let mut fresh = Forces::new(mesh.clone(), material);
        let [mut of_kept, mut of_fresh] = [zeros(&mesh), zeros(&mesh)];
        kept.compute(&mut early.clone(), &mut of_kept).unwrap();
        fresh.restore_open_interfaces(&kept.open_interfaces());
        kept.compute(&mut late.clone(), &mut of_kept).unwrap();
        fresh.compute(&mut late.clone(), &mut of_fresh).unwrap();
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
                    forces.compute(&mut position.clone(), &mut force).unwrap();
                    (force, forces.measure(&position).unwrap())
                })
            };
            assert!(run(1) == run(3), "{mesh_name}, {state}");
        }
    }
}

/// Eigenvalues of matrices of a few rows, and sums over the same bonds in another order.
const EIGENVALUE_ROUNDING: f64 = 1e-10;

#[test]
fn the_frequency_bound_is_the_largest_of_all_elements_whether_they_are_computed_side_by_side_or_one_by_one() {
    for (name, material) in all_materials() {
        for (mesh_name, mesh) in all_meshes(material.spacing) {
            for (state_name, position) in states(&mesh) {
                let masses = mesh.lumped_masses();
                let first_nodes = (0..mesh.elements.len()).map(|element| mesh.node(element, 0));
                let mut forces = Forces::new(mesh.clone(), material);
                let bounds = forces.stiffness_bounds(&position).unwrap();
                let each = bounds.iter().zip(first_nodes).map(|(bound, node)| bound / masses[node]);
                let expected = each.fold(0.0, f64::max);
                let state = State::at_rest(position, masses);
                forces.refresh(&state.position).unwrap();
                let found = forces.squared_frequency_bound(&state);
                assert!(
                    (found - expected).abs() <= EIGENVALUE_ROUNDING * expected,
                    "{name}, {mesh_name}, {state_name}: {found} for {expected}"
                );
            }
        }
    }
}

#[test]
fn forces_are_the_same_bits_with_and_without_a_measure_which_does_not_depend_on_what_was_before() {
    let material = nearest_neighbours();
    for (mesh_name, mesh) in all_meshes(material.spacing) {
        for (state, position) in states(&mesh) {
            let mut forces = Forces::new(mesh.clone(), material);
            let mut force = zeros(&mesh);
            forces.compute(&mut position.clone(), &mut force).unwrap();
            let mut measured_force = zeros(&mesh);
            let mut measure = Forces::new(mesh.clone(), material)
                .measure(&mesh.node_positions())
                .unwrap();
            forces
                .compute_and_measure(&mut position.clone(), &mut measured_force, &mut measure)
                .unwrap();
            assert!(force == measured_force, "{mesh_name}, {state}");
            let anew = Forces::new(mesh.clone(), material).measure(&position).unwrap();
            assert!(measure == anew, "{mesh_name}, {state}");
        }
    }
}

#[test]
fn two_ranks_hear_of_a_row_of_triangles_and_an_inner_one_of_a_row_on_either_side() {
    let material = nearest_neighbours();
    let mesh = Mesh::new(&Plan {
        layout: Layout {
            block: 10,
            rows: 6,
            triangles: 9,
        },
        element: 10,
        regions: vec![],
        crack: None,
        grip_rows: 10,
        spacing: material.spacing,
    });
    let found = burdens(&mesh, &material, &[1, 2, 3]);
    let alone = Burden {
        ranks: 1,
        work: 1.0,
        messages: 0,
        bytes: 0,
    };
    // Two coordinates of three corners of nine triangles.
    let row = 9 * 3 * 2 * 8;
    let half = Burden {
        ranks: 2,
        work: 0.5,
        messages: 1,
        bytes: row,
    };
    for (found, expected) in found.iter().zip([alone, half]) {
        assert!((found.work - expected.work).abs() < ROUNDING, "{found:?}");
        let work = found.work;
        assert_eq!(*found, Burden { work, ..expected });
    }
    // Parts are whole groups of triangles, of which half a dozen rows have a dozen.
    let inner = found[2];
    assert!(
        (inner.work - 1.0 / 3.0).abs() < 1.0 / 12.0 && inner.messages == 2,
        "{inner:?}"
    );
    assert!((2 * row..4 * row).contains(&inner.bytes), "{inner:?}");
}
