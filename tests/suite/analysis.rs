//! Cracks whose shape and motion are known beforehand.

mod initiation;
mod motion;
mod stress_intensity;
mod waves;

use std::time::{Duration, Instant};

use cgaft::analysis::crack::{self, Tip, Tracker};
use cgaft::analysis::series::{BondEvent, Series, Setting};
use cgaft::analysis::{Findings, analyse, comparison};

use super::synthetic::{SPACING, breaks, kinked, probes, series, setting, straight};

/// 35 ms were measured on two cores with five busy processes; a quadratic method takes minutes.
const LOADED: Duration = Duration::from_millis(250);
/// Rounding only: bond middles are exact in units of the spacing.
const EXACT: f64 = 1e-9;

fn tip_after(bonds: &[[i32; 3]]) -> Tip {
    let setting = setting();
    let mut tracker = Tracker::new(&setting).unwrap();
    breaks(bonds, 1).iter().for_each(|event| tracker.apply(event));
    tracker.tip()
}

fn findings(bonds: Vec<BondEvent>, count: usize) -> Findings {
    let setting = setting();
    analyse(&series(count, bonds, &setting), &setting)
}

#[test]
fn a_straight_crack_is_as_long_as_it_is_far() {
    let tip = tip_after(&straight(99.0, 160.0));
    assert!((tip.x - 160.0 * SPACING).abs() < SPACING, "{tip:?}");
    assert!(tip.y.abs() < EXACT && (tip.arc_length - tip.x).abs() < EXACT, "{tip:?}");
}

#[test]
fn before_anything_breaks_the_tip_is_the_end_of_the_notch() {
    let tip = tip_after(&[]);
    assert!(
        (tip.x - 100.0 * SPACING).abs() < SPACING && tip.y.abs() < EXACT,
        "{tip:?}"
    );
}

#[test]
fn a_kink_of_60_degrees_keeps_its_length() {
    let mut bonds = straight(99.0, 140.0);
    bonds.extend(kinked(140.0, 40));
    let tip = tip_after(&bonds);
    // `kinked` leaves the plane one and a quarter spacings before the end of the straight part.
    let flat = 138.75 * SPACING;
    assert!((tip.x - flat - 20.0 * SPACING).abs() < SPACING, "{tip:?}");
    assert!((tip.y - 40.0 * 0.75_f64.sqrt() * SPACING).abs() < SPACING, "{tip:?}");
    // The yardstick of five spacings cuts the corner once.
    assert!(
        (tip.arc_length - flat - 40.0 * SPACING).abs() < 2.0 * SPACING,
        "{tip:?}"
    );
}

#[test]
fn fragments_away_from_the_notch_do_not_count() {
    let mut bonds = straight(99.0, 120.0);
    let alone = tip_after(&bonds);
    bonds.extend(straight(150.0, 390.0));
    bonds.extend(kinked(300.0, 50));
    assert_eq!(tip_after(&bonds), alone);
}

#[test]
fn a_gap_that_breaks_joins_what_lies_beyond_and_one_that_closes_parts_it() {
    let setting = setting();
    let mut tracker = Tracker::new(&setting).unwrap();
    let apply = |tracker: &mut Tracker, bonds: &[[i32; 3]], broken| {
        breaks(bonds, 1)
            .into_iter()
            .for_each(|event| tracker.apply(&BondEvent { broken, ..event }));
    };
    apply(&mut tracker, &straight(99.0, 120.0), true);
    let near = tracker.tip();
    apply(&mut tracker, &straight(121.0, 200.0), true);
    assert_eq!(tracker.tip(), near);
    let gap = straight(120.0, 121.0);
    apply(&mut tracker, &gap, true);
    let far = tracker.tip();
    assert!((far.x - 200.0 * SPACING).abs() < SPACING, "{far:?}");
    apply(&mut tracker, &gap, false);
    assert_eq!(tracker.tip(), near);
    apply(&mut tracker, &gap, true);
    assert_eq!(tracker.tip(), far);
}

#[test]
fn the_tip_depends_on_what_is_broken_and_not_on_the_order() {
    let mut state = 1_u64;
    let mut random = move |below: u64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % below
    };
    let setting = setting();
    let mut tracker = Tracker::new(&setting).unwrap();
    let mut broken = std::collections::BTreeSet::new();
    for round in 0..4000 {
        let bond = [95 + random(40) as i32, 70 + random(9) as i32, random(3) as i32];
        let event = BondEvent {
            broken: !broken.contains(&bond),
            ..breaks(&[bond], 1)[0]
        };
        if event.broken {
            broken.insert(bond)
        } else {
            broken.remove(&bond)
        };
        tracker.apply(&event);
        if round % 50 == 0 {
            let bonds: Vec<_> = broken.iter().copied().collect();
            assert_eq!(tracker.tip(), tip_after(&bonds), "round {round}");
        }
    }
}

#[test]
fn a_hundred_thousand_broken_bonds_are_followed_in_no_time() {
    let setting = Setting {
        length: 60_000.0 * SPACING,
        ..setting()
    };
    let bonds = breaks(&straight(99.0, 50_099.0), 1);
    let fastest = (0..5).map(|_| {
        let start = Instant::now();
        let mut tracker = Tracker::new(&setting).unwrap();
        bonds.iter().for_each(|event| tracker.apply(event));
        assert!(tracker.tip().x > 50_000.0 * SPACING);
        start.elapsed()
    });
    let fastest = fastest.min().unwrap();
    assert!(fastest < LOADED, "{fastest:?}");
}

/// Runs straight at two spacings a probe from probe 50 on and forks at 150 spacings.
fn forked() -> Vec<BondEvent> {
    let mut bonds: Vec<BondEvent> = straight(99.0, 240.0)
        .chunks(4)
        .zip(50..)
        .flat_map(|(piece, probe)| breaks(piece, probe))
        .collect();
    bonds.extend(
        kinked(150.0, 30)
            .chunks(2)
            .zip(80..)
            .flat_map(|(piece, probe)| breaks(piece, probe)),
    );
    bonds.extend(breaks(&kinked(120.0, 3), 70));
    bonds.sort_by_key(|event| event.probe);
    bonds
}

#[test]
fn a_branch_is_found_with_place_time_and_angle_and_a_spur_is_not() {
    let found = findings(forked(), 160);
    assert_eq!(found.branches.len(), 2, "{:?}", found.branches);
    let [main, branch] = &found.branches[..] else {
        unreachable!()
    };
    assert_eq!((main.parent, branch.parent), (None, Some(0)));
    assert_eq!(branch.probe, 80);
    assert!(
        (branch.x - 150.0 * SPACING).abs() < 2.0 * SPACING && branch.y.abs() < SPACING,
        "{branch:?}"
    );
    // A chord from the middle of the first bond, which lies beside the branch, to its far end.
    assert!((branch.angle - 60.0).abs() < 3.0, "{branch:?}");
    assert!(branch.arrested && main.arrested);
    assert_eq!(found.first_branch(), Some(branch));
}

#[test]
fn a_crack_that_still_runs_at_the_end_is_not_arrested() {
    let found = findings(forked(), 121);
    assert!(!found.branches[0].arrested, "{:?}", found.branches);
}

#[test]
fn a_specimen_without_a_crack_has_no_tip() {
    let setting = Setting {
        crack_row: None,
        ..setting()
    };
    let found = analyse(&series(10, Vec::new(), &setting), &setting);
    assert!(found.tips.is_empty() && found.branches.is_empty() && found.griffith.is_none());
}

#[test]
fn faces_that_touch_behind_the_tip_do_not_end_the_crack() {
    let mut bonds = forked();
    let contact = breaks(&straight(110.0, 111.0), 140)
        .into_iter()
        .map(|event| BondEvent { broken: false, ..event });
    let open = findings(bonds.clone(), 160);
    bonds.extend(contact);
    let touching = findings(bonds, 160);
    assert_eq!(open.tips, touching.tips);
}

#[test]
fn the_speed_of_a_steady_tip_is_its_speed() {
    let bonds = straight(99.0, 240.0)
        .chunks(4)
        .zip(50..)
        .flat_map(|(piece, probe)| breaks(piece, probe))
        .collect();
    let setting = setting();
    let series = series(120, bonds, &setting);
    let found = analyse(&series, &setting);
    let start = found.initiation.unwrap().probe;
    assert!(found.speeds[..start].iter().all(Option::is_none));
    // Two spacings a probe of 1 ps, between initiation and the stop, half a window from both.
    for speed in found.speeds[start..112].iter().flatten() {
        assert!((speed.value / (2.0 * SPACING) - 1.0).abs() < 1e-6, "{speed:?}");
        assert!(speed.error < 1e-6);
    }
    assert!(found.speeds[start..112].iter().all(Option::is_some));
}

#[test]
fn cases_are_compared_with_the_one_of_most_nodes_on_the_same_specimen() {
    let fine = setting();
    let coarse = Setting {
        nodes: 3_000,
        element_at_crack: 10,
        ..setting()
    };
    let other = Setting {
        crack_length: 50.0 * SPACING,
        nodes: 1_000_000,
        ..setting()
    };
    let make = |setting: &Setting, factor: f64, start: u32| {
        let bonds = straight(99.0, 240.0)
            .chunks(4)
            .zip(start..)
            .flat_map(|(p, probe)| breaks(p, probe))
            .collect();
        let mut probes = probes(125, setting);
        probes.iter_mut().for_each(|row| row.sigma_yy *= factor);
        Series {
            probes,
            bonds,
            ..Series::default()
        }
    };
    let data = [
        (make(&coarse, 1.02, 80), &coarse),
        (make(&fine, 1.0, 60), &fine),
        (make(&other, 1.0, 60), &other),
    ];
    let found: Vec<Findings> = data.iter().map(|(series, setting)| analyse(series, setting)).collect();
    let cases: Vec<_> = data
        .iter()
        .zip(&found)
        .map(|((series, setting), findings)| {
            Some(comparison::Candidate {
                series,
                setting,
                findings,
                conditions: "",
            })
        })
        .collect();
    let references = comparison::references(&cases);
    assert_eq!(references, [Some(1), Some(1), None]);
    let earliest = comparison::earliest_initiation(&cases, &references, 1);
    let difference = comparison::difference(cases[0].unwrap(), cases[1].unwrap(), earliest);
    assert!((difference.stress.unwrap() - 0.02).abs() < EXACT, "{difference:?}");
    assert!(difference.initiation_strain.unwrap() > 0.25, "{difference:?}");
    assert!(difference.speed.unwrap() < 0.2, "{difference:?}");
    assert_eq!(crack::spur(&coarse), 20);
}

#[test]
fn a_crack_goes_on_from_the_bonds_it_has_parted_with_its_faces_touching() {
    let setting = setting();
    let closing = |bonds: &[[i32; 3]]| -> Vec<BondEvent> {
        let events = breaks(bonds, 2).into_iter();
        events.map(|event| BondEvent { broken: false, ..event }).collect()
    };
    let mut whole = Tracker::new(&setting).unwrap();
    whole.follow(&breaks(&straight(99.0, 160.0), 1));
    whole.follow(&closing(&straight(110.0, 111.0)));
    let mut resumed = Tracker::new(&setting).unwrap();
    resumed.follow(&whole.parted());
    assert!(
        (resumed.tip().x - 160.0 * SPACING).abs() < SPACING,
        "{:?}",
        resumed.tip()
    );
    for later in [breaks(&straight(160.0, 170.0), 3), closing(&straight(165.0, 170.0))] {
        whole.follow(&later);
        resumed.follow(&later);
        assert_eq!(whole.tip(), resumed.tip());
    }
    assert_eq!(whole.parted(), resumed.parted());
}
