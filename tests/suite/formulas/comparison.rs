//! Differences of runs whose difference is known.

use cgaft::analysis::Findings;
use cgaft::analysis::comparison::{Candidate, Difference, difference};
use cgaft::analysis::series::{Probe, Series};
use cgaft::analysis::speed::Speed;

use super::ROUNDING;
use crate::suite::synthetic::setting;

/// A run with a stress proportional to the strain, and a steady crack; the strains are these.
fn steady(strains: impl Iterator<Item = f64>, stress: f64, speed: f64) -> (Series, Findings) {
    let row = |strain| Probe {
        strain,
        sigma_yy: stress * strain,
        ..Probe::default()
    };
    let probes: Vec<Probe> = strains.map(row).collect();
    let speed = Speed {
        value: speed,
        error: 0.0,
    };
    let findings = Findings {
        speeds: vec![Some(speed); probes.len()],
        ..Findings::default()
    };
    let series = Series {
        probes,
        ..Series::default()
    };
    (series, findings)
}

fn compared(stress: f64, speed: f64) -> Difference {
    let setting = setting();
    let (series, findings) = steady((0..=30).map(|k| 1e-3 * f64::from(k)), 1.0, 1.0);
    let (other, other_findings) = steady((0..=30).map(|k| 1e-3 * (f64::from(k) + 0.4)), stress, speed);
    let candidate = |series, findings| Candidate {
        series,
        setting: &setting,
        findings,
        conditions: "",
    };
    difference(candidate(&other, &other_findings), candidate(&series, &findings), None)
}

#[test]
fn runs_that_are_probed_at_other_strains_are_compared_at_equal_ones() {
    let same = compared(1.0, 1.0);
    assert!(
        same.stress.unwrap() < ROUNDING && same.speed.unwrap() < ROUNDING,
        "{same:?}"
    );
}

#[test]
fn a_run_that_is_stiffer_by_a_tenth_and_faster_by_a_fifth_differs_by_that() {
    let differs = compared(1.1, 1.2);
    assert!((differs.stress.unwrap() - 0.1).abs() < ROUNDING, "{differs:?}");
    assert!((differs.speed.unwrap() - 0.2).abs() < ROUNDING, "{differs:?}");
}
