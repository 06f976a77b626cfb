//! Formulas with values that are found in another way: site by site, by hand, or in closed form.

mod branches;
mod comparison;
mod frequency;
mod masses;
mod readings;
mod solid_masses;
mod units;

use cgaft::analysis::regression;
use cgaft::loading::{Grip, Stretching};
use cgaft::state::State;

use super::specimens::slab;

/// Rounding of a few numbers.
const ROUNDING: f64 = 1e-12;

#[test]
fn the_errors_of_a_line_through_three_points_are_those_that_a_hand_computes() {
    // Means 1 and 1, slope 1/2, residuals -1/2, 1, -1/2 with one degree of freedom: variance 3/2, spread 2.
    let line = regression::line(&[(0.0, 0.0), (1.0, 2.0), (2.0, 1.0)]).unwrap();
    let found = [line.slope, line.intercept, line.slope_error, line.intercept_error];
    let expected = [0.5, 0.5, 0.75_f64.sqrt(), 1.25_f64.sqrt()];
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() < ROUNDING, "{line:?}");
    }
}

#[test]
fn a_specimen_starts_with_its_grips_parted_by_the_strain_of_the_start() {
    const STRAIN: f64 = 0.02;
    let mesh = slab(10, vec![], 0.25);
    let mut state = State::at_rest(mesh.node_positions(), mesh.lumped_masses());
    let loading = Stretching::new(&mesh, 1e-3, Grip::Clamped, false).from_strain(STRAIN);
    loading.pre_stretch(&mesh, &mut state);
    let [low, high] = mesh.grip_edges();
    let middle = 0.5 * (low + high);
    let [_, reference] = mesh.node_positions();
    for (found, height) in state.position[1].iter().zip(reference) {
        let expected = if height < low {
            height - 0.5 * STRAIN * (high - low)
        } else if height > high {
            height + 0.5 * STRAIN * (high - low)
        } else {
            middle + (1.0 + STRAIN) * (height - middle)
        };
        assert!((found - expected).abs() < ROUNDING * high, "{height}");
    }
}
