//! Specimens come to rest.

use cgaft::forces::{Forces, Planes};
use cgaft::loading::{Grip, Load, Stretching};
use cgaft::material::Material;
use cgaft::mesh::Mesh;
use cgaft::potential::AtCutoff;
use cgaft::relaxation::{RelaxationError, Target, relax};
use cgaft::state::State;

use super::specimens::{Noise, all_materials, all_meshes, displaced, lennard_jones, slab};

/// A specimen with its grips held, stretched by this strain.
fn stretched(mesh: &Mesh, material: &Material, strain: f64) -> (Forces, State) {
    let middle = mesh.middle_height() / mesh.spacing;
    let position = displaced(mesh, |[_, y]| [0.0, strain * (y - middle)]);
    let mut state = State::at_rest(position, mesh.lumped_masses());
    Stretching::new(mesh, 1e-3, Grip::Clamped, false).hold(&mut state);
    (Forces::new(mesh.clone(), *material), state)
}

#[test]
fn every_mesh_with_a_crack_comes_to_rest_at_a_minimum_of_the_energy() {
    for (name, material) in all_materials() {
        for (mesh_name, mesh) in all_meshes(material.spacing) {
            let label = format!("{name}, {mesh_name}");
            let (mut forces, mut state) = stretched(&mesh, &material, 5e-3);
            let start = state.position.clone();
            let before = forces.measure(&start).unwrap().energy(forces.domain());
            let rest = relax(&mut forces, &mut state, Target::default()).expect(&label);
            assert!(rest.residual <= Target::default().residual, "{label}: {rest:?}");
            let mut force: Planes = [vec![0.0; state.nodes()], vec![0.0; state.nodes()]];
            forces.compute(&mut state.position.clone(), &mut force).unwrap();
            assert!(force == state.force, "{label}: the forces belong to the positions");
            let after = forces.measure(&state.position).unwrap().energy(forces.domain());
            assert!(after < before, "{label}: {after} is not below {before}");
            let mut noise = Noise(3);
            for axis in 0..2 {
                for node in 0..state.nodes() {
                    if state.mobility[axis][node] == 0.0 {
                        assert_eq!(state.position[axis][node], start[axis][node], "{label}: grips stay");
                    } else {
                        state.position[axis][node] += 1e-3 * mesh.spacing * noise.next();
                    }
                }
            }
            let shaken = forces.measure(&state.position).unwrap().energy(forces.domain());
            assert!(shaken > after, "{label}: {shaken} is not above {after}");
        }
    }
}

#[test]
fn a_start_far_from_the_lattice_finds_the_way_back() {
    let material = lennard_jones(1.9, AtCutoff::Smooth { from: 1.5 });
    let mesh = slab(1, vec![], material.spacing);
    let (mut forces, mut state) = stretched(&mesh, &material, 1e-3);
    relax(&mut forces, &mut state, Target::default()).unwrap();
    let near = forces.measure(&state.position).unwrap().energy(forces.domain());
    let mut noise = Noise(11);
    for axis in 0..2 {
        for node in 0..state.nodes() {
            if state.mobility[axis][node] > 0.0 {
                state.position[axis][node] += 0.15 * mesh.spacing * noise.next();
            }
        }
    }
    relax(&mut forces, &mut state, Target::default()).unwrap();
    let found = forces.measure(&state.position).unwrap().energy(forces.domain());
    assert!((found / near - 1.0).abs() < 1e-12, "{found} for {near}");
}

#[test]
fn a_specimen_that_cannot_rest_in_time_is_reported_with_what_is_left() {
    let material = lennard_jones(1.9, AtCutoff::Smooth { from: 1.5 });
    let mesh = slab(1, vec![], material.spacing);
    let (mut forces, mut state) = stretched(&mesh, &material, 5e-3);
    let few = Target {
        evaluations: 20,
        ..Target::default()
    };
    let error = relax(&mut forces, &mut state, few).unwrap_err();
    let RelaxationError::NotAtRest {
        evaluations, residual, ..
    } = error
    else {
        panic!("{error}")
    };
    assert!(evaluations == 20 && residual > 1e-10);
}
