//! The frame of the crack: the analysis is written for one that comes from the left.
//!
//! Half a turn around a place on the crack plane takes the lattice onto itself: site (i, j) to (-i, b - j). A bond keeps its
//! direction, stresses and tractions their components; velocities change sign. So a crack from the right becomes one from the
//! left. One inside is looked at from the middle of its notch to the right, without a turn. Everything that the analysis takes
//! in goes through here, and its findings come back through here, so that a person sees places in the specimen.

use std::borrow::Cow;

use super::Findings;
use super::crack::Tip;
use super::series::{BondEvent, CrackFrom, Series, Setting};
use super::waves::Face;
use crate::lattice::triangular::{self, NEAREST};

/// Where the frame of a crack lies in its specimen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// What x in this frame is measured from, nm from the left edge.
    origin: f64,
    /// -1 after half a turn, otherwise 1.
    direction: f64,
    /// Sum of the rows of a site and of the one that it is turned to.
    rows: i32,
}

impl Frame {
    pub fn of(setting: &Setting) -> Frame {
        let (origin, direction) = match setting.crack_from {
            CrackFrom::Left => (0.0, 1.0),
            CrackFrom::Right { edge } => (edge, -1.0),
            CrackFrom::Inside { center } => (center, 1.0),
        };
        Frame {
            origin,
            direction,
            rows: 2 * setting.crack_row.unwrap_or(0) - 1,
        }
    }

    /// 1 where the crack runs along x, -1 where against it.
    pub fn direction(&self) -> f64 {
        self.direction
    }

    fn is_turned(&self) -> bool {
        self.direction < 0.0
    }

    /// The specimen in this frame: it begins at the origin, and what lies behind is none of the crack's.
    pub fn setting(&self, setting: &Setting) -> Setting {
        let here = setting.left_x + self.origin;
        let turned = triangular::position([0, self.rows])[0] * setting.spacing - here;
        let (length, crack_from) = match setting.crack_from {
            CrackFrom::Left | CrackFrom::Right { .. } => (setting.length, CrackFrom::Left),
            CrackFrom::Inside { center } => (setting.length - center, CrackFrom::Inside { center: 0.0 }),
        };
        Setting {
            left_x: if self.is_turned() { turned } else { here },
            length,
            crack_from,
            ..setting.clone()
        }
    }

    /// A bond in this frame, or back: column, row and direction.
    pub fn bond(&self, [column, row, direction]: [i32; 3]) -> [i32; 3] {
        if !self.is_turned() {
            return [column, row, direction];
        }
        let [right, up] = NEAREST[direction as usize];
        [-(column + right), self.rows - (row + up), direction]
    }

    pub fn event(&self, event: &BondEvent) -> BondEvent {
        let [column, row, _] = self.bond([event.column, event.row, i32::from(event.direction)]);
        BondEvent { column, row, ..*event }
    }

    /// A place in this frame, nm from the origin and the crack plane, in the specimen, nm from its left edge.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        // No negative zero.
        [self.origin + self.direction * x, 0.0 + self.direction * y]
    }

    /// The reverse.
    fn seen(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.direction * (x - self.origin), self.direction * y]
    }

    /// A run in this frame. J is that of the advance of its crack in any frame.
    pub fn series<'a>(&self, series: &'a Series) -> Cow<'a, Series> {
        if self.origin == 0.0 && !self.is_turned() {
            return Cow::Borrowed(series);
        }
        let mut seen = series.clone();
        seen.bonds.iter_mut().for_each(|event| *event = self.event(event));
        seen.profile_x.iter_mut().for_each(|x| *x = self.seen([*x, 0.0])[0]);
        seen.gauge_places
            .iter_mut()
            .for_each(|place| *place = self.seen(*place));
        let velocities = seen.gauges.iter_mut().flat_map(|gauge| &mut gauge[..2]);
        velocities.for_each(|velocity| *velocity *= self.direction);
        if self.is_turned() {
            let bins = seen.profile_x.len().max(1);
            seen.profile_x.reverse();
            seen.profiles.chunks_mut(bins).for_each(<[_]>::reverse);
            seen.tractions.chunks_mut(bins).for_each(<[_]>::reverse);
        }
        Cow::Owned(seen)
    }

    /// What was found in this frame, as it is in the specimen.
    pub fn findings(&self, mut found: Findings) -> Findings {
        let joins = found.joins.iter_mut().flat_map(|join| [&mut join.from, &mut join.to]);
        found.tips.iter_mut().chain(joins).for_each(|tip| *tip = self.tip(*tip));
        for branch in &mut found.branches {
            [branch.x, branch.y] = self.place([branch.x, branch.y]);
            branch.angle = self.angle(branch.angle);
        }
        if let Some(leaves) = &mut found.leaves_plane {
            [leaves.x, leaves.y] = self.place([leaves.x, leaves.y]);
        }
        if let Some(band) = &mut found.parted_elsewhere {
            band.y *= self.direction;
        }
        for arrival in found.arrivals.iter_mut().filter(|_| self.is_turned()) {
            arrival.face = match arrival.face {
                Face::Left => Face::Right,
                Face::Right => Face::Left,
                Face::TopAndBottom => Face::TopAndBottom,
            };
        }
        found
    }

    fn tip(&self, tip: Tip) -> Tip {
        let [x, y] = self.place([tip.x, tip.y]);
        Tip { x, y, ..tip }
    }

    /// Degrees from the x axis, from -180 to 180.
    fn angle(&self, angle: f64) -> f64 {
        match (self.is_turned(), angle > 0.0) {
            (false, _) => angle,
            (true, true) => angle - 180.0,
            (true, false) => angle + 180.0,
        }
    }
}
