//! Speeds, joins, the way off the plane and damage elsewhere, of cracks that do what they are told.

use cgaft::analysis::crack::{Tracker, branches, spur};
use cgaft::analysis::series::{BondEvent, Setting};
use cgaft::analysis::{analyse, path};

use super::{EXACT, findings};
use crate::suite::synthetic::{SPACING, breaks, kinked, series, setting, straight};

/// Rounding of a slope.
const ROUNDING: f64 = 1e-6;

/// From a place to another, spacings, at two spacings a probe of 1 ps from a probe on.
fn running(from: f64, to: f64, probe: u32) -> Vec<BondEvent> {
    let pieces = straight(from, to);
    let pieces = pieces.chunks(4).zip(probe..);
    pieces.flat_map(|(piece, probe)| breaks(piece, probe)).collect()
}

fn in_time(mut bonds: Vec<BondEvent>) -> Vec<BondEvent> {
    bonds.sort_by_key(|event| event.probe);
    bonds
}

/// Runs to 159 spacings, joins there what has opened from 170 to 200, and runs on.
fn joining() -> Vec<BondEvent> {
    let mut bonds = running(99.0, 159.0, 50);
    bonds.extend(breaks(&straight(170.0, 200.0), 20));
    bonds.extend(breaks(&straight(159.0, 170.0), 80));
    bonds.extend(running(200.0, 260.0, 81));
    in_time(bonds)
}

#[test]
fn a_crack_that_joins_one_ahead_tells_time_places_and_gap() {
    let found = findings(joining(), 140);
    assert_eq!(found.joins.len(), 1, "{:?}", found.joins);
    let join = found.joins[0];
    assert_eq!((join.probe, join.time), (80, 80.0));
    assert!((join.strain - 80.0 * 1e-4).abs() < EXACT);
    assert!((join.from.x - 159.0 * SPACING).abs() < SPACING, "{join:?}");
    assert!((join.to.x - 200.0 * SPACING).abs() < SPACING, "{join:?}");
    assert!((join.gap - 11.0 * SPACING).abs() <= SPACING, "{join:?}");
    assert_eq!(found.first_branch(), None);
}

#[test]
fn a_crack_that_runs_fast_through_sound_bonds_joins_nothing() {
    let found = findings(running(99.0, 260.0, 50), 140);
    assert!(found.joins.is_empty(), "{:?}", found.joins);
}

#[test]
fn what_a_join_leaves_of_the_old_tip_is_no_branch() {
    let mut bonds = running(99.0, 150.0, 50);
    // The old tip turns aside; then a crack ahead is joined from behind the turn.
    bonds.extend(breaks(&kinked(151.0, 30), 80));
    bonds.extend(breaks(&straight(190.0, 330.0), 40));
    bonds.extend(breaks(&straight(150.0, 190.0), 110));
    let bonds = in_time(bonds);
    let found = findings(bonds.clone(), 160);
    assert_eq!(found.joins.len(), 1, "{:?}", found.joins);
    assert!(
        found.branches.iter().any(|branch| branch.joined),
        "{:?}",
        found.branches
    );
    assert_eq!(found.first_branch(), None, "{:?}", found.branches);

    // A run that goes on from a checkpoint knows it too.
    let setting = setting();
    let mut tracker = Tracker::new(&setting).unwrap();
    tracker.follow(&bonds);
    let mut resumed = Tracker::new(&setting).unwrap();
    resumed.follow(&tracker.parted());
    let arms = branches::arms(&resumed, spur(&setting));
    assert_eq!(arms, branches::arms(&tracker, spur(&setting)));
    assert!(arms.iter().any(|arm| arm.is_branch(&[])) && !arms.iter().any(|arm| arm.is_branch(&[110])));
}

#[test]
fn windows_are_cut_at_a_jump_and_the_speed_on_both_sides_is_that_of_the_tip() {
    let found = findings(joining(), 140);
    let start = found.initiation.unwrap().probe;
    // It stands from probe 110 on, half a window later.
    let speeds = &found.speeds[start..=103];
    for (probe, speed) in (start..).zip(speeds) {
        let speed = speed.unwrap_or_else(|| panic!("none at {probe}"));
        assert!(
            (speed.value / (2.0 * SPACING) - 1.0).abs() < ROUNDING,
            "{probe}: {speed:?}"
        );
    }
    assert_eq!(found.speed_share, Some(1.0));
    assert!((found.peak_speed().unwrap() / (2.0 * SPACING) - 1.0).abs() < ROUNDING);
}

#[test]
fn the_window_of_a_speed_is_the_time_in_which_a_slow_crack_makes_six_advances() {
    // One spacing a probe up to probe 100, then two. Six times three spacings at 0.3 c_R take 15.9 ps, so a window reaches
    // seven probes to either side, and one that is longer by a hundredth would reach eight.
    let setting = Setting {
        rayleigh_speed: 18.0 * SPACING / (0.3 * 15.9),
        ..setting()
    };
    let slow = straight(99.0, 150.0);
    let slow = slow.chunks(2).zip(50..).flat_map(|(piece, probe)| breaks(piece, probe));
    let bonds = slow.chain(running(150.0, 290.0, 101)).collect();
    let found = analyse(&series(180, bonds, &setting), &setting);
    let is_faster = |speed: f64| speed > (1.0 + ROUNDING) * SPACING;
    let faster = found
        .speeds
        .iter()
        .position(|speed| speed.is_some_and(|speed| is_faster(speed.value)));
    assert_eq!(faster, Some(101 - 7));
}

#[test]
fn the_share_of_the_motion_that_has_a_speed_is_told() {
    // Two jumps three probes apart: what is between them is too short for a speed.
    let mut bonds = running(99.0, 159.0, 50);
    bonds.extend(breaks(&straight(159.0, 200.0), 80));
    bonds.extend(running(200.0, 204.0, 81));
    bonds.extend(breaks(&straight(204.0, 250.0), 83));
    bonds.extend(running(250.0, 290.0, 84));
    let found = findings(in_time(bonds), 140);
    let start = found.initiation.unwrap().probe;
    let missing: Vec<usize> = (start..=103).filter(|&probe| found.speeds[probe].is_none()).collect();
    assert_eq!(missing, [80, 81, 82]);
    let moving = (103 - start + 1) as f64;
    assert!((found.speed_share.unwrap() - (moving - 3.0) / moving).abs() < EXACT);
}

#[test]
fn a_tip_that_moves_back_has_no_speed() {
    let mut bonds = running(99.0, 160.0, 50);
    let back = straight(120.0, 160.0);
    let closing = back.chunks(2).rev().zip(90..);
    bonds.extend(closing.flat_map(|(piece, probe)| {
        let events = breaks(piece, probe).into_iter();
        events
            .map(|event| BondEvent { broken: false, ..event })
            .collect::<Vec<_>>()
    }));
    let found = findings(in_time(bonds), 160);
    assert!(found.tips[140].x < 125.0 * SPACING, "it closed");
    assert!(found.speeds.iter().flatten().all(|speed| speed.value >= 0.0));
    assert!(found.speeds[105].is_none());
}

#[test]
fn the_path_off_the_plane_is_told_with_its_first_bond() {
    let mut bonds = running(99.0, 140.0, 50);
    let rows = kinked(140.0, 40);
    bonds.extend(rows.chunks(2).zip(100..).flat_map(|(row, probe)| breaks(row, probe)));
    let found = findings(in_time(bonds), 160);
    let left = found.leaves_plane.unwrap();
    assert_eq!(left.first_off_time, 100.0);
    // Eight spacings are between the ninth and the tenth row; a row opens a probe.
    assert_eq!((left.probe, left.time), (109, 109.0), "{left:?}");
    assert!((left.strain - 109.0 * 1e-4).abs() < EXACT);
    assert!((8.0..8.9).contains(&(left.y / SPACING)), "{left:?}");
    let slope = (left.y / 60_f64.to_radians().tan() + 138.75 * SPACING - left.x).abs();
    assert!(slope < SPACING, "{left:?}");
}

#[test]
fn a_crack_that_keeps_to_its_plane_and_fragments_off_it_do_not_leave_it() {
    let mut bonds = running(99.0, 240.0, 50);
    bonds.extend(breaks(&kinked(300.0, 40), 60));
    assert_eq!(findings(in_time(bonds), 140).leaves_plane, None);
}

#[test]
fn a_crack_whose_damage_goes_on_ahead_has_not_come_to_rest() {
    let mut bonds = running(99.0, 160.0, 50);
    bonds.extend(running(165.0, 245.0, 81));
    let found = findings(in_time(bonds.clone()), 124);
    assert!(found.tips[123].x < 165.0 * SPACING, "the pieces do not touch");
    assert!(!found.branches[0].arrested);
    assert!(findings(in_time(bonds), 180).branches[0].arrested, "then all rests");
}

#[test]
fn a_specimen_that_parts_at_a_grip_is_told_and_scattered_damage_is_not() {
    // Stretches of four spacings; a row 43 spacings above the plane, of which every fourth bond breaks.
    let row = |share: f64| -> Vec<[i32; 3]> {
        let bonds = straight(0.0, 400.0 * share);
        let lifted = bonds.iter().step_by(4);
        lifted
            .map(|&[column, row, direction]| [column - 25, row + 50, direction])
            .collect()
    };
    let parted = findings(breaks(&row(0.83), 30), 60).parted_elsewhere.unwrap();
    assert_eq!(parted.time, 30.0);
    assert!(
        (parted.y - 50.0 * 0.75_f64.sqrt() * SPACING).abs() < SPACING,
        "{parted:?}"
    );
    assert_eq!(findings(breaks(&row(0.77), 30), 60).parted_elsewhere, None);
    let found = findings(running(99.0, 390.0, 50), 240);
    assert_eq!(found.parted_elsewhere, None, "the crack itself");
    let setting = setting();
    let mut pressed = series(60, breaks(&row(0.83), 30), &setting);
    pressed.probes.iter_mut().for_each(|probe| probe.strain *= -1.0);
    let found = analyse(&pressed, &setting);
    assert_eq!(found.parted_elsewhere, None, "under compression it folds");
}

#[test]
fn every_broken_bond_is_listed_once_with_its_place_and_time() {
    let setting = setting();
    let mut bonds = breaks(&straight(99.0, 103.0), 20);
    let closing = breaks(&straight(102.0, 103.0), 25).into_iter();
    bonds.extend(closing.map(|event| BondEvent { broken: false, ..event }));
    bonds.extend(breaks(&kinked(150.0, 1), 30));
    let listed = path::broken_bonds(&series(50, bonds.clone(), &setting), &setting);
    let beyond: Vec<_> = listed.iter().filter(|bond| bond.time == 20.0).collect();
    assert!(
        beyond
            .iter()
            .all(|bond| bond.y.abs() < EXACT && [60.0, 120.0].contains(&bond.direction))
    );
    assert_eq!(listed.iter().filter(|bond| bond.closed).count(), 2);
    let off: Vec<_> = listed.iter().filter(|bond| bond.time == 30.0).collect();
    assert_eq!(off.len(), 2);
    assert!(
        (off[0].y - 0.5 * 0.75_f64.sqrt() * SPACING).abs() < EXACT && off[0].direction == 0.0,
        "{off:?}"
    );
    assert!((off[0].strain - 30.0 * 1e-4).abs() < EXACT);
    let found = analyse(&series(50, bonds, &setting), &setting);
    assert!((beyond[0].x - found.tips[0].x).abs() < SPACING);
}
