use super::{AtCutoff, CutPotential, LennardJones, PairValue};

/// Central differences over this distance leave its square times the third derivative, some thousands here.
const STEP: f64 = 1e-5;
const DIFFERENCE_ERROR: f64 = 1e-6;
const ROUNDING: f64 = 1e-12;

const LJ: LennardJones = LennardJones {
    epsilon: 1.0,
    sigma: 1.0,
};

#[test]
fn a_shifted_potential_is_the_truncated_one_less_its_energy_at_the_cutoff() {
    let cutoff: f64 = 1.5;
    let [truncated, shifted] =
        [AtCutoff::Truncated, AtCutoff::Shifted].map(|at_cutoff| CutPotential::new(LJ, cutoff, at_cutoff));
    let at_cutoff = 4.0 * (cutoff.powi(-12) - cutoff.powi(-6));
    for distance in [0.95_f64, 1.1, 1.3, 1.499_999] {
        let [whole, less] = [truncated, shifted].map(|law| law.evaluate(distance * distance));
        assert_eq!(whole.slope, less.slope);
        assert!((whole.energy - less.energy - at_cutoff).abs() < ROUNDING, "{distance}");
    }
}

#[test]
fn the_faces_of_a_cut_repel_by_the_potential_up_to_its_minimum_stretched_to_the_spacing() {
    let (spacing, minimum) = (1.1132, 2f64.powf(1.0 / 6.0));
    let law = CutPotential::new(LJ, 2.5, AtCutoff::Truncated);
    let pressed = |distance: f64| -> PairValue { law.repulsion(distance * distance, spacing) };
    for distance in [0.95, 1.0, 1.05, 1.1] {
        let stretched: f64 = distance * minimum / spacing;
        let expected = 1.0 + 4.0 * (stretched.powi(-12) - stretched.powi(-6));
        assert!((pressed(distance).energy - expected).abs() < ROUNDING, "{distance}");
        let force = |distance: f64| pressed(distance).slope * distance;
        let slope = (pressed(distance + STEP).energy - pressed(distance - STEP).energy) / (2.0 * STEP);
        let curvature = (force(distance + STEP) - force(distance - STEP)) / (2.0 * STEP);
        let found = law.repulsion_curvature(distance, spacing);
        assert!(
            (slope - force(distance)).abs() < DIFFERENCE_ERROR * (1.0 + slope.abs()),
            "{distance}"
        );
        assert!(
            (curvature - found).abs() < DIFFERENCE_ERROR * (1.0 + curvature.abs()),
            "{distance}"
        );
    }
}
