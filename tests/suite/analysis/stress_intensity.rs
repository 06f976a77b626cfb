//! Stress intensity of fields and energies that are known.

use std::f64::consts::PI;

use cgaft::analysis::crack::Tip;
use cgaft::analysis::series::{Probe, Series, Setting};
use cgaft::analysis::stress_intensity::{from_j, griffith, near_tip};

use super::EXACT;
use crate::suite::synthetic::{SPACING, setting};

/// eV/nm^2.5 in MPa sqrt(m).
const MEGAPASCAL_ROOT_METRE: f64 = 160.217_663_4 * 3.162_277_660_168_379e-5;

#[test]
fn the_stress_intensity_of_an_exact_field_is_recovered() {
    let (wanted, tip) = (200.0, 25.6);
    let setting = setting();
    let profile_x: Vec<f64> = (0..400).map(|bin| (f64::from(bin) + 0.5) * SPACING).collect();
    let field = |x: f64| {
        if x > tip {
            wanted / (2.0 * PI * (x - tip)).sqrt() * (1.0 + 0.03 * (x - tip))
        } else {
            0.0
        }
    };
    let profiles = profile_x.iter().map(|&x| [0.0, field(x), 0.0]).collect();
    let series = Series {
        probes: vec![Probe::default()],
        profile_x,
        profiles,
        ..Series::default()
    };
    let fit = near_tip(
        &series,
        0,
        Tip {
            x: tip,
            y: 0.0,
            arc_length: tip,
        },
        &setting,
    )
    .unwrap();
    let kinked = Tip {
        x: tip,
        y: 3.0 * setting.spacing,
        arc_length: tip,
    };
    assert_eq!(
        near_tip(&series, 0, kinked, &setting),
        None,
        "the profile is not ahead of a tip off its plane"
    );
    assert!((fit.value / wanted - 1.0).abs() < 0.01, "{fit:?}");
    assert!(fit.from >= 4.0 * SPACING && fit.bins > 10, "{fit:?}");
}

#[test]
fn k_of_j_is_the_mean_of_the_rings_and_absent_without_them() {
    let setting = setting();
    let with = |j_integral| Series {
        probes: vec![Probe {
            j_integral,
            ..Probe::default()
        }],
        ..Series::default()
    };
    let wanted = 200.0;
    let j = |intensity: f64| (intensity * setting.thickness).powi(2) / setting.young_modulus;
    let found = from_j(&with([0.98, 1.0, 1.02].map(|share| j(share * wanted))), 0, &setting).unwrap();
    assert!(
        (found.value / wanted - 1.0).abs() < EXACT && (found.spread / wanted - 0.02).abs() < EXACT,
        "{found:?}"
    );
    assert_eq!(from_j(&with([f64::NAN; 3]), 0, &setting), None);
    assert_eq!(from_j(&with([-1.0, 1.0, 1.0]), 0, &setting), None);
}

#[test]
fn griffith_of_nearest_neighbour_lennard_jones_is_1_005_mpa_root_metre() {
    let full = griffith(&setting()) * MEGAPASCAL_ROOT_METRE;
    assert!((full - 1.005).abs() < 1e-3, "{full}");
    // Under truncation at 0.34 nm a bond is worth 0.672 epsilon.
    let truncated = Setting {
        fracture_energy: 0.672 * setting().fracture_energy,
        ..setting()
    };
    let share = griffith(&truncated) * MEGAPASCAL_ROOT_METRE / full;
    assert!((share - 0.672_f64.sqrt()).abs() < EXACT);
}
