//! What sponges before the grips send back.

use cgaft::forces::Forces;
use cgaft::integrator::{kick, kick_and_drift, leap};
use cgaft::loading::{Grip, Layers, Load, Sponge, Stretching};
use cgaft::state::State;

use super::pulses::bar_across_rows;
use super::{SMOOTH, smooth};
use crate::verify::table::{Chapter, Gate};

/// Of the amplitude that goes in, for waves up to as long as the layer is wide.
const REFLECTION: f64 = 0.05;
/// Without a sponge grips throw everything back; dispersion of the packet takes nothing.
const WHOLE: f64 = 0.02;
/// Width of the layers, spacings.
const WIDTH: f64 = 100.0;
/// Length of the packet at 1/e over the wavelength.
const PACKET: f64 = 0.6;
/// So small that the lattice answers linearly.
const AMPLITUDE: f64 = 1e-5;
const TIME_STEP: f64 = 0.05;
const WAVE_SPEED: f64 = 9.0;

/// Amplitude of a packet that has met the upper grip and is back in the middle, over that with which it set out.
fn reflection(wavelength: f64, with_sponge: bool) -> f64 {
    let material = smooth();
    let spacing = material.spacing;
    let (mesh, ghosts) = bar_across_rows(spacing);
    let mut state = State::at_rest(mesh.node_positions(), mesh.lumped_masses());
    let [low, high] = mesh.grip_edges();
    let (middle, number) = (0.5 * (low + high), std::f64::consts::TAU / (wavelength * spacing));
    let width = PACKET * wavelength * spacing;
    for node in (0..state.nodes()).filter(|&node| !ghosts.holds(node)) {
        let s = state.position[1][node] - middle;
        let envelope = AMPLITUDE * spacing * (-(s / width).powi(2)).exp();
        let slope = envelope * (-number * (number * s).sin() - 2.0 * s / width.powi(2) * (number * s).cos());
        state.position[1][node] += envelope * (number * s).cos();
        state.velocity[1][node] = -WAVE_SPEED * slope;
    }
    let mut grips = Stretching::new(&mesh, 0.0, Grip::Clamped, false);
    if with_sponge {
        let layers = Layers {
            width: WIDTH * spacing,
            wave_speed: WAVE_SPEED,
        };
        grips = grips.with_sponge(Some(Sponge::new(&mesh, 0.0, Some(layers), 0.0)));
    }
    grips.hold(&mut state);
    ghosts.hold(&mut state);
    let start = state.kinetic_energy();
    let mut forces = Forces::new(mesh, material);
    let mut time = 0.0;
    let mut compute = |state: &mut State| {
        ghosts.follow(state);
        forces
            .compute(&mut state.position, &mut state.force)
            .expect("the bar is sound");
    };
    compute(&mut state);
    let nodes = state.every_node();
    while time * WAVE_SPEED < high - low {
        kick_and_drift(&mut state, &nodes, leap(1, TIME_STEP));
        grips.damp(&mut state, &nodes, TIME_STEP);
        compute(&mut state);
        kick(&mut state, &nodes, 0.5 * TIME_STEP);
        time += TIME_STEP;
    }
    (state.kinetic_energy() / start).sqrt()
}

#[test]
fn a_sponge_sends_back_a_twentieth_of_a_wave_as_long_as_it_is_wide() {
    let mut gate = Gate::new(Chapter::Waves, "3 sponge");
    let setting = |wavelength: f64| {
        format!("{SMOOTH}, n = 1, longitudinal packet of wavelength {wavelength:.0} r0, layer of {WIDTH:.0} r0")
    };
    let bare = reflection(WIDTH, false);
    let name = "amplitude that a grip without a sponge sends back";
    gate.within(name, &setting(WIDTH), bare, 1.0, WHOLE);
    for wavelength in [0.25 * WIDTH, 0.5 * WIDTH, WIDTH] {
        let name = "amplitude that a grip behind a sponge sends back";
        gate.below(name, &setting(wavelength), reflection(wavelength, true), REFLECTION);
    }
    let name = "amplitude of a wave twice as long as the sponge is wide";
    gate.report(name, &setting(2.0 * WIDTH), reflection(2.0 * WIDTH, true));
    gate.close();
}
