//! Stress intensity of a single-edge crack between fixed grips.

use cgaft::analysis::stress_intensity::RING_CLEAR_SHARE;
use cgaft::lattice::triangular;
use cgaft::loading::Grip;
use cgaft::material::Elasticity;
use cgaft::mesh::sites::Layout;

use super::statics::{Shape, Specimen, release};
use super::{SMOOTH, smooth};
use crate::verify::table::{Chapter, Gate};

/// The references come from lattices of this size too, and are some 1 % off the continuum.
const FACTOR: f64 = 2e-2;
const LENGTH: i32 = 121;
/// Of what is four times as high, which would take minutes to come to rest.
const SHORT_LENGTH: i32 = 61;
/// So small that the lattice answers linearly, so large that energies still tell.
const STRAIN: f64 = 2e-4;
const GRIP_ROWS: i32 = 3;

/// K over E strain sqrt(pi a), from the energy that is released.
fn factor(energy_release_rate: f64, crack: f64) -> f64 {
    let material = smooth();
    let young = Elasticity::of(&material).young_modulus();
    (energy_release_rate * young).sqrt() / (young * STRAIN * (std::f64::consts::PI * crack * material.spacing).sqrt())
}

/// From the energies of two cracks that are a little longer and shorter.
fn factor_of_release(shape: &Shape, share: f64) -> f64 {
    let wanted = share * f64::from(shape.layout.triangles);
    let (released, crack) = release(shape, STRAIN, [wanted - 1.0, wanted + 1.0]);
    factor(released, crack)
}

/// From the J-integral, the mean of its rings.
fn factor_of_j(shape: &Shape, share: f64) -> f64 {
    let length = f64::from(shape.layout.triangles);
    let mut specimen = Specimen::new(shape, share * length);
    specimen.stretch(STRAIN);
    specimen.relax();
    let half_height = 0.5 * f64::from(shape.gaps()) * triangular::ROW_HEIGHT;
    let clear = half_height.min(specimen.crack).min(length - specimen.crack);
    let rings = specimen.j_integral(RING_CLEAR_SHARE * clear);
    factor(rings.iter().sum::<f64>() / rings.len() as f64, specimen.crack)
}

/// A sheet of single atoms, its length in spacings.
fn shape(length: i32, ratio: f64, grip: Grip) -> Shape {
    let rows = (ratio * f64::from(length) / triangular::ROW_HEIGHT).round() as i32 - 1 + 2 * GRIP_ROWS;
    let layout = Layout {
        block: 1,
        rows: rows + rows % 2,
        triangles: length,
    };
    Shape {
        layout,
        element: 1,
        grip_rows: GRIP_ROWS,
        grip,
    }
}

const RELEASE: &str = "energy of two crack lengths";
const J_INTEGRAL: &str = "J-integral";

fn claim(grip: Grip, ratio: f64, share: f64) -> String {
    let grip = format!("{grip:?}").to_lowercase();
    format!("K/(E strain sqrt(pi a)), {grip} grips, height {ratio} and crack {share} of the length")
}

/// `factors`: crack over length, and the factor.
fn check(order: &'static str, length: i32, ratio: f64, grip: Grip, factors: &[(f64, f64)]) {
    let mut gate = Gate::new(Chapter::Fracture, order);
    let shape = shape(length, ratio, grip);
    for &(share, expected) in factors {
        let claim = claim(grip, ratio, share);
        let setting = |how: &str| format!("{SMOOTH}, n = 1, {length} r0 long, {how}");
        gate.within(
            &claim,
            &setting(RELEASE),
            factor_of_release(&shape, share),
            expected,
            FACTOR,
        );
        gate.within(
            &claim,
            &setting(J_INTEGRAL),
            factor_of_j(&shape, share),
            expected,
            FACTOR,
        );
    }
    gate.close();
}

#[test]
fn sliding_grips_closer_than_the_length_give_the_single_edge_factors() {
    check(
        "1a single edge",
        LENGTH,
        0.625,
        Grip::Sliding,
        &[(0.1, 0.938), (0.3, 0.567), (0.6, 0.406)],
    );
}

#[test]
fn clamped_grips_closer_than_the_length_give_the_single_edge_factors() {
    check(
        "1b single edge",
        LENGTH,
        0.625,
        Grip::Clamped,
        &[(0.1, 0.891), (0.3, 0.604), (0.6, 0.428)],
    );
}

#[test]
fn sliding_grips_as_far_apart_as_long_give_the_single_edge_factors() {
    check(
        "2 single edge",
        LENGTH,
        1.0,
        Grip::Sliding,
        &[(0.2, 0.873), (0.4, 0.627)],
    );
}

#[test]
fn clamped_grips_as_far_apart_as_long_give_the_single_edge_factors() {
    check(
        "3 single edge",
        LENGTH,
        1.0,
        Grip::Clamped,
        &[(0.2, 0.868), (0.4, 0.657)],
    );
}

#[test]
fn sliding_grips_twice_as_far_apart_give_the_single_edge_factors() {
    check(
        "4 single edge",
        LENGTH,
        2.0,
        Grip::Sliding,
        &[(0.2, 1.066), (0.4, 0.909)],
    );
}

#[test]
fn clamped_grips_twice_as_far_apart_give_the_single_edge_factors() {
    check(
        "5 single edge",
        LENGTH,
        2.0,
        Grip::Clamped,
        &[(0.2, 1.074), (0.4, 0.921)],
    );
}

#[test]
fn sliding_grips_four_times_as_far_apart_give_the_single_edge_factors() {
    check(
        "5 single edge, high",
        SHORT_LENGTH,
        4.0,
        Grip::Sliding,
        &[(0.1, 1.156), (0.3, 1.238), (0.6, 1.128)],
    );
}

/// [Deng2011] Table 5-1: height over length, and crack over length, of models A, B and C.
const FLAT: f64 = 0.314;
const CRACKS: [f64; 3] = [0.05, 0.2, 0.4];
/// The shortest crack has eight spacings at the lower resolution.
const RESOLVED: f64 = 1e-2;
/// At one resolution both methods weigh the same field.
const METHODS: f64 = 1e-3;
const RESOLUTIONS: [i32; 2] = [161, 321];

/// No handbook has these, so that two resolutions and two methods must agree.
fn check_flat(order: &'static str, grip: Grip) {
    let mut gate = Gate::new(Chapter::Fracture, order);
    for share in CRACKS {
        let [coarse, fine] = RESOLUTIONS.map(|length| shape(length, FLAT, grip));
        let claim = claim(grip, FLAT, share);
        let setting = |length: i32, how: &str| format!("{SMOOTH}, n = 1, {length} r0 long, {how}");
        let expected = factor_of_release(&fine, share);
        gate.report(&claim, &setting(RESOLUTIONS[1], RELEASE), expected);
        let found = factor_of_release(&coarse, share);
        gate.within(&claim, &setting(RESOLUTIONS[0], RELEASE), found, expected, RESOLVED);
        let found = factor_of_j(&fine, share);
        gate.within(&claim, &setting(RESOLUTIONS[1], J_INTEGRAL), found, expected, METHODS);
    }
    gate.close();
}

#[test]
fn clamped_grips_of_a_flat_sheet_give_one_factor_whatever_the_method() {
    check_flat("5a single edge, flat", Grip::Clamped);
}

#[test]
fn sliding_grips_of_a_flat_sheet_give_one_factor_whatever_the_method() {
    check_flat("5b single edge, flat", Grip::Sliding);
}
