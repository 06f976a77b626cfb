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

/// One a probe, from initiation on. Near both ends of the motion the window is cut off there. None where the crack has not
/// run for half a window, and none across a jump.
pub fn speeds(
    tips: &[Tip],
    series: &Series,
    initiation: Option<Initiation>,
    window: Option<f64>,
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
    let edge = f64::from(setting.element_at_crack) * setting.spacing;
    let jumps = |pair: &[(f64, f64)]| {
        let farthest = setting.longitudinal_speed * (pair[1].0 - pair[0].0) + JUMP_EDGES * edge;
        pair[1].1 - pair[0].1 > farthest
    };
    let run = points[points.len() - 1].0 - points[start.probe].0;
    if run < 0.5 * width {
        return speeds;
    }
    for probe in start.probe..points.len() {
        let now = points[probe].0;
        let from = points.partition_point(|point| point.0 < now - half).max(start.probe);
        let to = points.partition_point(|point| point.0 <= now + half);
        if to - from >= WINDOW_PROBES && !points[from..to].windows(2).any(jumps) {
            speeds[probe] = regression::line(&points[from..to]).map(|fit| Speed {
                value: fit.slope,
                error: fit.slope_error,
            });
        }
    }
    speeds
}
