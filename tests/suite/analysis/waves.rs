//! Waves that come back to the tip when they must.

use cgaft::analysis::analyse;
use cgaft::analysis::series::{Series, Setting};
use cgaft::analysis::waves::{Arrival, Face, Wave};

use super::{EXACT, findings};
use crate::suite::synthetic::{SPACING, breaks, series, setting, straight};

#[test]
fn waves_come_back_after_their_path_over_their_speed() {
    let setting = setting();
    let found = findings(Vec::new(), 10);
    let first = found.arrivals[0];
    assert!((first.predicted - 2.0 * found.tips[0].x / setting.longitudinal_speed).abs() < EXACT);
    assert!((found.arrivals[3].predicted - setting.height / setting.longitudinal_speed).abs() < EXACT);
    assert!(found.arrivals.iter().all(|arrival| arrival.measured.is_none()));
}

/// Probe at which the crack of [`waves`] starts.
const START: u32 = 120;

/// A crack that starts at [`START`], and gauges 12 nm above and below its tip under a rising load. From the start on they
/// feel a longitudinal wave that leaves the tip, then what the grips send back of it, then `later`.
fn waves(setting: &Setting, later: impl Fn(f64) -> f64) -> Series {
    let bonds = straight(99.0, 240.0)
        .chunks(4)
        .zip(START..)
        .flat_map(|(piece, probe)| breaks(piece, probe))
        .collect();
    let mut series = series(200, bonds, setting);
    let tip = setting.crack_length;
    let (height, speed) = (12.0, setting.longitudinal_speed);
    series.gauge_places = vec![[tip, height], [tip, -height], [0.5 * tip, 2.0], [0.5 * tip, -2.0]];
    let c11 = setting.young_modulus / (1.0 - setting.poisson_ratio.powi(2));
    let impedance = c11 / (setting.thickness * speed);
    // What a wave unloads, growing from its front on, eV/nm^3.
    let unloaded = |since: f64| 0.3 * since.clamp(0.0, 8.0);
    let rows = series.probes.iter().enumerate().flat_map(|(number, row)| {
        let time = number as f64 - f64::from(START);
        let out = unloaded(time - height / speed);
        let back = unloaded(time - (setting.height - height) / speed);
        let ripple = 0.02 * (2.1 * number as f64).sin();
        let stress = row.sigma_yy - out - back + later(time) + ripple;
        let velocity = row.strain + (out - back) / impedance;
        let above = [0.0, velocity, 0.3 * stress, stress, 0.0];
        let below = [0.0, -velocity, 0.3 * stress, stress, 0.0];
        [above, below, [0.0; 5], [0.0; 5]]
    });
    series.gauges = rows.collect();
    series
}

#[test]
fn a_wave_that_comes_back_is_told_from_the_one_that_leaves() {
    let setting = setting();
    let arrivals = analyse(&waves(&setting, |_| 0.0), &setting).arrivals;
    for arrival in arrivals {
        let expected = arrival.wave == Wave::Longitudinal && arrival.face == Face::TopAndBottom;
        assert_eq!(arrival.measured.is_some(), expected, "{arrival:?}");
        if let Some(measured) = arrival.measured {
            // The front takes 8 ps to rise, and is seen before half of that; probes are 1 ps apart.
            assert!((-1.0..4.0).contains(&(measured - arrival.predicted)), "{arrival:?}");
        }
    }
}

#[test]
fn what_comes_faster_than_any_wave_is_not_taken_for_one() {
    let setting = setting();
    let way_back = (setting.height - 12.0) / setting.longitudinal_speed;
    let share_of_prediction = 0.88;
    let early = way_back - (1.0 - share_of_prediction) * setting.height / setting.longitudinal_speed;
    let disturbed = waves(&setting, |time| if time > early { 4.0 } else { 0.0 });
    let arrivals = analyse(&disturbed, &setting).arrivals;
    assert!(
        arrivals.iter().all(|arrival| arrival.measured.is_none()),
        "{arrivals:?}"
    );
}

#[test]
fn a_wave_behind_something_else_is_absent() {
    let setting = setting();
    let disturbed = waves(&setting, |time| if time > 4.0 { 4.0 } else { 0.0 });
    let arrivals = analyse(&disturbed, &setting).arrivals;
    assert!(
        arrivals.iter().all(|arrival| arrival.measured.is_none()),
        "{arrivals:?}"
    );
}

#[test]
fn a_wave_from_the_left_needs_longer_to_a_tip_that_runs_on() {
    let setting = setting();
    let findings = analyse(&waves(&setting, |_| 0.0), &setting);
    let left = |arrival: &&Arrival| (arrival.wave, arrival.face) == (Wave::Longitudinal, Face::Left);
    let arrival = findings.arrivals.iter().find(left).unwrap();
    let met = arrival.at_running_tip.unwrap();
    let start = findings.initiation.unwrap();
    // The wave runs at c from the notch to the left edge and on after the tip, which runs at two spacings a ps: the way from
    // the notch to the tip at the start is behind it already.
    let way = findings.tips[0].x + findings.tips[start.probe].x;
    let expected = way / (setting.longitudinal_speed - 2.0 * SPACING);
    assert!((met / expected - 1.0).abs() < EXACT, "{met} instead of {expected}");
    assert!(met > arrival.predicted);
}

#[test]
fn a_wave_from_the_grips_meets_the_running_tip_aslant() {
    let setting = setting();
    let findings = analyse(&waves(&setting, |_| 0.0), &setting);
    let from_grips = |arrival: &&Arrival| (arrival.wave, arrival.face) == (Wave::Transverse, Face::TopAndBottom);
    let met = findings
        .arrivals
        .iter()
        .find(from_grips)
        .unwrap()
        .at_running_tip
        .unwrap();
    // (c t)^2 = H^2 + (d + v t)^2 with the tip at d at the start; the tip is told between probes 1 ps apart.
    const BETWEEN_PROBES: f64 = 2e-3;
    let [c, v, h] = [setting.transverse_speed, 2.0 * SPACING, setting.height];
    let d = findings.tips[findings.initiation.unwrap().probe].x - findings.tips[0].x;
    let expected = (d * v + (d * d * v * v + (c * c - v * v) * (h * h + d * d)).sqrt()) / (c * c - v * v);
    assert!(
        (met / expected - 1.0).abs() < BETWEEN_PROBES,
        "{met} instead of {expected}"
    );
}

#[test]
fn waves_of_one_path_come_in_the_order_of_their_speeds_or_not_at_all() {
    let setting = setting();
    let findings = analyse(&waves(&setting, |_| 0.0), &setting);
    let order = [Wave::Longitudinal, Wave::Transverse, Wave::Rayleigh];
    for face in [Face::Left, Face::TopAndBottom] {
        let times = order.map(|wave| {
            let mut arrivals = findings.arrivals.iter();
            arrivals
                .find(|arrival| (arrival.wave, arrival.face) == (wave, face))?
                .at_running_tip
        });
        // What does not come before the end of the run is later than all that does.
        let times = times.map(|time| time.unwrap_or(f64::INFINITY));
        assert!(times.is_sorted(), "{face:?}: {times:?}");
    }
}
