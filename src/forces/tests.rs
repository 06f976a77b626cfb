use super::*;
use crate::mesh::Plan;
use crate::mesh::cut::Crack;
use crate::mesh::region::{Region, Shape};
use crate::mesh::sites::Layout;
use crate::potential::{AtCutoff, CutPotential, Interaction, LennardJones};
use crate::state::State as Motion;

/// A cracked slab of triangles and atoms, and positions in which some of it is torn. Beyond a cutoff of 1.9 triangles that
/// follow each other in number are neighbours.
fn slab(cutoff: f64) -> (Forces, Planes) {
    let shape = LennardJones {
        epsilon: 1.0,
        sigma: 1.0,
    };
    let law = CutPotential::new(shape, cutoff, AtCutoff::Smooth { from: 1.5 });
    let material = Material::new(Interaction::LennardJones(law), 1.0).expect("the potential binds");
    let layout = Layout {
        block: 10,
        rows: 6,
        triangles: 13,
    };
    let band = Region {
        shape: Shape::Band { half_width: 7.0 },
        element: 1,
    };
    let mesh = Mesh::new(&Plan {
        layout,
        element: 10,
        regions: vec![band],
        crack: Some(Crack::of_length(30.0)),
        grip_rows: 10,
        spacing: material.spacing,
    });
    let mut position = mesh.node_positions();
    for node in 0..mesh.node_count() {
        let [x, y] = [position[0][node], position[1][node]];
        position[0][node] += 0.03 * (0.7 * y).sin();
        position[1][node] += 0.04 * (y - mesh.middle_height()) + 0.3 * (0.5 * x).sin();
    }
    (Forces::new(mesh, material), position)
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    for cutoff in [1.9, 2.5] {
        every_instruction_set_gives_the_same_bits_up_to(cutoff);
    }
}

fn every_instruction_set_gives_the_same_bits_up_to(cutoff: f64) {
    let forces_with = |arch: Arch| {
        let (mut forces, position) = slab(cutoff);
        forces.arch = arch;
        let mut force = position.each_ref().map(|axis| vec![0.0; axis.len()]);
        let mut measure = Measure::default();
        forces
            .compute_and_measure(&mut position.clone(), &mut force, &mut measure)
            .expect("the slab is sound");
        assert!(!forces.open_interfaces().is_empty());
        let state = Motion::at_rest(position, forces.mesh.lumped_masses());
        let bound = forces.squared_frequency_bound(&state);
        let virial = (0..forces.mesh.elements.len()).flat_map(|element| measure.virial(element));
        let numbers = force.into_iter().flatten().chain(virial.collect::<Vec<_>>());
        let [energy, pairs] = [measure.energy(&forces.domain), measure.pairs(&forces.domain)];
        let numbers = numbers.chain([energy, pairs, bound]);
        numbers.map(f64::to_bits).collect::<Vec<_>>()
    };
    let one_by_one = forces_with(Arch::Scalar);
    assert_eq!(forces_with(Arch::new()), one_by_one);
    #[cfg(target_arch = "x86_64")]
    if let Some(avx2) = pulp::x86::V3::try_new() {
        assert_eq!(forces_with(Arch::V3(avx2)), one_by_one);
    }
}
