//! Speeds of long waves in the face-centred cubic crystal, from pulses that run through atoms.

use cgaft::forces::solid::Forces;
use cgaft::integrator::{kick, kick_and_drift, leap};
use cgaft::material::{Cubic, Material};
use cgaft::mesh::solid::sites::{Frame, Outline, Sites};
use cgaft::mesh::solid::{Plan, Solid};
use cgaft::potential::{AtCutoff, CutPotential, Interaction, LennardJones};
use cgaft::state::State;

use crate::verify::table::{Chapter, Gate};

/// The first moment of a pulse travels at the speed of infinitely long waves; the rest is the tails that its two halves share.
const SPEED: f64 = 2e-3;
/// Half width of the Gauss pulse at 1/e, in spacings.
const WIDTH: f64 = 25.0;
/// So small that the lattice answers linearly.
const AMPLITUDE: f64 = 1e-5;
const TIME_STEP: f64 = 0.04;
/// Length of the bar, and where the first moment is read: after the halves have parted, and before an end is met; spacings.
const LENGTH: f64 = 500.0;
const READ_AFTER: [f64; 2] = [100.0, 160.0];

/// A bar of a crystal without end across: in a plane wave the atoms of a layer across it move together, and one in the middle
/// stands for all.
struct Bar {
    mesh: Solid,
    /// The atom that stands for the layer of each.
    leader: Vec<usize>,
}

impl Bar {
    /// x along one direction of the cube, z along another.
    fn new(material: &Material, [x, z]: [[i32; 3]; 2]) -> Self {
        let y = [
            z[1] * x[2] - z[2] * x[1],
            z[2] * x[0] - z[0] * x[2],
            z[0] * x[1] - z[1] * x[0],
        ];
        let spacing = material.spacing;
        // Atoms in the middle have all of their partners.
        let across = 2.0 * (material.interaction.cutoff() + 1.5 * spacing);
        let mesh = Solid::new(&Plan {
            sites: Sites {
                outline: Outline::Box([LENGTH * spacing, across, across]),
                frame: Frame::along([x, y, z], spacing),
                removed: vec![],
                cut: None,
            },
            element: 1,
            regions: vec![],
            spacing,
        });
        let [along, y, z] = mesh.node_positions();
        let off_axis = |node: usize| (y[node] - 0.5 * across).hypot(z[node] - 0.5 * across);
        let mut by_layer: Vec<usize> = (0..along.len()).collect();
        by_layer.sort_by(|&a, &b| along[a].total_cmp(&along[b]));
        let mut leader = vec![0; along.len()];
        for layer in by_layer.chunk_by(|&a, &b| along[b] - along[a] < 0.01 * spacing) {
            let middle = layer
                .iter()
                .copied()
                .min_by(|&a, &b| off_axis(a).total_cmp(&off_axis(b)));
            layer
                .iter()
                .for_each(|&node| leader[node] = middle.expect("a layer has atoms"));
        }
        Self { mesh, leader }
    }

    /// Speed of a pulse along x whose atoms are displaced along an axis.
    fn speed(&self, material: Material, displaced: [f64; 3], expected: f64) -> f64 {
        let mesh = &self.mesh;
        let reference = mesh.node_positions();
        let masses = mesh
            .lumped_masses()
            .iter()
            .map(|mass| mass * material.site_mass)
            .collect();
        let mut state = State::at_rest(reference.clone(), masses);
        let middle = 0.5 * LENGTH * mesh.spacing;
        for node in 0..state.nodes() {
            let distance = (reference[0][node] - middle) / (WIDTH * mesh.spacing);
            let shift = AMPLITUDE * mesh.spacing * (-distance * distance).exp();
            (0..3).for_each(|axis| state.position[axis][node] += shift * displaced[axis]);
        }
        let mut forces = Forces::new(mesh.clone(), material);
        let nodes = state.every_node();
        // Free ends would come to rest where they are not, and the wave of that is larger than the pulse.
        let held = material.interaction.cutoff() + mesh.spacing;
        let is_free = |place: f64| place > held && place < LENGTH * mesh.spacing - held;
        let mut compute = |state: &mut State<3>| {
            for axis in 0..3 {
                for (node, &leader) in self.leader.iter().enumerate() {
                    let shift = match is_free(reference[0][node]) {
                        true => state.position[axis][leader] - reference[axis][leader],
                        false => 0.0,
                    };
                    state.position[axis][node] = reference[axis][node] + shift;
                }
            }
            forces
                .compute(&mut state.position, &mut state.force)
                .expect("the bar is sound");
        };
        compute(&mut state);
        let mut time = 0.0;
        let moments = READ_AFTER.map(|distance| {
            while time * expected < distance * mesh.spacing {
                kick_and_drift(&mut state, &nodes, leap(1, TIME_STEP));
                compute(&mut state);
                kick(&mut state, &nodes, 0.5 * TIME_STEP);
                time += TIME_STEP;
            }
            let [mut sum, mut moment] = [0.0; 2];
            for (node, &leader) in self.leader.iter().enumerate() {
                let place = reference[0][node];
                if node == leader && place > middle && place < 0.98 * LENGTH * mesh.spacing {
                    let along = |axis: usize| (state.position[axis][node] - reference[axis][node]) * displaced[axis];
                    let shift: f64 = (0..3).map(along).sum();
                    sum += shift;
                    moment += shift * place;
                }
            }
            (time, moment / sum)
        });
        (moments[1].1 - moments[0].1) / (moments[1].0 - moments[0].0)
    }
}

#[test]
fn pulses_through_atoms_of_a_solid_run_at_the_speeds_of_christoffels_equation() {
    let mut gate = Gate::new(Chapter::Waves, "4 pulses in solids");
    // Longitudinal along x; transverse along z, and along y where that is another wave.
    let along_x = [1.0, 0.0, 0.0];
    let [y, z] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let directions = [
        ("[100]", [[1, 0, 0], [0, 0, 1]], vec![("L", along_x, 2), ("T", z, 0)]),
        (
            "[110]",
            [[1, 1, 0], [0, 0, 1]],
            vec![("L", along_x, 2), ("T1 [001]", z, 1), ("T2 [1-10]", y, 0)],
        ),
        ("[111]", [[1, 1, 1], [1, -1, 0]], vec![("L", along_x, 2), ("T", z, 0)]),
    ];
    for cutoff in [0.34 / 0.2277, 2.5] {
        let shape = LennardJones {
            epsilon: 1.0,
            sigma: 1.0,
        };
        let law = CutPotential::new(shape, cutoff, AtCutoff::Truncated);
        let material = Material::face_centred_cubic(Interaction::LennardJones(law), 1.0).expect("the potential binds");
        for (name, axes, waves) in &directions {
            let bar = Bar::new(&material, *axes);
            let speeds = Cubic::of(&material).wave_speeds(axes[0].map(f64::from));
            for &(kind, displaced, place) in waves {
                let expected = speeds[place];
                let claim = format!("{kind} along {name}");
                let setting = format!("cutoff {cutoff:.4}, single atoms, Gauss pulse of half width {WIDTH} r0");
                gate.within(
                    &claim,
                    &setting,
                    bar.speed(material, displaced, expected),
                    expected,
                    SPEED,
                );
            }
        }
    }
    gate.close();
}
