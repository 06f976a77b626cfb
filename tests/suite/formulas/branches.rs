//! Directions and rest of cracks that run and stop as they are told.

use cgaft::analysis::analyse;
use cgaft::analysis::series::{Series, Setting};

use crate::suite::synthetic::{SPACING, breaks, kinked, series, setting, straight};

/// The chord of a branch is 80 spacings long and may begin half a spacing beside it, degrees.
const BESIDE: f64 = 0.5;

#[test]
fn a_long_branch_has_the_direction_in_which_it_runs() {
    // Twice the spur, twenty spacings of an element here, is looked at: four element edges.
    let setting = Setting {
        element_at_crack: 20,
        ..setting()
    };
    let mut bonds = breaks(&straight(99.0, 350.0), 50);
    bonds.extend(breaks(&kinked(200.0, 120), 60));
    let found = analyse(&series(100, bonds, &setting), &setting);
    let branch = found.first_branch().expect("it forks");
    assert!((branch.angle - 60.0).abs() < BESIDE, "{branch:?}");
}

#[test]
fn a_crack_is_at_rest_when_it_has_not_grown_for_the_time_in_which_a_slow_one_makes_a_spur() {
    // A spur is five spacings; slow is a tenth of the Rayleigh speed. Probes come every 0.25 ps.
    let patience = 12.1;
    let setting = Setting {
        rayleigh_speed: 5.0 * SPACING / (0.1 * patience),
        ..setting()
    };
    let stood = |probes: u32| {
        let bonds = straight(99.0, 160.0);
        let events = bonds.chunks(2).zip(1..).flat_map(|(piece, probe)| breaks(piece, probe));
        let events: Vec<_> = events.collect();
        let last = events.last().expect("it runs").probe;
        let mut series: Series = series((last + probes + 1) as usize, events, &setting);
        series.probes.iter_mut().for_each(|row| row.time *= 0.25);
        analyse(&series, &setting).branches[0].arrested
    };
    assert_eq!([48, 49].map(stood), [false, true]);
}
