//! Stress intensity of a single-edge crack between fixed grips.

use cgaft::lattice::triangular;
use cgaft::loading::Grip;
use cgaft::material::Elasticity;
use cgaft::mesh::sites::Layout;

use super::statics::{Shape, release};
use super::{SMOOTH, smooth};
use crate::verify::table::{Chapter, Gate};

/// The references come from lattices of this size too, and are some 1 % off the continuum.
const FACTOR: f64 = 2e-2;
const LENGTH: i32 = 121;
/// So small that the lattice answers linearly, so large that energies still tell.
const STRAIN: f64 = 2e-4;
const GRIP_ROWS: i32 = 3;

/// Height over length, grips, and the factors at a crack of 0.2 and 0.4 of the length.
const FACTORS: [(f64, Grip, [f64; 2]); 4] = [
    (1.0, Grip::Sliding, [0.873, 0.627]),
    (1.0, Grip::Clamped, [0.868, 0.657]),
    (2.0, Grip::Sliding, [1.066, 0.909]),
    (2.0, Grip::Clamped, [1.074, 0.921]),
];

fn factor(shape: &Shape, share: f64) -> f64 {
    let material = smooth();
    let young = Elasticity::of(&material).young_modulus();
    let wanted = share * f64::from(LENGTH);
    let (released, crack) = release(shape, STRAIN, [wanted - 1.0, wanted + 1.0]);
    (released * young).sqrt() / (young * STRAIN * (std::f64::consts::PI * crack * material.spacing).sqrt())
}

fn shape(ratio: f64, grip: Grip) -> Shape {
    let rows = (ratio * f64::from(LENGTH) / triangular::ROW_HEIGHT).round() as i32 - 1 + 2 * GRIP_ROWS;
    let layout = Layout {
        block: 1,
        rows: rows + rows % 2,
        triangles: LENGTH,
    };
    Shape {
        layout,
        element: 1,
        grip_rows: GRIP_ROWS,
        grip,
    }
}

fn check(order: &'static str, number: usize) {
    let mut gate = Gate::new(Chapter::Fracture, order);
    let (ratio, grip, expected) = FACTORS[number];
    for (share, expected) in [0.2, 0.4].into_iter().zip(expected) {
        let found = factor(&shape(ratio, grip), share);
        let grip = format!("{grip:?}").to_lowercase();
        let claim = format!("K/(E strain sqrt(pi a)), {grip} grips, height {ratio} and crack {share} of the length");
        gate.within(
            &claim,
            &format!("{SMOOTH}, n = 1, 121 r0 long"),
            found,
            expected,
            FACTOR,
        );
    }
    gate.close();
}

#[test]
fn sliding_grips_as_far_apart_as_long_give_the_single_edge_factors() {
    check("2 single edge", 0);
}

#[test]
fn clamped_grips_as_far_apart_as_long_give_the_single_edge_factors() {
    check("3 single edge", 1);
}

#[test]
fn sliding_grips_twice_as_far_apart_give_the_single_edge_factors() {
    check("4 single edge", 2);
}

#[test]
fn clamped_grips_twice_as_far_apart_give_the_single_edge_factors() {
    check("5 single edge", 3);
}
