mod constants;
mod dispersion;
mod nodal;
mod searches;
mod severed;

use super::*;
use crate::mesh::solid::Plan;
use crate::mesh::solid::region::{Region, Shape as RegionShape};
use crate::mesh::solid::sites::{Frame, Outline, Range3, Sites};
use crate::potential::{AtCutoff, CutPotential, Interaction, LennardJones};

/// What different orders of summation may make of forces of the size of a bond's.
const ROUNDING: f64 = 1e-11;

fn material(cutoff: f64) -> Material {
    let shape = LennardJones {
        epsilon: 1.0,
        sigma: 1.0,
    };
    let law = CutPotential::new(shape, cutoff, AtCutoff::Truncated);
    Material::face_centred_cubic(Interaction::LennardJones(law), 1.0).expect("the potential binds")
}

/// Nearest neighbours only, as in the source.
const SHORT: f64 = 0.34 / 0.2277;

fn solid(extent: [i32; 3], element: u16, regions: Vec<Region>, removed: Vec<Range3>, spacing: f64) -> Solid {
    let sites = Sites {
        outline: Outline::Rhombohedron(extent),
        frame: Frame::of_blocks(spacing),
        removed,
        cut: None,
    };
    Solid::new(&Plan {
        sites,
        element,
        regions,
        spacing,
    })
}

/// Numbers between -1 and 1 that look random.
fn noise(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// Even strain and shear, and noise of each node.
fn displaced(mesh: &Solid, gradient: [[f64; 3]; 3], amplitude: f64) -> Planes {
    let mut position = mesh.node_positions();
    let mut seed = 7;
    for node in 0..mesh.node_count() {
        let place = position.each_ref().map(|plane| plane[node]);
        for axis in 0..3 {
            let even: f64 = (0..3).map(|other| gradient[axis][other] * place[other]).sum();
            position[axis][node] += even + amplitude * noise(&mut seed);
        }
    }
    position
}

fn check_against_referee(mesh: Solid, material: Material, position: Planes) -> usize {
    check_rule_against_referee(mesh, material, Summation::Exact, position)
}

/// How many interfaces are open then.
fn check_rule_against_referee(mesh: Solid, material: Material, summation: Summation, mut position: Planes) -> usize {
    let mut forces = Forces::shared(Ranks::alone(), mesh, material, summation);
    let mesh = forces.mesh().clone();
    let mut force = [0, 1, 2].map(|_| vec![0.0; mesh.node_count()]);
    let mut measure = Measure::default();
    forces
        .compute_and_measure(&mut position, &mut force, &mut measure)
        .expect("nothing flies away");
    let (expected, held) = referee::forces(&mesh, &material, summation, &position);
    let largest = expected
        .iter()
        .flatten()
        .fold(1.0, |most: f64, force| most.max(force.abs()));
    for node in 0..mesh.node_count() {
        for axis in 0..3 {
            let [found, expected] = [force[axis][node], expected[axis][node]];
            let element = mesh.elements[mesh.element_of_node(node)];
            assert!(
                (found - expected).abs() < ROUNDING * largest,
                "{element:?}: {found} for {expected}"
            );
        }
    }
    for element in 0..mesh.elements.len() {
        let pairs = [
            (measure.energy(element), held.energy(element)),
            (measure.pairs(element), held.pairs(element)),
        ];
        let virials = measure.virial(element).into_iter().zip(held.virial(element));
        for (found, expected) in pairs.into_iter().chain(virials) {
            assert!(
                (found - expected).abs() < ROUNDING * largest * 1e3,
                "{found} for {expected}"
            );
        }
    }
    let mut unmeasured = force.clone();
    forces
        .compute(&mut position, &mut unmeasured)
        .expect("nothing flies away");
    assert_eq!(unmeasured, force);
    forces.open_interfaces().len()
}

const NONE: [[f64; 3]; 3] = [[0.0; 3]; 3];
const MIXED_STRAIN: [[f64; 3]; 3] = [[0.004, 0.003, 0.0], [0.001, -0.003, 0.002], [0.0, 0.004, 0.005]];

#[test]
fn forces_are_those_of_the_plain_sum_on_intact_and_strained_blocks() {
    // [Deng2011] Eq. (3-31).
    let material = material(SHORT);
    for (size, extent) in [(3, [9, 6, 6]), (5, [10, 10, 5]), (6, [6, 12, 6])] {
        for (gradient, amplitude) in [(NONE, 0.0), (MIXED_STRAIN, 0.0), (MIXED_STRAIN, 0.01)] {
            let mesh = solid(extent, size, vec![], vec![], material.spacing);
            let position = displaced(&mesh, gradient, amplitude);
            let open = check_against_referee(mesh, material, position);
            assert!(amplitude > 0.0 || open == 0, "size {size}: {open} open");
        }
    }
}

#[test]
fn forces_are_those_of_the_plain_sum_where_sizes_and_atoms_are_mixed() {
    let material = material(SHORT);
    let ball = Region {
        shape: RegionShape::Ball {
            center: [5.0, 4.0, 2.0],
            radius: 2.0,
        },
        element: 1,
    };
    let half = Region {
        shape: RegionShape::Box {
            from: [-9.0; 3],
            to: [4.0, 4.0, 9.0],
        },
        element: 3,
    };
    let slot = Range3 {
        from: [0, 5, 0],
        to: [3, 7, 6],
    };
    for regions in [vec![ball], vec![half], vec![ball, half]] {
        let mesh = solid([12, 12, 6], 6, regions, vec![slot], material.spacing);
        let position = displaced(&mesh, MIXED_STRAIN, 0.01);
        check_against_referee(mesh, material, position);
    }
}

#[test]
fn forces_are_those_of_the_plain_sum_for_atoms_and_for_long_cutoffs() {
    for cutoff in [SHORT, 2.5] {
        let material = material(cutoff);
        for size in [1, 5] {
            let mesh = solid([10, 5, 5], size, vec![], vec![], material.spacing);
            let position = displaced(&mesh, MIXED_STRAIN, 0.01);
            check_against_referee(mesh, material, position);
        }
    }
}

#[test]
fn forces_are_those_of_the_plain_sum_where_a_body_has_cracked_slipped_and_broken_up() {
    let material = material(SHORT);
    let spacing = material.spacing;
    // Everything beyond a plane is moved away, along it by a lattice vector, or everywhere by a lot.
    let moves: [[f64; 3]; 3] = [
        [0.0, 0.0, 0.8 * spacing],
        [spacing, 0.0, 0.0],
        [0.3 * spacing, 0.1, 0.05],
    ];
    for (number, way) in moves.into_iter().enumerate() {
        let mesh = solid([10, 10, 10], 5, vec![], vec![], spacing);
        let mut position = displaced(&mesh, NONE, if number == 2 { 0.1 } else { 0.0 });
        for element in 0..mesh.elements.len() {
            if mesh.elements[element].anchor[2] >= 5 {
                for node in mesh.nodes_of(element) {
                    (0..3).for_each(|axis| position[axis][node] += way[axis]);
                }
            }
        }
        let open = check_against_referee(mesh, material, position);
        assert!(open > 0);
    }
}

#[test]
fn nothing_pulls_in_the_crystal_at_rest_and_after_a_slip_by_a_lattice_vector() {
    let material = material(SHORT);
    let spacing = material.spacing;
    let mesh = solid([15, 15, 10], 5, vec![], vec![], spacing);
    let mut forces = Forces::new(mesh.clone(), material);
    let mut force = [0, 1, 2].map(|_| vec![1.0; mesh.node_count()]);
    let mut at_rest = mesh.node_positions();
    forces.compute(&mut at_rest, &mut force).expect("nothing flies away");
    assert!(force.iter().flatten().all(|force| force.abs() < 1e-10));
    let mut position = at_rest;
    for element in 0..mesh.elements.len() {
        if mesh.elements[element].anchor[2] >= 5 {
            mesh.nodes_of(element).for_each(|node| position[0][node] += spacing);
        }
    }
    forces.compute(&mut position, &mut force).expect("nothing flies away");
    assert!(!forces.open_interfaces().is_empty());
    // At the rims of the slipped plane bonds are missing.
    let inside = |element: &usize| {
        let [i, j, _] = mesh.elements[*element].anchor;
        i == 5 && j == 5
    };
    for element in (0..mesh.elements.len()).filter(inside) {
        for node in mesh.nodes_of(element) {
            assert!(
                (0..3).all(|axis| force[axis][node].abs() < 1e-9),
                "{:?}",
                mesh.elements[element]
            );
        }
    }
}

#[test]
fn the_stable_step_of_atoms_is_the_closed_form_and_blocks_allow_longer_ones() {
    // Nearest neighbours: omega^2 = 8 k/m for atoms, k = 72/2^(1/3); the limit 0.0935 of the reference.
    let material = material(SHORT);
    let limit = |size: u16| {
        let mesh = solid([20, 20, 10], size, vec![], vec![], material.spacing);
        let position = mesh.node_positions();
        2.0 / Forces::new(mesh, material).squared_frequency_bound(&position).sqrt()
    };
    let atoms = 2.0 / (8.0 * 72.0 / 2f64.cbrt()).sqrt();
    assert!((limit(1) / atoms - 1.0).abs() < 1e-12 && (atoms - 0.0935).abs() < 1e-4);
    // Measured for the whole by Bloch waves: 2.16 times for n = 10.
    let longer = limit(10) / atoms;
    assert!((1.9..2.17).contains(&longer), "{longer}");
}

#[test]
fn threads_leave_no_trace_in_a_sum() {
    let material = material(SHORT);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads can be started");
        pool.install(|| {
            let ball = Region {
                shape: RegionShape::Ball {
                    center: [9.0, 7.0, 2.0],
                    radius: 3.0,
                },
                element: 1,
            };
            let mesh = solid([30, 20, 10], 5, vec![ball], vec![], material.spacing);
            let mut position = displaced(&mesh, MIXED_STRAIN, 0.02);
            let mut forces = Forces::new(mesh, material);
            let mut force = [0, 1, 2].map(|_| vec![0.0; position[0].len()]);
            let mut measure = Measure::default();
            forces
                .compute_and_measure(&mut position, &mut force, &mut measure)
                .expect("nothing flies away");
            (force, measure)
        })
    };
    let one = on(1);
    assert!([2, 3, 7].into_iter().all(|threads| on(threads) == one));
}

#[test]
fn gauss_rules_come_near_the_sum_over_all_bonds_and_conserve_momentum() {
    let material = material(SHORT);
    let mesh = solid([20, 10, 10], 10, vec![], vec![], material.spacing);
    let mut position = displaced(&mesh, MIXED_STRAIN, 0.002);
    let mut of = |summation: Summation| {
        let mut forces = Forces::shared(Ranks::alone(), mesh.clone(), material, summation);
        let mut force = [0, 1, 2].map(|_| vec![0.0; mesh.node_count()]);
        forces.compute(&mut position, &mut force).expect("nothing flies away");
        assert!(forces.open_interfaces().is_empty());
        force
    };
    let exact = of(Summation::Exact);
    let largest = exact
        .iter()
        .flatten()
        .fold(0.0, |most: f64, force| most.max(force.abs()));
    // Measured for a gradient that changes by 1 % across a face: 0.1 % and 2e-6.
    for (points, tolerance) in [(3, 3e-3), (6, 1e-5)] {
        let force = of(Summation::Gauss { points });
        for (found, expected) in force.iter().flatten().zip(exact.iter().flatten()) {
            assert!(
                (found - expected).abs() < tolerance * largest,
                "{points} points: {found} for {expected}"
            );
        }
        for plane in &force {
            assert!(plane.iter().sum::<f64>().abs() < ROUNDING * largest * 1e2);
        }
    }
}

#[test]
fn ranks_that_share_a_bar_hear_from_their_neighbours_as_many_nodes_as_lie_beside_them() {
    let material = material(SHORT);
    let mesh = solid([12, 12, 96], 6, vec![], vec![], material.spacing);
    let [one, two, eight]: [crate::domain::Burden; 3] = burdens(&mesh, &material, &[1, 2, 8]).try_into().unwrap();
    assert_eq!((one.work, one.messages, one.bytes), (1.0, 0, 0));
    assert_eq!((two.work, two.messages), (0.5, 1));
    // An inner part has two neighbours, each with a layer of four blocks: octahedra and tetrahedra that touch it.
    assert_eq!((eight.work, eight.messages), (0.125, 2));
    assert!(
        eight.bytes > two.bytes && eight.bytes <= 2 * 4 * 14 * 24,
        "{}",
        eight.bytes
    );
}
