//! The bonds of nodes alone: [Deng2011] Eq. (3-33).

use super::*;

#[test]
fn forces_are_those_of_the_plain_sum_over_the_bonds_of_nodes() {
    // [Deng2011] Eq. (3-33).
    let material = material(SHORT);
    let spacing = material.spacing;
    for (gradient, amplitude, gap) in [(NONE, 0.0, 0.0), (MIXED_STRAIN, 0.005, 0.0), (MIXED_STRAIN, 0.005, 0.4)] {
        for (size, extent) in [(3, [6, 6, 6]), (5, [10, 10, 10])] {
            let mesh = solid(extent, size, vec![], vec![], spacing);
            let mut position = displaced(&mesh, gradient, amplitude);
            // What lies beyond a plane is moved away along it and from it.
            for element in 0..mesh.elements.len() {
                if mesh.elements[element].anchor[2] >= i32::from(size) {
                    for node in mesh.nodes_of(element) {
                        position[2][node] += gap * spacing;
                        position[0][node] += 0.5 * gap * spacing;
                    }
                }
            }
            let open = check_rule_against_referee(mesh, material, Summation::Nodal, position);
            assert_eq!(open > 0, gap > 0.0, "size {size}");
        }
    }
}

#[test]
fn atoms_and_long_cutoffs_are_summed_by_the_same_rule() {
    for (cutoff, size) in [(SHORT, 1), (2.5, 5)] {
        let material = material(cutoff);
        let mesh = solid([10, 5, 5], size, vec![], vec![], material.spacing);
        let position = displaced(&mesh, MIXED_STRAIN, 0.01);
        check_rule_against_referee(mesh, material, Summation::Nodal, position);
    }
}

#[test]
fn the_forces_are_the_gradient_of_one_energy_and_add_up_to_nothing() {
    let material = material(SHORT);
    let mesh = solid([10, 10, 5], 5, vec![], vec![], material.spacing);
    let mut position = displaced(&mesh, MIXED_STRAIN, 0.005);
    let mut forces = Forces::shared(Ranks::alone(), mesh.clone(), material, Summation::Nodal);
    let mut force = [0, 1, 2].map(|_| vec![0.0; mesh.node_count()]);
    let mut measure = Measure::default();
    let mut energy_at = |position: &mut Planes, force: &mut Planes| -> f64 {
        forces
            .compute_and_measure(position, force, &mut measure)
            .expect("nothing flies away");
        (0..mesh.elements.len()).map(|element| measure.energy(element)).sum()
    };
    energy_at(&mut position, &mut force);
    let largest = force
        .iter()
        .flatten()
        .fold(1.0, |most: f64, force| most.max(force.abs()));
    for plane in &force {
        assert!(plane.iter().sum::<f64>().abs() < ROUNDING * largest * 1e2);
    }
    let mut unused = force.clone();
    for (node, axis) in [(0, 0), (17, 1), (40, 2)] {
        let mut moved = |way: f64| {
            let mut there = position.clone();
            there[axis][node] += way;
            energy_at(&mut there, &mut unused)
        };
        let slope = (moved(STEP) - moved(-STEP)) / (2.0 * STEP);
        assert!(
            (slope + force[axis][node]).abs() < DIFFERENCES * largest,
            "node {node}: {slope} for {}",
            -force[axis][node]
        );
    }
}

/// Step of central differences, and what they leave of the third derivative and of rounding.
const STEP: f64 = 1e-5;
const DIFFERENCES: f64 = 1e-6;

#[test]
fn evenly_strained_blocks_are_at_rest_by_all_bonds_and_not_by_those_of_nodes() {
    // The patch test, which `setup::caution` tells of.
    let material = material(SHORT);
    let mesh = solid([40, 40, 40], 10, vec![], vec![], material.spacing);
    let strain = [[0.0; 3], [0.0; 3], [0.0, 0.0, 0.001]];
    let largest_force = |summation: Summation| {
        let mut position = displaced(&mesh, strain, 0.0);
        let mut forces = Forces::shared(Ranks::alone(), mesh.clone(), material, summation);
        let mut force = [0, 1, 2].map(|_| vec![0.0; mesh.node_count()]);
        forces.compute(&mut position, &mut force).expect("nothing flies away");
        let is_inner = |element: &usize| {
            let mut anchor = mesh.elements[*element].anchor.into_iter();
            anchor.all(|place| (10..30).contains(&place))
        };
        let inner = (0..mesh.elements.len()).filter(is_inner);
        let of_nodes = inner.flat_map(|element| mesh.nodes_of(element));
        of_nodes.map(|node| force[2][node].abs()).fold(0.0, f64::max)
    };
    let [exact, nodal] = [Summation::Exact, Summation::Nodal].map(largest_force);
    assert!(exact < 1e-9 && nodal > 1.0, "{exact}, {nodal}");
}

#[test]
fn the_stability_limit_bounds_the_highest_frequency() {
    let material = material(SHORT);
    let mesh = solid([12, 12, 12], 6, vec![], vec![], material.spacing);
    let at_rest = mesh.node_positions();
    let mut forces = Forces::shared(Ranks::alone(), mesh.clone(), material, Summation::Nodal);
    let bound = forces.squared_frequency_bound(&at_rest);
    let masses: Vec<f64> = mesh.lumped_masses();
    // The power method: a small motion, answered by forces over masses, again and again.
    let mut seed = 3;
    let mut motion = at_rest
        .each_ref()
        .map(|plane| plane.iter().map(|_| noise(&mut seed)).collect::<Vec<f64>>());
    let zero = forces_at(&mut forces, &at_rest);
    let mut found = 0.0;
    for _ in 0..ROUNDS {
        let size = motion.iter().flatten().map(|x| x * x).sum::<f64>().sqrt();
        motion.iter_mut().flatten().for_each(|x| *x *= 1e-4 / size);
        let mut moved = at_rest.clone();
        for (plane, way) in moved.iter_mut().zip(&motion) {
            plane.iter_mut().zip(way).for_each(|(place, way)| *place += way);
        }
        let answer = forces_at(&mut forces, &moved);
        for (axis, plane) in motion.iter_mut().enumerate() {
            for (node, way) in plane.iter_mut().enumerate() {
                *way = (zero[axis][node] - answer[axis][node]) / masses[node];
            }
        }
        found = motion.iter().flatten().map(|x| x * x).sum::<f64>().sqrt() / 1e-4;
    }
    assert!(forces.open_interfaces().is_empty());
    assert!((0.3..1.0).contains(&(found / bound)), "{found} of {bound}");
}

/// Rounds of the power method.
const ROUNDS: u32 = 200;

fn forces_at(forces: &mut Forces, position: &Planes) -> Planes {
    let mut force = position.each_ref().map(|plane| vec![0.0; plane.len()]);
    let mut position = position.clone();
    forces.compute(&mut position, &mut force).expect("nothing flies away");
    force
}
