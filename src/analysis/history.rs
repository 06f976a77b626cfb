//! The crack through time: its tip at every probe, what happens to it, and its branches at the end.

use super::crack::branches;
use super::crack::{Tip, Tracker, spur};
use super::damage::{Band, front};
use super::initiation::ARREST_SPEED;
use super::series::{Probe, Series, Setting};

/// A crack from its start to the end of the run.
#[derive(Clone, Debug, Default)]
pub struct History {
    /// One a probe.
    pub tips: Vec<Tip>,
    /// The main crack, then its branches.
    pub branches: Vec<Branch>,
    pub first_bond: Option<FirstBond>,
    pub joins: Vec<Join>,
    pub leaves_plane: Option<LeavesPlane>,
    pub parted_elsewhere: Option<PartedElsewhere>,
}

impl History {
    /// The probes at which the crack joins one ahead of it.
    pub fn joined(&self) -> Vec<usize> {
        self.joins.iter().map(|join| join.probe).collect()
    }
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
    /// It forked off when the crack joined one ahead of it: what was left of the old tip, and no branch.
    pub joined: bool,
}

/// The first bond of the crack ahead of the notch breaks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstBond {
    /// ps
    pub time: f64,
    pub strain: f64,
}

/// The crack joins one that had opened ahead of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Join {
    pub probe: usize,
    /// ps
    pub time: f64,
    pub strain: f64,
    /// The tip at the probe before, and at this one.
    pub from: Tip,
    pub to: Tip,
    /// What parted the two, nm.
    pub gap: f64,
}

/// A path of the crack is first so far from the crack plane that it has left it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeavesPlane {
    pub probe: usize,
    /// ps
    pub time: f64,
    pub strain: f64,
    /// The end of the path, nm from the left edge and from the crack plane.
    pub x: f64,
    pub y: f64,
    /// When the first bond of that path off the plane broke, ps.
    pub first_off_time: f64,
}

/// The specimen parts along a band that is no part of the crack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartedElsewhere {
    /// ps
    pub time: f64,
    pub strain: f64,
    /// Mean distance of the band from the crack plane, nm, with its sign.
    pub y: f64,
}

/// Follows the crack through the bond events; `None` where the specimen has no crack.
pub fn history(series: &Series, setting: &Setting) -> Option<History> {
    let mut tracker = Tracker::new(setting)?;
    let mut band = Band::new(setting);
    let mut found = History::default();
    let mut farthest = front(&tracker, &[], setting);
    let mut grown = 0;
    let notch = tracker.tip();
    let mut events = series.bonds.as_slice();
    for (probe, row) in series.probes.iter().enumerate() {
        let number = probe as u32;
        let (now, later) = events.split_at(events.partition_point(|event| event.probe <= number));
        events = later;
        if let Some(&last) = found.tips.last().filter(|_| now.is_empty()) {
            found.tips.push(last);
            continue;
        }
        tracker.follow(now);
        let tip = tracker.tip();
        let earlier = found.tips.last().copied().unwrap_or(notch);
        found.tips.push(tip);
        if found.first_bond.is_none() && tip.arc_length > notch.arc_length {
            found.first_bond = Some(FirstBond {
                time: row.time,
                strain: row.strain,
            });
        }
        found.joins.extend(join(&tracker, probe, row, [earlier, tip], setting));
        if found.leaves_plane.is_none() && tracker.has_left_plane() {
            found.leaves_plane = leaves_plane(&tracker, probe, row, series);
        }
        // Under compression the crystal folds, and nothing parts.
        if found.parted_elsewhere.is_none() && row.strain > 0.0 {
            let parts = band.follow(&tracker, now);
            found.parted_elsewhere = parts.map(|y| PartedElsewhere {
                time: row.time,
                strain: row.strain,
                y,
            });
        }
        let reached = front(&tracker, now, setting);
        if reached > farthest {
            (farthest, grown) = (reached, number);
        }
    }
    found.branches = branches(&tracker, &found.joins, grown, series, setting);
    Some(found)
}

fn join(tracker: &Tracker, probe: usize, row: &Probe, [from, to]: [Tip; 2], setting: &Setting) -> Option<Join> {
    let joined = tracker.joined(from, probe as u32, spur(setting))?;
    Some(Join {
        probe,
        time: row.time,
        strain: row.strain,
        from,
        to,
        gap: joined.gap,
    })
}

fn leaves_plane(tracker: &Tracker, probe: usize, row: &Probe, series: &Series) -> Option<LeavesPlane> {
    let departure = tracker.departure()?;
    Some(LeavesPlane {
        probe,
        time: row.time,
        strain: row.strain,
        x: departure.x,
        y: departure.y,
        first_off_time: series.probes.get(departure.first_off as usize)?.time,
    })
}

/// `grown`: the probe at which the front of the damage last advanced, which belongs to the main crack.
fn branches(tracker: &Tracker, joins: &[Join], grown: u32, series: &Series, setting: &Setting) -> Vec<Branch> {
    let time = |probe: u32| {
        series
            .probes
            .get(probe as usize)
            .map(|probe| (probe.time, probe.strain))
    };
    let end = series.probes.last().map_or(0.0, |probe| probe.time);
    let spur = spur(setting);
    let joins: Vec<u32> = joins.iter().map(|join| join.probe as u32).collect();
    let patience = spur as f64 * setting.spacing / (ARREST_SPEED * setting.rayleigh_speed);
    branches::arms(tracker, spur)
        .into_iter()
        .filter_map(|arm| {
            let (born, strain) = time(arm.born)?;
            let last = if arm.parent.is_none() {
                arm.grown.max(grown)
            } else {
                arm.grown
            };
            let (grown, _) = time(last)?;
            Some(Branch {
                parent: arm.parent,
                probe: arm.born as usize,
                time: born,
                strain,
                x: arm.x,
                y: arm.y,
                angle: arm.angle,
                arrested: end - grown > patience,
                joined: arm.parent.is_some() && !arm.is_branch(&joins),
            })
        })
        .collect()
}
