//! What the axes of a line chart span.

use std::ops::Range;

use super::Curve;

/// Share of the x axis that may be empty on the left.
const LATE: f64 = 0.4;

/// Room around measured points, of what they span; and the share of the largest below which the smallest is shown from zero.
const CLOSE_ROOM: f64 = 0.08;
const NEAR_ZERO: f64 = 0.35;

/// What the axes span: the data, zero, and a little more above and below.
pub fn ranges(curves: &[Curve]) -> (Range<f64>, Range<f64>) {
    let points = || {
        curves
            .iter()
            .flat_map(|curve| &curve.points)
            .filter(|point| point.1.is_finite())
    };
    let span = |values: &mut dyn Iterator<Item = f64>| {
        values.fold((0.0_f64, 0.0_f64), |(low, high), value| {
            (low.min(value), high.max(value))
        })
    };
    let (_, right) = span(&mut points().map(|point| point.0));
    // Curves that begin late are shown from where they begin.
    let left = points().map(|point| point.0).fold(right, f64::min);
    let left = if left > LATE * right {
        left - 0.1 * (right - left)
    } else {
        left.min(0.0)
    };
    if curves.iter().all(|curve| curve.dots) {
        return close_ranges(curves);
    }
    let (low, high) = span(&mut points().map(|point| point.1));
    let right = if right > left { right } else { left + 1.0 };
    let room = if high > low { 0.04 * (high - low) } else { 1.0 };
    (left..right, if low < 0.0 { low - room } else { 0.0 }..high + room)
}

/// What the axes span where every point is a measurement: the points with their bars, and some room around them.
fn close_ranges(curves: &[Curve]) -> (Range<f64>, Range<f64>) {
    let ends = |curve: &Curve| {
        let error = |index: usize| curve.spread.get(index).copied().filter(|error| error.is_finite());
        let points = curve.points.iter().enumerate().filter(|(_, point)| point.1.is_finite());
        let end = |(index, point): (usize, &(f64, f64))| {
            let error = error(index).unwrap_or(0.0);
            [(point.0, point.1 - error), (point.0, point.1 + error)]
        };
        points.flat_map(end).collect::<Vec<_>>()
    };
    let ends: Vec<(f64, f64)> = curves.iter().flat_map(ends).collect();
    let span = |of: fn(&(f64, f64)) -> f64| {
        let low = ends.iter().map(of).fold(f64::INFINITY, f64::min);
        let high = ends.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        let room = CLOSE_ROOM * if high > low { high - low } else { high.abs().max(1.0) };
        // From zero where that is near anyway.
        let low = if low > 0.0 && low < NEAR_ZERO * high {
            0.0
        } else {
            low - room
        };
        low..high + room
    };
    (span(|end| end.0), span(|end| end.1))
}
