//! Arrivals picked from the wave gauges.
//!
//! A plane wave that moves along +s with speed c carries sigma = -rho c v in the velocity and the stress on the plane
//! that it moves through, one along -s the opposite. So sigma + rho c v is what moves along -s alone: it stays on its
//! trend while the waves of the starting crack pass the gauge outwards, and has a kink when they come back.

use super::{Face, Wave};
use crate::analysis::initiation::Initiation;
use crate::analysis::regression;
use crate::analysis::series::{Series, Setting};

/// How many times its scatter before the crack starts a kink must be, and how many times any kink before it.
pub const LEAST_SCATTERS: f64 = 4.0;
pub const LEAST_RIVALS: f64 = 2.0;

/// Share of the predicted time by which an arrival may be late. What comes earlier than a kink can be told is something else.
pub const WINDOW: f64 = 0.2;

/// A kink is how far the mean of the probes that follow lies off the line through those before: over these shares of the
/// predicted time, and no fewer probes.
pub const BEFORE_SHARE: f64 = 0.2;
pub const AFTER_SHARE: f64 = 0.05;
const BEFORE_PROBES: usize = 10;
const AFTER_PROBES: usize = 3;

/// Time after the start of the crack at which a wave is back at the tip, ps; `None` where it does not stand out.
pub(super) fn pick(
    wave: Wave,
    face: Face,
    path: f64,
    start: Initiation,
    series: &Series,
    setting: &Setting,
) -> Option<f64> {
    // Behind a crack longer than that, what comes back from the grips aslant is there before.
    if face == Face::Left && path > setting.height {
        return None;
    }
    let speed = wave.speed(setting);
    let predicted = path / speed;
    let (signal, way) = returning(wave, face, series, setting)?;
    let time = |probe: usize| series.probes[probe].time - start.time;
    // When a wave that passes the gauge at this probe is at the tip.
    let arrival = |probe: usize| time(probe) + way / speed;
    let last = signal.len().checked_sub(1)?;
    let interval = (time(last) - time(0)) / last as f64;
    let probes = |share: f64, least: usize| ((share * predicted / interval) as usize).max(least);
    let [before, after] = [probes(BEFORE_SHARE, BEFORE_PROBES), probes(AFTER_SHARE, AFTER_PROBES)];
    let kink = |probe: usize| {
        let points: Vec<(f64, f64)> = (probe - before..probe).map(|k| (time(k), signal[k])).collect();
        let line = regression::line(&points)?;
        let off = (probe..probe + after).map(|k| signal[k] - line.intercept - line.slope * time(k));
        Some(off.sum::<f64>().abs() / after as f64)
    };
    let end = signal.len().checked_sub(after)?;
    let quiet = (before..start.probe.checked_sub(after)?).filter(|&probe| time(probe) >= -predicted);
    let quiet: Vec<f64> = quiet.filter_map(kink).collect();
    if quiet.len() < BEFORE_PROBES {
        return None;
    }
    let scatter = (quiet.iter().map(|kink| kink * kink).sum::<f64>() / quiet.len() as f64).sqrt();
    let heard = (start.probe..end).take_while(|&probe| arrival(probe) <= (1.0 + WINDOW) * predicted);
    let heard: Vec<f64> = heard.map(kink).collect::<Option<_>>()?;
    let largest = (0..heard.len()).max_by(|&a, &b| heard[a].total_cmp(&heard[b]))?;
    let rivals = &heard[..largest.saturating_sub(after)];
    let rival = rivals.iter().copied().fold(0.0, f64::max);
    let measured = arrival(start.probe + largest);
    let stands_out = heard[largest] > LEAST_SCATTERS * scatter && heard[largest] > LEAST_RIVALS * rival;
    (stands_out && measured >= (1.0 - AFTER_SHARE) * predicted).then_some(measured)
}

/// What moves towards the tip past the gauges of a path at every probe, eV/nm^3, and their way to the tip, nm. Both sides
/// of the crack plane are taken together, one mirrored.
fn returning(wave: Wave, face: Face, series: &Series, setting: &Setting) -> Option<(Vec<f64>, f64)> {
    let (first, second) = gauges(face, series, setting)?;
    let density = setting.young_modulus
        / (1.0 - setting.poisson_ratio.powi(2))
        / (setting.longitudinal_speed.powi(2) * setting.thickness);
    let impedance = density * wave.speed(setting);
    // Velocity and stress that the wave carries, and their signs below the crack plane as seen in a mirror.
    let [vx, vy, xx, yy, xy] = [0, 1, 2, 3, 4usize];
    let (velocity, stress, mirrored) = match (wave, face) {
        (Wave::Rayleigh, _) => return None,
        (Wave::Longitudinal, Face::TopAndBottom) => (vy, yy, [-1.0, 1.0]),
        (Wave::Transverse, Face::TopAndBottom) => (vx, xy, [1.0, -1.0]),
        (Wave::Longitudinal, _) => (vx, xx, [1.0, 1.0]),
        (Wave::Transverse, _) => (vy, xy, [-1.0, -1.0]),
    };
    // From the top waves come down, along -y; from the left along +x.
    let sign = if face == Face::TopAndBottom { 1.0 } else { -1.0 };
    let rows = series.gauges.chunks_exact(series.gauge_places.len());
    let signal = rows.map(|row| {
        let [above, below] = [row[first], row[second]];
        let v = 0.5 * (above[velocity] + mirrored[0] * below[velocity]);
        let s = 0.5 * (above[stress] + mirrored[1] * below[stress]);
        s + sign * impedance * v
    });
    let [x, y] = series.gauge_places[first];
    let way = match face {
        Face::TopAndBottom => y,
        Face::Left | Face::Right => setting.crack_length - x,
    };
    Some((signal.collect(), way))
}

/// The gauges above and below the crack plane on the way to a face.
fn gauges(face: Face, series: &Series, setting: &Setting) -> Option<(usize, usize)> {
    let beside = |x: f64| x < setting.crack_length - 0.5 * setting.spacing;
    let find = |above: bool| {
        let mut places = series.gauge_places.iter();
        places.position(|&[x, y]| beside(x) == (face == Face::Left) && (y > 0.0) == above)
    };
    find(true).zip(find(false))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::series::{CrackFrom, Probe};

    /// Copper-like constants to four digits.
    const DIGITS: f64 = 2e-3;

    fn setting() -> Setting {
        Setting {
            spacing: 0.255_585,
            length: 100.0,
            left_x: 0.0,
            height: 40.0,
            crack_row: Some(80),
            crack_from: CrackFrom::Left,
            crack_length: 46.0,
            strain_rate: 1e-4,
            thickness: 0.2087,
            longitudinal_speed: 2.011,
            transverse_speed: 1.161,
            rayleigh_speed: 1.0675,
            young_modulus: 528.18,
            poisson_ratio: 1.0 / 3.0,
            fracture_energy: 3.2475,
            element_at_crack: 1,
            nodes: 1,
            elements: 1,
            represented_atoms: 1,
        }
    }

    /// What a plane wave that moves along +s (`way` 1) or against it carries in velocity `v`: the stress on its plane.
    fn stress(way: f64, speed: f64, v: f64) -> f64 {
        // Atoms of 802 u on a triangular lattice, eV ps^2/nm^5. [CODATA 2018]
        let unit = 1.660_539_066_6e-27 / 1.602_176_634e-19 * 1e6;
        let density = 802.0 * unit / (0.75_f64.sqrt() * 0.255_585_f64.powi(2) * 0.2087);
        -way * density * speed * v
    }

    #[test]
    fn a_gauge_takes_a_wave_that_leaves_for_nothing_and_one_that_returns_twice() {
        let (setting, v) = (setting(), 0.01);
        let above = [setting.crack_length, 10.0];
        let places = vec![above, [above[0], -10.0], [23.0, 2.0], [23.0, -2.0]];
        let waves = [
            (Wave::Longitudinal, Face::TopAndBottom),
            (Wave::Transverse, Face::TopAndBottom),
            (Wave::Longitudinal, Face::Left),
            (Wave::Transverse, Face::Left),
        ];
        for (wave, face) in waves {
            let speed = wave.speed(&setting);
            // Away from the tip is up above it, and to the left behind it.
            let away = if face == Face::TopAndBottom { 1.0 } else { -1.0 };
            let read = |way: f64| {
                let sigma = stress(way, speed, v);
                let mut gauges = [[0.0; 5]; 4];
                let (velocity, component, mirrored) = match (wave, face) {
                    (Wave::Longitudinal, Face::TopAndBottom) => (1, 3, [-1.0, 1.0]),
                    (Wave::Transverse, Face::TopAndBottom) => (0, 4, [1.0, -1.0]),
                    (Wave::Longitudinal, _) => (0, 2, [1.0, 1.0]),
                    _ => (1, 4, [-1.0, -1.0]),
                };
                for (gauge, side) in gauges.iter_mut().zip([[1.0, 1.0], mirrored, [1.0, 1.0], mirrored]) {
                    (gauge[velocity], gauge[component]) = (side[0] * v, side[1] * sigma);
                }
                let series = Series {
                    probes: vec![Probe::default()],
                    gauge_places: places.clone(),
                    gauges: gauges.to_vec(),
                    ..Series::default()
                };
                returning(wave, face, &series, &setting).unwrap().0[0] / sigma.abs()
            };
            assert!(read(away).abs() < DIGITS, "{wave:?} {face:?}: {}", read(away));
            assert!(
                (read(-away).abs() - 2.0).abs() < DIGITS,
                "{wave:?} {face:?}: {}",
                read(-away)
            );
        }
    }
}
