//! Speeds of long waves, from pulses that run through atoms.

use cgaft::forces::Forces;
use cgaft::integrator::{kick, kick_and_drift, leap};
use cgaft::mesh::Mesh;
use cgaft::state::State;

use super::torus::Ghosts;
use super::{SMOOTH, block_mesh, smooth};
use crate::verify::table::{Chapter, Gate};

/// The first moment of a pulse travels at the speed of infinitely long waves, and central differences leave that speed
/// as it is; the rest is rounding and the tails that the pulse's two halves share.
const SPEED: f64 = 1e-3;
/// Half width of the Gauss pulse at 1/e, in spacings. Half of the amplitude at the centre of its spectrum is left at a
/// wavelength of pi width/sqrt(ln 2) = 3.77 widths, 113 spacings.
const WIDTH: f64 = 30.0;
/// So small that the lattice answers linearly: its stiffness changes by 20 times the strain.
const AMPLITUDE: f64 = 1e-5;
const TIME_STEP: f64 = 0.05;
/// Where the first moment is read: after the halves have parted, and before an end is met.
const READ_AFTER: [f64; 2] = [130.0, 250.0];

/// Speed of a pulse that travels along an axis and displaces along another.
fn speed(along: usize, displaced: usize, expected: f64) -> f64 {
    let material = smooth();
    let (mesh, ghosts) = if along == 0 {
        bar_along_rows(material.spacing)
    } else {
        bar_across_rows(material.spacing)
    };
    let masses = mesh.lumped_masses();
    let mut state = State::at_rest(mesh.node_positions(), masses);
    let reference = state.position.clone();
    let ends = reference[along]
        .iter()
        .fold([f64::MAX, f64::MIN], |[low, high], &x| [low.min(x), high.max(x)]);
    let middle = 0.5 * (ends[0] + ends[1]);
    for node in 0..state.nodes() {
        let distance = (reference[along][node] - middle) / (WIDTH * mesh.spacing);
        state.position[displaced][node] += AMPLITUDE * mesh.spacing * (-distance * distance).exp();
    }
    ghosts.hold(&mut state);
    let mut forces = Forces::new(mesh, material);
    let mut compute = |state: &mut State| {
        ghosts.follow(state);
        forces
            .compute(&mut state.position, &mut state.force)
            .expect("the bar is sound");
    };
    compute(&mut state);
    let nodes = state.every_node();
    let mut time = 0.0;
    let moments = READ_AFTER.map(|distance| {
        while time * expected < distance * material.spacing {
            kick_and_drift(&mut state, &nodes, leap(1, TIME_STEP));
            compute(&mut state);
            kick(&mut state, &nodes, 0.5 * TIME_STEP);
            time += TIME_STEP;
        }
        let ahead = (0..state.nodes()).filter(|&node| !ghosts.holds(node) && reference[along][node] > middle);
        let [mut sum, mut moment] = [0.0; 2];
        for node in ahead {
            let displacement = state.position[displaced][node] - reference[displaced][node];
            sum += displacement;
            moment += displacement * reference[along][node];
        }
        (time, moment / sum)
    });
    (moments[1].1 - moments[0].1) / (moments[1].0 - moments[0].0)
}

/// Two rows high and 800 spacings long.
fn bar_along_rows(spacing: f64) -> (Mesh, Ghosts) {
    let mesh = block_mesh(1, 8, 801, 1, spacing);
    let ghosts = Ghosts::new(&mesh, [-1, 2], |atom| (3..5).contains(&atom.row));
    (mesh, ghosts)
}

/// One spacing wide and 800 spacings high.
pub fn bar_across_rows(spacing: f64) -> (Mesh, Ghosts) {
    let mesh = block_mesh(1, 924, 9, 1, spacing);
    let ghosts = Ghosts::new(&mesh, [1, 0], |atom| atom.column + atom.row.div_euclid(2) == 4);
    (mesh, ghosts)
}

#[test]
fn pulses_through_atoms_run_at_9_and_root_27() {
    let mut gate = Gate::new(Chapter::Waves, "1 pulses");
    for (axis, direction) in ["along", "across"].into_iter().enumerate() {
        for (kind, displaced, expected) in [("c_L = 9", axis, 9.0), ("c_T = sqrt 27", 1 - axis, 27f64.sqrt())] {
            let claim = format!("{kind}, {direction} the rows");
            let setting = format!("{SMOOTH}, n = 1, Gauss pulse, half its spectrum above 113 r0");
            gate.within(&claim, &setting, speed(axis, displaced, expected), expected, SPEED);
        }
    }
    gate.close();
}
