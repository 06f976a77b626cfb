//! The crack through time: its tip at every probe and its branches at the end.

use super::crack::branches;
use super::crack::{Tip, Tracker, spur};
use super::initiation::ARREST_SPEED;
use super::series::{Series, Setting};

/// A crack from its start to the end of the run.
#[derive(Clone, Debug, Default)]
pub struct History {
    /// One a probe.
    pub tips: Vec<Tip>,
    /// The main crack, then its branches.
    pub branches: Vec<Branch>,
}

/// An arm of the crack at the end of the run.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// Index of the arm it forks off; `None` for the main crack.
    pub parent: Option<usize>,
    /// Probe, time (ps) and strain of its birth.
    pub probe: usize,
    pub time: f64,
    pub strain: f64,
    /// The fork, nm from the left edge and from the crack plane.
    pub x: f64,
    pub y: f64,
    /// Degrees from the x axis, counterclockwise.
    pub angle: f64,
    pub arrested: bool,
}

/// Follows the crack through the bond events; `None` where the specimen has no crack.
pub fn history(series: &Series, setting: &Setting) -> Option<History> {
    let mut tracker = Tracker::new(setting)?;
    let mut tips: Vec<Tip> = Vec::with_capacity(series.probes.len());
    let mut events = series.bonds.as_slice();
    for probe in 0..series.probes.len() as u32 {
        let (now, later) = events.split_at(events.partition_point(|event| event.probe <= probe));
        events = later;
        tracker.follow(now);
        let unchanged = tips.last().copied().filter(|_| now.is_empty());
        tips.push(unchanged.unwrap_or_else(|| tracker.tip()));
    }
    Some(History {
        branches: branches(&tracker, series, setting),
        tips,
    })
}

fn branches(tracker: &Tracker, series: &Series, setting: &Setting) -> Vec<Branch> {
    let time = |probe: u32| {
        series
            .probes
            .get(probe as usize)
            .map(|probe| (probe.time, probe.strain))
    };
    let end = series.probes.last().map_or(0.0, |probe| probe.time);
    let spur = spur(setting);
    let patience = spur as f64 * setting.spacing / (ARREST_SPEED * setting.rayleigh_speed);
    branches::arms(tracker, spur)
        .into_iter()
        .filter_map(|arm| {
            let (born, strain) = time(arm.born)?;
            let (grown, _) = time(arm.grown)?;
            Some(Branch {
                parent: arm.parent,
                probe: arm.born as usize,
                time: born,
                strain,
                x: arm.x,
                y: arm.y,
                angle: arm.angle,
                arrested: end - grown > patience,
            })
        })
        .collect()
}
