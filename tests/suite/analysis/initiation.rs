//! When a crack has started: one event at every rate, on every mesh.

use cgaft::analysis::analyse;
use cgaft::analysis::crack::Tip;
use cgaft::analysis::initiation::{Initiation, initiation};
use cgaft::analysis::series::{BondEvent, Series, Setting};

use super::{EXACT, findings};
use crate::suite::synthetic::{SPACING, breaks, probes, series, setting, straight};

/// Strain between two probes of a course.
const STEP: f64 = 5e-5;

/// A tip that is so many spacings beyond the notch from each of these strains on, straight in between where `straight`; the
/// strain grows at a rate in 1/ps up to the last of them.
fn start(corners: &[(f64, f64)], straight: bool, rate: f64, setting: &Setting) -> Option<Initiation> {
    let setting = Setting {
        strain_rate: rate,
        ..setting.clone()
    };
    let end = corners.last().unwrap().0;
    let mut rows = probes((end / STEP).round() as usize + 1, &setting);
    let modulus = setting.young_modulus / setting.thickness;
    for (number, row) in rows.iter_mut().enumerate() {
        row.strain = STEP * number as f64;
        row.time = row.strain / rate;
        row.sigma_yy = modulus * row.strain;
    }
    let advance = |strain: f64| {
        let after = corners.partition_point(|corner| corner.0 <= strain + 0.1 * STEP);
        let Some(&(from, left)) = after.checked_sub(1).map(|before| &corners[before]) else {
            return 0.0;
        };
        match corners.get(after).filter(|_| straight) {
            Some(&(to, right)) => left + (right - left) * (strain - from) / (to - from),
            None => left,
        }
    };
    let tip = |strain: f64| Tip {
        arc_length: (100.0 + advance(strain)) * SPACING,
        ..Tip::default()
    };
    let tips: Vec<Tip> = rows.iter().map(|row| tip(row.strain)).collect();
    let series = Series {
        probes: rows,
        ..Series::default()
    };
    initiation(&tips, &series, &setting)
}

fn strain(start: Option<Initiation>) -> f64 {
    start.expect("it starts").strain
}

/// An edge of ten atoms opens halfway at half of the load at which the crack leaves it, as the quickstart's does.
const EDGE: [(f64, f64); 9] = [
    (0.014_1, 0.5),
    (0.015_2, 1.5),
    (0.016_6, 2.5),
    (0.017_2, 4.0),
    (0.018_7, 6.5),
    (0.024_5, 7.0),
    (0.024_7, 11.0),
    (0.025_0, 16.0),
    (0.030_0, 26.0),
];

#[test]
fn the_crack_starts_at_the_same_strain_however_fast_it_is_pulled() {
    for rate in [1e-5, 1e-4, 2e-4, 2.5e-4, 3e-4, 1e-3] {
        let start = start(&EDGE, false, rate, &setting());
        assert!((strain(start) - 0.024_5).abs() < EXACT, "{rate} /ps: {start:?}");
        let time = start.unwrap().time;
        assert!((time - 0.024_5 / rate).abs() < EXACT * time, "{rate} /ps: {start:?}");
    }
}

#[test]
fn the_start_does_not_depend_on_the_elements_by_which_a_course_was_computed() {
    // On to where the crack has left the longest edge too.
    let course = [&EDGE[..8], &[(0.026_5, 24.0), (0.028_5, 34.0), (0.030_0, 45.0)]].concat();
    for element_at_crack in [1, 4, 10, 40] {
        let setting = Setting {
            element_at_crack,
            ..setting()
        };
        let found = strain(start(&course, false, 1e-4, &setting));
        assert!(
            (found - 0.024_5).abs() < EXACT,
            "elements of {element_at_crack}: {found}"
        );
    }
}

#[test]
fn a_crack_that_runs_starts_where_it_first_moves() {
    let running = [(0.017_4, 0.0), (0.020_0, 30.0)];
    let found = strain(start(&running, true, 1e-4, &setting()));
    // It moves off between two probes.
    assert!((0.0..=1.001).contains(&((found - 0.017_4) / STEP)), "{found}");
}

#[test]
fn a_creep_of_a_hundredth_of_the_rayleigh_speed_is_no_start_and_the_run_after_it_is() {
    let rate = 1e-4;
    let pace = |share: f64| share * setting().rayleigh_speed / SPACING / rate;
    let creep = [(0.010, 0.0), (0.050, 0.040 * pace(0.01))];
    assert_eq!(start(&creep, true, rate, &setting()), None);
    let crept = 0.035 * pace(0.01);
    let then_runs = [(0.010, 0.0), (0.045, crept), (0.050, crept + 0.005 * pace(0.3))];
    let found = strain(start(&then_runs, true, rate, &setting()));
    // The beginning of a run is told to the growth of the load by which a creep is told.
    assert!((0.8 * 0.045..0.046).contains(&found), "{found}");
}

/// As model D does in elements of four atoms: the bond at the corner breaks at nine tenths of the load.
#[test]
fn the_bond_at_the_very_end_of_the_notch_is_no_start_if_the_next_needs_more_load() {
    for (wait, starts_with_it) in [(1.005, true), (1.04, true), (1.06, false), (1.094, false)] {
        let next = 0.0478 * wait;
        let corner = [
            (0.0478, 0.5),
            (next, 1.0),
            (next + 0.0005, 8.0),
            (next + 0.001, 14.0),
            (next + 0.002, 20.0),
        ];
        let found = strain(start(&corner, false, 1e-5, &setting()));
        let expected = if starts_with_it { 0.0478 } else { next };
        assert!((found - expected).abs() < 2.0 * STEP, "{wait}: {found}");
    }
}

/// As the quickstart's slab does in elements of forty atoms: the edge opens by half and closes again by a little.
#[test]
fn an_edge_of_forty_atoms_that_opens_as_a_hinge_is_no_start() {
    let coarse = Setting {
        element_at_crack: 40,
        ..setting()
    };
    let hinge = [
        (0.013, 5.0),
        (0.0145, 16.5),
        (0.016, 13.0),
        (0.018, 24.5),
        (0.021, 31.0),
        (0.0222, 42.0),
        (0.025, 60.0),
    ];
    let found = strain(start(&hinge, false, 1e-4, &coarse));
    assert!((found - 0.021).abs() < EXACT, "{found}");
    assert_eq!(start(&hinge[..5], false, 1e-4, &coarse), None);
}

#[test]
fn the_constants_of_the_rule_are_those_that_it_tells() {
    let setting = setting();
    // Twelve spacings count, a little less does not.
    for (reached, starts) in [(11.7, false), (12.3, true)] {
        let jump = [(0.010, reached), (0.012, reached)];
        assert_eq!(start(&jump, false, 1e-4, &setting).is_some(), starts, "{reached}");
    }
    // A tenth of the strain is a stand.
    for (share, first) in [(0.098, true), (0.102, false)] {
        let later = ((0.02 / (1.0 - share)) / STEP).round() * STEP;
        let stands = [(0.02, 5.0), (later, 13.0), (later + 0.002, 14.0)];
        let found = strain(start(&stands, false, 1e-4, &setting));
        let wanted = if first { 0.02 } else { later };
        assert!((found - wanted).abs() < EXACT, "{share}: {found}");
    }
    // A fifth more strain is a creep, when it is slow.
    for (growth, starts) in [(0.196, true), (0.204, false)] {
        let slow = [(0.05, 0.0), (0.05 * (1.0 + growth), 12.05)];
        assert_eq!(start(&slow, true, 1e-5, &setting).is_some(), starts, "{growth}");
    }
    // A tenth of the Rayleigh speed is not slow.
    for (share, starts) in [(0.098, false), (0.102, true)] {
        let rate = 1e-3;
        let growth = 12.05 * SPACING * rate / (share * setting.rayleigh_speed);
        let swift = [(0.05, 0.0), (0.05 + growth, 12.05)];
        assert_eq!(start(&swift, true, rate, &setting).is_some(), starts, "{share}");
    }
}

#[test]
fn a_tip_that_comes_back_to_where_it_stood_has_not_left_for_good() {
    // As elements of forty atoms per edge do: ten spacings early, then to and fro.
    let course = [
        (0.014_8, 4.0),
        (0.016_2, 10.0),
        (0.020_8, 13.0),
        (0.021_3, 10.0),
        (0.023_4, 14.0),
        (0.023_7, 10.0),
        (0.025_1, 12.0),
        (0.025_3, 16.0),
        (0.026_0, 24.0),
    ];
    let found = strain(start(&course, false, 1e-4, &setting()));
    assert!((found - 0.025_1).abs() < EXACT, "{found}");
}

#[test]
fn a_specimen_that_collapses_in_compression_has_no_start() {
    let setting = setting();
    let bonds = breaks(&straight(99.0, 160.0), 60);
    let mut pressed = series(100, bonds, &setting);
    assert!(analyse(&pressed, &setting).initiation.is_some());
    for row in &mut pressed.probes {
        row.strain -= 0.15;
        row.sigma_yy = setting.young_modulus / setting.thickness * row.strain;
    }
    assert_eq!(analyse(&pressed, &setting).initiation, None);
}

#[test]
fn initiation_is_the_first_lasting_advance_and_the_first_bond_is_told_beside_it() {
    let mut bonds = breaks(&straight(99.0, 110.0), 20);
    // It heals and stays so until probe 60.
    bonds.extend(
        breaks(&straight(102.0, 110.0), 25)
            .into_iter()
            .map(|event| BondEvent { broken: false, ..event }),
    );
    bonds.extend(breaks(&straight(102.0, 130.0), 60));
    let found = findings(bonds, 100);
    let start = found.initiation.unwrap();
    assert_eq!((start.probe, start.time), (60, 60.0));
    assert!((start.strain - 60.0 * 1e-4).abs() < EXACT);
    let first = found.first_bond.unwrap();
    assert_eq!(first.time, 20.0);
    assert!((first.strain - 20.0 * 1e-4).abs() < EXACT);
}

#[test]
fn a_crack_that_never_starts_has_no_initiation_and_no_speed() {
    let found = findings(breaks(&straight(99.0, 101.0), 20), 100);
    assert_eq!(found.initiation, None);
    assert_eq!(found.peak_speed(), None);
    assert_eq!(found.near_tip, None);
    assert_eq!(found.speed_share, None);
    assert!(found.speeds.iter().all(Option::is_none));
}
