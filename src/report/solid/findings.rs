//! What the series of a solid says: greatest stress, first broken bond, modulus, period.

use super::Solid;
use super::period::period;
use super::series::{Gauge, Series, component};
use crate::analysis::passage;

/// Times in ps, stresses in eV/nm^3. `None` where it did not happen or cannot be told.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings {
    /// Greatest mean stress in the direction of the pull, whatever its sign.
    pub peak: Option<Moment>,
    /// When bonds are first seen to be others than at the start: broken, or made where something is pressed together.
    pub first_break: Option<Moment>,
    /// Bonds lost at the end, less those made.
    pub broken: Option<f64>,
    /// Slope of the stress over the strain before anything breaks, least squares.
    pub modulus: Option<f64>,
    /// Young's modulus of the solid at rest under its load, as a bar.
    pub modulus_at_rest: Option<f64>,
    /// Of the stress about zero, and how many periods were seen.
    pub period: Option<(f64, f64)>,
    /// Highest temperature of the atoms, K.
    pub temperature: Option<f64>,
    /// Where its gauges stand, nm, by rising place, and when a pulse passed each, ps; none where no speed is expected.
    pub passages: Vec<(f64, Option<f64>)>,
    /// From the first of these to the last, nm/ps.
    pub wave_speed: Option<f64>,
}

/// A probe and the stress in the direction of the pull there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    pub probe: usize,
    pub time: f64,
    pub strain: Option<f64>,
    pub stress: f64,
}

/// Fewer points than this make no line.
const FEWEST_POINTS: usize = 5;

/// The modulus is that of strains up to this, if nothing breaks before.
const SMALL_STRAIN: f64 = 0.01;

impl Findings {
    pub fn of(solid: &Solid) -> Self {
        let Some(series) = &solid.series else {
            return Self::default();
        };
        let pull = series.pull(solid.specimen.direction);
        let moment = |probe: usize| Moment {
            probe,
            time: series.time[probe],
            strain: series.is_driven.then(|| series.strain[probe]),
            stress: pull[probe],
        };
        let largest = (0..pull.len()).max_by(|&a, &b| pull[a].abs().total_cmp(&pull[b].abs()));
        let at_start = series.broken.first().copied();
        let breaks = at_start.and_then(|start| series.broken.iter().position(|&broken| broken != start));
        let hottest = series.temperature.iter().copied().filter(|kelvin| kelvin.is_finite());
        let passages = passages(solid, series);
        let passed: Vec<(f64, f64)> = passages.iter().filter_map(|&(at, time)| Some((at, time?))).collect();
        Self {
            wave_speed: passed
                .first()
                .zip(passed.last())
                .and_then(|(&from, &to)| passage::speed([from, to])),
            passages,
            peak: largest.map(moment),
            first_break: breaks.map(moment),
            broken: series.broken.last().zip(at_start).map(|(end, start)| end - start),
            modulus: modulus(series, &pull, breaks),
            modulus_at_rest: modulus_at_rest(solid, series),
            period: period(&series.time, &pull),
            temperature: hottest.max_by(f64::total_cmp),
        }
    }
}

/// When a pulse whose speed is known from the crystal passed the gauges.
fn passages(solid: &Solid, series: &Series) -> Vec<(f64, Option<f64>)> {
    if solid.specimen.wave_speed.is_none() {
        return Vec::new();
    }
    let signal = |gauge: &Gauge| -> Vec<f64> {
        let velocities = gauge.velocity.iter();
        velocities
            .map(|velocity| component(velocity, solid.specimen.direction))
            .collect()
    };
    let gauges = series.gauges.iter();
    let mut passages: Vec<_> = gauges
        .map(|gauge| (gauge.at, passage::passage(&series.time, &signal(gauge))))
        .collect();
    passages.sort_by(|one, other| one.0.total_cmp(&other.0));
    passages
}

fn modulus(series: &Series, pull: &[f64], breaks: Option<usize>) -> Option<f64> {
    if !series.is_driven {
        return None;
    }
    let whole = breaks.unwrap_or(pull.len());
    let points = series.strain.iter().zip(pull).take(whole);
    let points: Vec<_> = points.filter(|(strain, _)| **strain <= SMALL_STRAIN).collect();
    if points.len() < FEWEST_POINTS {
        return None;
    }
    let count = points.len() as f64;
    let mean = points.iter().map(|point| point.0).sum::<f64>() / count;
    let level = points.iter().map(|point| point.1).sum::<f64>() / count;
    let both: f64 = points.iter().map(|point| (point.0 - mean) * (point.1 - level)).sum();
    let spread: f64 = points.iter().map(|point| (point.0 - mean).powi(2)).sum();
    (spread > 0.0).then(|| both / spread)
}

/// Force over cross-section and strain at the start, where the solid has come to rest under its load.
fn modulus_at_rest(solid: &Solid, series: &Series) -> Option<f64> {
    let bar = solid.specimen.bar.filter(|_| solid.specimen.is_relaxed)?;
    let force = series.force.first()?;
    let along: f64 = force.iter().zip(bar.along).map(|(force, along)| force * along).sum();
    let modulus = along / bar.cross_section / series.strain.first()?;
    (modulus.is_finite() && modulus > 0.0).then_some(modulus)
}

/// How far a curve is from another over the time that both have: root of the mean square over the greatest value.
pub fn distance(series: &Series, pull: &[f64], reference: &Series, expected: &[f64]) -> Option<f64> {
    let largest = expected.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let mut sum = 0.0;
    let mut count = 0.0;
    for (&time, &value) in series.time.iter().zip(pull) {
        let after = reference.time.partition_point(|&other| other < time);
        if after == reference.time.len() {
            break;
        }
        let at = match after {
            0 => expected[0],
            _ => {
                let [from, to] = [reference.time[after - 1], reference.time[after]];
                let share = (time - from) / (to - from);
                expected[after - 1] + share * (expected[after] - expected[after - 1])
            }
        };
        sum += (value - at).powi(2);
        count += 1.0;
    }
    (count > 1.0 && largest > 0.0).then(|| (sum / count).sqrt() / largest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::solid::Specimen;

    fn pulled(strain: impl Fn(f64) -> f64, stress: impl Fn(f64) -> f64, broken: impl Fn(f64) -> f64) -> Solid {
        let time: Vec<f64> = (0..401).map(|probe| 0.25 * f64::from(probe)).collect();
        let of = |value: &dyn Fn(f64) -> f64| time.iter().map(|&time| value(time)).collect::<Vec<f64>>();
        Solid {
            specimen: Specimen {
                direction: [0.0, 1.0, 0.0],
                ..Specimen::default()
            },
            series: Some(Series {
                is_driven: strain(1.0).is_finite(),
                strain: of(&strain),
                stress: time
                    .iter()
                    .map(|&time| [9.0, stress(time), 0.0, 0.0, 0.0, 0.0])
                    .collect(),
                broken: of(&broken),
                temperature: vec![f64::NAN; time.len()],
                time: time.clone(),
                ..Series::default()
            }),
            ..Solid::default()
        }
    }

    #[test]
    fn a_pulled_solid_tells_modulus_peak_and_first_break() {
        let strain = |time: f64| 2e-4 * time;
        let stress = |time: f64| if time <= 60.0 { 400.0 * strain(time) } else { 0.5 };
        let found = Findings::of(&pulled(strain, stress, |time| if time > 61.0 { 40.0 } else { 7.0 }));
        assert!((found.modulus.unwrap() / 400.0 - 1.0).abs() < 1e-9);
        let peak = found.peak.unwrap();
        assert_eq!((peak.time, peak.strain), (60.0, Some(strain(60.0))));
        assert_eq!(found.first_break.unwrap().time, 61.25);
        assert_eq!((found.broken, found.temperature), (Some(33.0), None));
    }

    #[test]
    fn a_bar_at_rest_tells_its_modulus_and_with_it_the_period_of_a_thin_one() {
        use crate::report::solid::specimen::Bar;
        let mut solid = pulled(|_| 2e-3, |_| 0.0, |_| 0.0);
        solid.specimen.is_relaxed = true;
        let bar = Bar {
            along: [0.0, 0.0, 1.0],
            length: 50.0,
            cross_section: 4.0,
            density: 8.0,
            young_modulus: 500.0,
        };
        solid.specimen.bar = Some(bar);
        let series = solid.series.as_mut().unwrap();
        series.force = vec![[9.0, 9.0, 4.0]; series.time.len()];
        let modulus = Findings::of(&solid).modulus_at_rest.unwrap();
        assert!((modulus - 500.0).abs() < 1e-9);
        assert!((bar.period(modulus) - 4.0 * 50.0 * (8.0f64 / 500.0).sqrt()).abs() < 1e-9);
        solid.specimen.is_relaxed = false;
        assert_eq!(Findings::of(&solid).modulus_at_rest, None);
    }

    #[test]
    fn a_struck_solid_tells_its_period_whatever_small_waves_ride_on_it() {
        let swing = |time: f64| (time / 25.0 * std::f64::consts::TAU).sin() + 0.05 * (3.7 * time).sin();
        let solid = pulled(|_| f64::NAN, swing, |_| 0.0);
        let found = Findings::of(&solid);
        let (period, seen) = found.period.unwrap();
        assert!((period / 25.0 - 1.0).abs() < 1e-3 && seen >= 3.0, "{period} {seen}");
        assert_eq!((found.modulus, found.first_break), (None, None));
    }

    #[test]
    fn a_curve_is_as_far_from_another_as_it_is_on_average() {
        let of = |offset: f64| pulled(|time| 1e-4 * time, move |time| 0.02 * time + offset, |_| 0.0);
        let [one, other] = [of(0.0), of(0.1)];
        let [a, b] = [&one, &other].map(|solid| solid.series.as_ref().unwrap());
        let [pull, expected] = [a, b].map(|series| series.pull([0.0, 1.0, 0.0]));
        let found = distance(a, &pull, b, &expected).unwrap();
        assert!((found - 0.1 / 2.1).abs() < 1e-9, "{found}");
    }
}
