//! The period of the slowest swing of a stress.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Vector3};

/// Only what is above this share of the greatest value counts as a swing.
const SWING: f64 = 0.3;

/// Crossings of zero give the period to better than this share, whatever faster waves ride on it.
const NEAR: f64 = 0.06;

/// Fewer swings than this leave no room for a window, and the crossings stand for themselves.
const FEWEST: f64 = 2.0;

/// How many periods are tried at once, and how often between the neighbours of the best.
const TRIED: i32 = 20;
const ROUNDS: u32 = 4;

/// The period, and how many were seen. Crossings of zero in the same sense tell it nearly; faster waves, which shift crossings,
/// are kept out by a fit of one sine in a Hann window from the first of them on.
pub fn period(time: &[f64], value: &[f64]) -> Option<(f64, f64)> {
    let crossings = crossings(time, value);
    let halves = crossings.len().checked_sub(1).filter(|&halves| halves >= 2)? as f64;
    let mut best = 2.0 * (crossings[crossings.len() - 1] - crossings[0]) / halves;
    let seen = 0.5 * halves;
    if seen < FEWEST {
        return Some((best, seen));
    }
    let from = time.partition_point(|&time| time < crossings[0]);
    let [time, value] = [time, value].map(|all| &all[from..]);
    let mut reach = NEAR;
    for _ in 0..ROUNDS {
        let tried = (-TRIED..=TRIED).map(|step| best * (1.0 + reach * f64::from(step) / f64::from(TRIED)));
        let left = tried.filter_map(|period| Some((misfit(time, value, period)?, period)));
        best = left.min_by(|one, other| one.0.total_cmp(&other.0))?.1;
        reach *= 2.0 / f64::from(TRIED);
    }
    Some((best, seen))
}

/// Where a value goes through zero between swings.
fn crossings(time: &[f64], value: &[f64]) -> Vec<f64> {
    let largest = value.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let mut crossings = Vec::new();
    let (mut sign, mut last) = (0.0, None);
    for probe in 1..value.len() {
        let [before, after] = [value[probe - 1], value[probe]];
        if before * after <= 0.0 && before != after {
            let share = before / (before - after);
            last = Some(time[probe - 1] + share * (time[probe] - time[probe - 1]));
        }
        if after.abs() > SWING * largest && after.signum() != sign {
            if sign != 0.0 {
                crossings.extend(last);
            }
            sign = after.signum();
        }
    }
    crossings
}

/// What a sine of a period and a constant leave of a value: the sum of squares in a Hann window.
fn misfit(time: &[f64], value: &[f64], period: f64) -> Option<f64> {
    let [first, last] = [*time.first()?, *time.last()?];
    let (mut matrix, mut side, mut whole) = (Matrix3::zeros(), Vector3::zeros(), 0.0);
    for (&time, &value) in time.iter().zip(value) {
        let window = (PI * (time - first) / (last - first)).sin().powi(2);
        let angle = TAU * (time - first) / period;
        let terms = Vector3::new(angle.cos(), angle.sin(), 1.0);
        matrix += window * terms * terms.transpose();
        side += window * value * terms;
        whole += window * value * value;
    }
    let found = matrix.lu().solve(&side)?;
    Some(whole - found.dot(&side))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overtones_that_are_slower_than_they_should_be_do_not_move_the_period() {
        // A bar that was struck: odd overtones whose frequencies fall behind, as in a lattice and in a thick bar.
        let time: Vec<f64> = (0..401).map(|probe| 0.25 * f64::from(probe)).collect();
        let swing = |time: f64| {
            let overtone = |number: f64, behind: f64| (TAU * number * (1.0 - behind) * time / 29.0).sin() / number;
            overtone(1.0, 0.0) + overtone(3.0, 0.01) + overtone(5.0, 0.03) + overtone(7.0, 0.06)
        };
        let value: Vec<f64> = time.iter().map(|&time| swing(time)).collect();
        let (found, seen) = period(&time, &value).unwrap();
        assert!((found / 29.0 - 1.0).abs() < 1e-3 && seen >= 2.0, "{found} {seen}");
    }
}
