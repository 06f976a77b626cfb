//! Stress intensity of a single-edge crack from its geometry: what is loaded by grips that move, and what is loaded by a
//! stress, are two problems.

use std::f64::consts::PI;

use crate::analysis::series::Setting;

/// What holds the specimen along x.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grips {
    Clamped,
    Sliding,
}

/// Height between the grips over the length, and for it crack over length and K/(E strain sqrt(pi a)).
type Row = (f64, &'static [(f64, f64)]);

/// From the static release of energy of the lattice itself, `make verify` (single edge); some 1 % off the continuum.
const CLAMPED: [Row; 5] = [
    (0.314, &[(0.05, 0.878), (0.2, 0.530), (0.4, 0.375)]),
    (
        0.625,
        &[
            (0.1, 0.891),
            (0.2, 0.722),
            (0.3, 0.604),
            (0.4, 0.526),
            (0.5, 0.470),
            (0.6, 0.428),
        ],
    ),
    (
        1.0,
        &[
            (0.1, 0.993),
            (0.2, 0.868),
            (0.3, 0.749),
            (0.4, 0.657),
            (0.5, 0.589),
            (0.6, 0.536),
        ],
    ),
    (
        1.6,
        &[
            (0.1, 1.086),
            (0.2, 1.012),
            (0.3, 0.918),
            (0.4, 0.824),
            (0.5, 0.742),
            (0.6, 0.672),
        ],
    ),
    (
        2.0,
        &[
            (0.1, 1.119),
            (0.2, 1.074),
            (0.3, 1.004),
            (0.4, 0.921),
            (0.5, 0.836),
            (0.6, 0.758),
        ],
    ),
];
const SLIDING: [Row; 6] = [
    (0.314, &[(0.05, 0.941), (0.2, 0.499), (0.4, 0.355)]),
    (
        0.625,
        &[
            (0.1, 0.938),
            (0.2, 0.699),
            (0.3, 0.567),
            (0.4, 0.493),
            (0.5, 0.443),
            (0.6, 0.406),
        ],
    ),
    (
        1.0,
        &[
            (0.1, 1.040),
            (0.2, 0.873),
            (0.3, 0.727),
            (0.4, 0.627),
            (0.5, 0.561),
            (0.6, 0.516),
        ],
    ),
    (
        1.6,
        &[
            (0.1, 1.096),
            (0.2, 1.012),
            (0.3, 0.908),
            (0.4, 0.809),
            (0.5, 0.726),
            (0.6, 0.660),
        ],
    ),
    (
        2.0,
        &[
            (0.1, 1.113),
            (0.2, 1.066),
            (0.3, 0.993),
            (0.4, 0.909),
            (0.5, 0.826),
            (0.6, 0.750),
        ],
    ),
    (
        4.0,
        &[
            (0.1, 1.156),
            (0.2, 1.201),
            (0.3, 1.238),
            (0.4, 1.245),
            (0.5, 1.208),
            (0.6, 1.128),
        ],
    ),
];

/// A specimen may be off a geometry of the table by this much, relative: sizes are rounded to whole elements.
const ROUNDING: f64 = 0.02;

/// Cracks (over the length) farther apart than this tell nothing about those between.
const WIDEST_GAP: f64 = 0.101;

/// Crack over length up to which the polynomial for a uniform stress holds to half a percent.
const MOST_CRACK: f64 = 0.6;

/// K/(E strain sqrt(pi a)) of a crack between grips at rest, the strain that of the grips; `None` outside what is known.
pub fn factor_between_grips(grips: Grips, height: f64, length: f64, crack: f64) -> Option<f64> {
    let rows: &[Row] = match grips {
        Grips::Clamped => &CLAMPED,
        Grips::Sliding => &SLIDING,
    };
    let share = crack / length;
    let curve: Vec<(f64, f64)> = rows
        .iter()
        .filter_map(|(ratio, row)| Some((*ratio, between(row, share, WIDEST_GAP)?)))
        .collect();
    between(&curve, height / length, f64::INFINITY)
}

/// K of the crack as cut between the grips, after a strain, eV/nm^2.5; `None` where it comes from no edge.
pub fn between_grips(setting: &Setting, grips: Grips, strain: f64) -> Option<f64> {
    if setting.is_crack_inside() {
        return None;
    }
    let crack = setting.crack_length;
    let factor = factor_between_grips(grips, setting.height, setting.length, crack)?;
    Some(factor * setting.young_modulus / setting.thickness * strain * (PI * crack).sqrt())
}

/// K/(stress sqrt(pi a)) of a crack over this share of a long strip, from its edge, under a uniform stress. After Tada, as
/// handbooks give it, to half a percent up to a share of 0.6; `None` beyond.
pub fn factor_under_stress(share: f64) -> Option<f64> {
    let x = share;
    let factor = 1.12 - 0.231 * x + 10.55 * x.powi(2) - 21.72 * x.powi(3) + 30.39 * x.powi(4);
    (x <= MOST_CRACK).then_some(factor)
}

/// K of the crack as cut under a uniform stress (eV/nm^3) on a long strip, eV/nm^2.5: what the specimen would have if its
/// grips followed; `None` where the crack comes from no edge.
pub fn under_stress(setting: &Setting, stress: f64) -> Option<f64> {
    if setting.is_crack_inside() {
        return None;
    }
    let factor = factor_under_stress(setting.crack_length / setting.length)?;
    Some(factor * stress * (PI * setting.crack_length).sqrt())
}

/// K of the energy that the height of the specimen holds far ahead of a long crack, C11 strain^2 H/2, which is what the
/// crack releases for its advance, eV/nm^2.5: the global balance, exact where crack and ligament are longer than the
/// height.
pub fn of_stored_energy(setting: &Setting, strain: f64) -> f64 {
    let young = setting.young_modulus;
    let stiffness = young / (1.0 - setting.poisson_ratio.powi(2));
    (young * 0.5 * stiffness * setting.height).sqrt() * strain / setting.thickness
}

/// Linear between the points of a curve with rising x that are no farther apart than a gap; near a point its own value.
fn between(curve: &[(f64, f64)], x: f64, widest_gap: f64) -> Option<f64> {
    if let Some(point) = curve.iter().find(|point| (x - point.0).abs() <= ROUNDING * point.0) {
        return Some(point.1);
    }
    let after = curve.iter().position(|point| point.0 > x)?;
    let (left, right) = (curve[after.checked_sub(1)?], curve[after]);
    let width = right.0 - left.0;
    (width <= widest_gap).then(|| left.1 + (right.1 - left.1) * (x - left.0) / width)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_factors_of_the_models_of_table_5_1_are_those_of_their_own_grips() {
        // [Deng2011] Table 5-1, built of whole elements: lengths in nm.
        let model = |length, height, crack| factor_between_grips(Grips::Clamped, height, length, crack).unwrap();
        assert!((model(1127.4, 349.7, 56.0) - 0.878).abs() < 0.01);
        assert!((model(1127.4, 349.7, 450.0) - 0.375).abs() < 0.01);
        assert!((model(565.1, 349.7, 225.0) - 0.53).abs() < 0.01);
        assert!((model(1127.4, 703.8, 450.0) - 0.526).abs() < 0.01);
        assert_eq!(factor_between_grips(Grips::Clamped, 350.0, 1127.0, 10.0), None);
        assert_eq!(
            factor_between_grips(Grips::Clamped, 350.0, 1127.0, 330.0),
            None,
            "too far from both"
        );
        assert!((model(1000.0, 1000.0, 250.0) - 0.8085).abs() < 1e-12, "halfway");
        assert_eq!(factor_between_grips(Grips::Clamped, 5000.0, 1127.0, 225.0), None);
    }

    #[test]
    fn a_long_crack_between_near_grips_releases_what_the_height_ahead_of_it_holds() {
        // The factor of such a crack, and the strip's energy, are found in different ways.
        let (height, length, crack) = (0.314, 1.0, 0.4);
        let of_strip = (0.5 / (1.0 - 1.0 / 9.0) * height / (PI * crack)).sqrt();
        let found = factor_between_grips(Grips::Clamped, height, length, crack).unwrap();
        assert!((found / of_strip - 1.0).abs() < 0.005, "{found} {of_strip}");
    }
}
