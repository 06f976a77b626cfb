//! Forces are the gradient of the energy, and the energy knows no place and no direction.

use cgaft::forces::{Forces, Planes, Summation};
use cgaft::material::Material;
use cgaft::mesh::Mesh;
use cgaft::relaxation::bond_strength;

use super::{SMOOTH, largest, smooth, zeros};
use crate::verify::specimens::{Noise, all_materials, all_meshes, states};
use crate::verify::table::{Chapter, Gate};

/// Energies of some 1e4 bonds carry 1e-12, a difference over 1e-4 spacings 1e-8; where the switch of a smooth cutoff
/// begins inside the difference, its third derivative leaves a few 1e-7.
const GRADIENT: f64 = 1e-6;
/// Rounding of a distance, 1e-14, times the stiffness of a bond over its strength, 24, in sums of some hundred bonds.
const FORCE_ROUNDING: f64 = 1e-11;
const ENERGY_ROUNDING: f64 = 1e-12;
/// Components looked at in each state.
const SAMPLES: usize = 6;

/// In the perfect lattice the faces of a cut just touch, and the energy has no second derivative there.
fn without_touching_faces(mut mesh: Mesh, state: &str) -> Mesh {
    if state == "intact" {
        mesh.cut = None;
    }
    mesh
}

fn force_of(mesh: &Mesh, material: &Material, summation: Summation, position: &Planes) -> Planes {
    let mut force = zeros(mesh);
    let mut forces = Forces::with_summation(mesh.clone(), *material, summation);
    forces
        .compute(&mut position.clone(), &mut force)
        .expect("the state is sound");
    force
}

/// Minus the derivative of the energy with one component; `None` where a pair crosses the cutoff meanwhile.
fn slope(forces: &mut Forces, position: &mut Planes, axis: usize, node: usize) -> Option<f64> {
    let step = 1e-4 * forces.material().spacing;
    let place = position[axis][node];
    let mut at = |steps: f64| {
        position[axis][node] = place + steps * step;
        let measure = forces.measure(position).expect("the state is sound");
        position[axis][node] = place;
        (measure.energy(forces.domain()), measure.pairs(forces.domain()))
    };
    let stencil = [-2.0, -1.0, 1.0, 2.0].map(&mut at);
    let [far_below, below, above, far_above] = stencil.map(|(energy, _)| energy);
    let same_pairs = stencil.iter().all(|(_, pairs)| *pairs == stencil[0].1);
    same_pairs.then(|| -(8.0 * (above - below) - (far_above - far_below)) / (12.0 * step))
}

#[test]
fn the_force_is_minus_the_gradient_of_the_energy() {
    let mut gate = Gate::new(Chapter::Energy, "1 gradient");
    for (name, material) in all_materials() {
        let [mut worst, mut looked_at] = [0.0f64, 0.0];
        let mut noise = Noise(5);
        for (mesh_name, mesh) in all_meshes(material.spacing) {
            for (state, mut position) in states(&mesh).into_iter().filter(|(state, _)| *state != "rubble") {
                let mesh = without_touching_faces(mesh.clone(), state);
                let force = force_of(&mesh, &material, Summation::Exact, &position);
                let scale = bond_strength(&material).max(largest(&force));
                let mut forces = Forces::new(mesh.clone(), material);
                for sample in 0..SAMPLES {
                    let node = (0.5 * (1.0 + noise.next()) * (mesh.node_count() - 1) as f64) as usize;
                    if let Some(slope) = slope(&mut forces, &mut position, sample % 2, node) {
                        let error = (slope - force[sample % 2][node]).abs() / scale;
                        assert!(
                            error <= GRADIENT,
                            "{name}, {mesh_name}, {state}, node {node}: {error:e}"
                        );
                        worst = worst.max(error);
                        looked_at += 1.0;
                    }
                }
            }
        }
        assert!(looked_at > 100.0, "{name}: only {looked_at} components");
        let claim = "force + dE/du over a bond's strength, 6 meshes in 5 states";
        gate.below(claim, name, worst, GRADIENT);
    }
    gate.close();
}

#[test]
fn every_rule_of_summation_is_the_gradient_of_its_own_energy() {
    // [Deng2011] Eq. (3-31) and [Deng2011] Eq. (3-33)
    let mut gate = Gate::new(Chapter::Energy, "1 gradient of the rules");
    let material = smooth();
    for (rule, summation) in [("gauss 1", Summation::Gauss { points: 1 }), ("nodal", Summation::Nodal)] {
        let [mut worst, mut looked_at] = [0.0f64, 0.0];
        let mut noise = Noise(6);
        for (mesh_name, mesh) in all_meshes(material.spacing) {
            for (state, mut position) in states(&mesh).into_iter().filter(|(state, _)| *state != "rubble") {
                let mesh = without_touching_faces(mesh.clone(), state);
                let mut forces = Forces::with_summation(mesh.clone(), material, summation);
                let mut force = zeros(&mesh);
                forces
                    .compute(&mut position.clone(), &mut force)
                    .expect("the state is sound");
                let scale = bond_strength(&material).max(largest(&force));
                for sample in 0..SAMPLES {
                    let node = (0.5 * (1.0 + noise.next()) * (mesh.node_count() - 1) as f64) as usize;
                    if let Some(slope) = slope(&mut forces, &mut position, sample % 2, node) {
                        let error = (slope - force[sample % 2][node]).abs() / scale;
                        assert!(
                            error <= GRADIENT,
                            "{rule}, {mesh_name}, {state}, node {node}: {error:e}"
                        );
                        worst = worst.max(error);
                        looked_at += 1.0;
                    }
                }
            }
        }
        assert!(looked_at > 100.0, "{rule}: only {looked_at} components");
        let claim = format!("force + dE/du over a bond's strength, {rule} summation");
        gate.below(&claim, SMOOTH, worst, GRADIENT);
    }
    gate.close();
}

/// Every potential summed exactly, and one by the rules that save time.
fn materials_and_rules() -> Vec<(String, Material, Summation)> {
    let exact = all_materials()
        .into_iter()
        .map(|(name, material)| (name.to_owned(), material, Summation::Exact));
    let rules = [("gauss 2", Summation::Gauss { points: 2 }), ("nodal", Summation::Nodal)];
    let saving = rules.map(|(rule, summation)| (format!("{SMOOTH}, {rule} summation"), smooth(), summation));
    exact.chain(saving).collect()
}

#[test]
fn energy_and_forces_know_no_place_and_no_direction() {
    let mut gate = Gate::new(Chapter::Energy, "2 invariance");
    for (name, material, summation) in materials_and_rules() {
        let [mut worst_energy, mut worst_force] = [0.0f64; 2];
        for (_, mesh) in all_meshes(material.spacing) {
            for (_, position) in states(&mesh) {
                let [energy, force] = change_when_moved(&mesh, &material, summation, &position);
                worst_energy = worst_energy.max(energy);
                worst_force = worst_force.max(force);
            }
        }
        gate.below(
            "energy turned and shifted, change over itself",
            &name,
            worst_energy,
            ENERGY_ROUNDING,
        );
        gate.below(
            "force turned and shifted, change over a bond's strength",
            &name,
            worst_force,
            FORCE_ROUNDING,
        );
    }
    gate.close();
}

/// How much energy, over itself, and forces, over a bond's strength, differ from those of the specimen turned and
/// shifted.
fn change_when_moved(mesh: &Mesh, material: &Material, summation: Summation, position: &Planes) -> [f64; 2] {
    let (sine, cosine) = 0.7f64.sin_cos();
    let turn = |[x, y]: [f64; 2]| [cosine * x - sine * y, sine * x + cosine * y];
    let mut moved = zeros(mesh);
    for node in 0..mesh.node_count() {
        let [x, y] = turn([position[0][node], position[1][node]]);
        [moved[0][node], moved[1][node]] = [x + 3.1, y - 2.7];
    }
    let [here, there] = [position, &moved].map(|position| force_of(mesh, material, summation, position));
    let [energy, energy_there] = [position, &moved].map(|position| {
        let mut forces = Forces::with_summation(mesh.clone(), *material, summation);
        forces
            .measure(position)
            .expect("the state is sound")
            .energy(forces.domain())
    });
    let scale = bond_strength(material).max(largest(&here));
    let mut worst_force = 0.0f64;
    for node in 0..mesh.node_count() {
        let turned = turn([here[0][node], here[1][node]]);
        for axis in 0..2 {
            worst_force = worst_force.max((turned[axis] - there[axis][node]).abs() / scale);
        }
    }
    let scale = energy.abs().max(scale * material.spacing * mesh.sites.len() as f64);
    [(energy - energy_there).abs() / scale, worst_force]
}

#[test]
fn forces_and_torques_of_a_free_specimen_add_up_to_nothing() {
    let mut gate = Gate::new(Chapter::Energy, "3 momentum");
    for (name, material, summation) in materials_and_rules() {
        let [mut worst_force, mut worst_torque] = [0.0f64; 2];
        for (_, mesh) in all_meshes(material.spacing) {
            for (_, position) in states(&mesh) {
                let force = force_of(&mesh, &material, summation, &position);
                let scale = bond_strength(&material).max(largest(&force));
                let nodes = 0..mesh.node_count();
                let torque: f64 = nodes
                    .map(|node| position[0][node] * force[1][node] - position[1][node] * force[0][node])
                    .sum();
                for plane in &force {
                    worst_force = worst_force.max(plane.iter().sum::<f64>().abs() / scale);
                }
                worst_torque = worst_torque.max(torque.abs() / (scale * largest(&position)));
            }
        }
        gate.below(
            "sum of all forces over a bond's strength",
            &name,
            worst_force,
            FORCE_ROUNDING,
        );
        gate.below(
            "sum of all torques over strength times length",
            &name,
            worst_torque,
            FORCE_ROUNDING,
        );
    }
    gate.close();
}
