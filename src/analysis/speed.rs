//! Crack speed: the slope of arc length over time.

use super::crack::Tip;
use super::initiation::{self, Initiation};
use super::regression;
use super::series::{Series, Setting};

/// The window is the time in which a crack at [`WINDOW_SPEED`] (a share of the Rayleigh speed) runs this many times
/// the advance by which initiation is told, so that it spans several elements where the mesh is coarse.
pub const WINDOW_ADVANCES: f64 = 6.0;
pub const WINDOW_SPEED: f64 = 0.3;

/// Fewer probes than this in a window give no slope worth the name.
pub const WINDOW_PROBES: usize = 5;

/// A tip that gets ahead faster than longitudinal waves, by more than this many edges of the elements there, has joined a
/// crack that opened ahead of it: there is no speed across such a jump.
pub const JUMP_EDGES: f64 = 2.0;

/// Slope of the arc length in a window around a probe, with its standard error, nm/ps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    pub value: f64,
    pub error: f64,
}

/// Width of the window, ps; widened where probes are sparse. `None` with fewer than two probes.
pub fn window(series: &Series, setting: &Setting) -> Option<f64> {
    let (first, last) = series.probes.first().zip(series.probes.last())?;
    let intervals = series.probes.len().checked_sub(1).filter(|&count| count > 0)?;
    let between = (last.time - first.time) / intervals as f64;
    let wanted = WINDOW_ADVANCES * initiation::threshold(setting) / (WINDOW_SPEED * setting.rayleigh_speed);
    Some(wanted.max((WINDOW_PROBES - 1) as f64 * between))
}

/// A piece of a window that a jump cuts off must be this share of it long: less gives no slope worth the name either.
pub const LEAST_PIECE: f64 = 0.25;

/// One a probe, from initiation on. At both ends of the motion, and where the tip jumps or joins a crack ahead of it
/// (`joined`: the probes at which it does), the window is cut off. None where the crack has not run for half a window, where
/// the piece of the window is too short, and while the tip is moving back: that is no speed.
pub fn speeds(
    tips: &[Tip],
    series: &Series,
    initiation: Option<Initiation>,
    window: Option<f64>,
    joined: &[usize],
    setting: &Setting,
) -> Vec<Option<Speed>> {
    let mut speeds = vec![None; tips.len()];
    let Some((start, width)) = initiation.zip(window) else {
        return speeds;
    };
    let points: Vec<(f64, f64)> = series
        .probes
        .iter()
        .zip(tips)
        .map(|(row, tip)| (row.time, tip.arc_length))
        .collect();
    // Half a part in a million wider, so that rounding does not decide which probes are in.
    let half = 0.5 * width * (1.0 + 1e-6);
    if points[points.len() - 1].0 - points[start.probe].0 < 0.5 * width {
        return speeds;
    }
    // The first probes of the pieces between jumps.
    let edge = f64::from(setting.element_at_crack) * setting.spacing;
    let is_jump = |probe: usize| {
        let (before, after) = (points[probe - 1], points[probe]);
        let farthest = setting.longitudinal_speed * (after.0 - before.0) + JUMP_EDGES * edge;
        (after.1 - before.1).abs() > farthest || joined.contains(&probe)
    };
    let mut pieces = vec![start.probe];
    pieces.extend((start.probe + 1..points.len()).filter(|&probe| is_jump(probe)));
    let ends: Vec<usize> = pieces.iter().skip(1).copied().chain([points.len()]).collect();
    for (first, end) in pieces.into_iter().zip(ends) {
        let piece = &points[first..end];
        for (now, speed) in piece.iter().zip(&mut speeds[first..end]) {
            let from = piece.partition_point(|point| point.0 < now.0 - half);
            let to = piece.partition_point(|point| point.0 <= now.0 + half);
            let seen = &piece[from..to];
            let is_long = seen[seen.len() - 1].0 - seen[0].0 >= LEAST_PIECE * width * (1.0 - 1e-6);
            if seen.len() >= WINDOW_PROBES && is_long {
                let fit = regression::line(seen).filter(|fit| fit.slope >= 0.0);
                *speed = fit.map(|fit| Speed {
                    value: fit.slope,
                    error: fit.slope_error,
                });
            }
        }
    }
    speeds
}

/// Share of the probes from initiation to the last advance that have a speed.
pub fn share(tips: &[Tip], start: usize, speeds: &[Option<Speed>]) -> Option<f64> {
    let advances = |probe: &usize| tips[*probe].arc_length > tips[*probe - 1].arc_length;
    let last = (start.max(1)..tips.len()).rev().find(advances)?;
    let moving = &speeds[start..=last];
    let told = moving.iter().flatten().count();
    Some(told as f64 / moving.len() as f64)
}
