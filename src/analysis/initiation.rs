//! When the crack sets out for good.

use super::crack::Tip;
use super::series::{Series, Setting};

/// Spacings beyond the notch that the tip must pass: more than the edge of an element of ten atoms, which opens bond by bond, as
/// a hinge, at half of the load at which the crack leaves it. Where edges are longer, one edge, from corner to corner.
pub const ADVANCE_SPACINGS: f64 = 12.0;

/// A tip that does not advance while the strain grows by this share stands still.
pub const STAND_GROWTH: f64 = 0.1;

/// The same of a tip that has broken no more than the one bond at the very end of the notch: when that breaks hangs on how the
/// notch ends, and the next bonds may need a tenth more load.
pub const STAND_GROWTH_AT_NOTCH: f64 = 0.05;
const NOTCH_END_SPACINGS: f64 = 0.75;

/// An advance through [`far`] that needs this much more strain, as a share, is led by the load: the crack
/// creeps, unless it is faster than [`ARREST_SPEED`].
pub const CREEP_GROWTH: f64 = 0.2;

/// A crack slower than this share of the Rayleigh speed stands still.
pub const ARREST_SPEED: f64 = 0.1;

/// Spacings and one element edge beyond them: the least advance that is seen on every mesh.
const SEEN_SPACINGS: f64 = 2.0;

/// The first lasting advance of the tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Initiation {
    pub probe: usize,
    /// ps
    pub time: f64,
    pub strain: f64,
}

/// The least advance that is seen on a mesh, nm; windows in time are made for it.
pub fn threshold(setting: &Setting) -> f64 {
    (SEEN_SPACINGS + f64::from(setting.element_at_crack)) * setting.spacing
}

/// Advance along the path that a crack that has set out has behind it, nm.
pub fn far(setting: &Setting) -> f64 {
    let edge = f64::from(setting.element_at_crack + 1);
    ADVANCE_SPACINGS.max(edge) * setting.spacing
}

/// The beginning of the advance that takes the tip [`far`] beyond the notch: where it leaves, for good, the
/// place at which it last stood still. An advance that creeps, and one under compression, is none: then the next one counts
/// that takes the tip as far again.
///
/// Standing and creeping are told by the growth of the load, which is the textbook's stable growth of a crack: the event is
/// then the same at any strain rate. Its measure is a length that is the same on every mesh whose edges are shorter: a crack in
/// large elements has not started because it has opened the first bonds of an edge.
pub fn initiation(tips: &[Tip], series: &Series, setting: &Setting) -> Option<Initiation> {
    let notch = tips.first()?.arc_length;
    let course = Course {
        advance: tips.iter().map(|tip| tip.arc_length - notch).collect(),
        series,
        reach: far(setting),
        notch_end: NOTCH_END_SPACINGS * setting.spacing,
    };
    let mut target = course.reach;
    let mut from = 1;
    loop {
        let there = course.passes(target, from)?;
        let start = course.departure(there, from, target);
        // Where it came back to later, it has not left for good.
        let place = course.advance[start - 1];
        let back = course.advance.iter().rposition(|&advance| advance <= place)?;
        if back >= start {
            from = back + 1;
        } else if course.pulls(start) && !course.creeps(start, there, setting) {
            let row = &series.probes[start];
            return Some(Initiation {
                probe: start,
                time: row.time,
                strain: row.strain,
            });
        } else {
            target += setting.spacing;
        }
    }
}

/// How far the tip is beyond the notch at every probe, nm.
struct Course<'a> {
    advance: Vec<f64>,
    series: &'a Series,
    reach: f64,
    /// What the tip has advanced when one bond has broken is less than this, nm.
    notch_end: f64,
}

impl Course<'_> {
    /// The first probe, not before another, at which the tip is farther than this.
    fn passes(&self, target: f64, from: usize) -> Option<usize> {
        let later = self.advance.get(from..)?.iter();
        Some(from + later.clone().position(|&advance| advance > target)?)
    }

    /// Back from a probe along the advances that follow each other without a stand, no farther than the reach.
    fn departure(&self, there: usize, from: usize, target: f64) -> usize {
        let mut start = there;
        for probe in (from..there).rev() {
            let [now, then] = [start, probe].map(|probe| self.series.probes[probe].strain);
            let growth = match self.advance[probe] < self.notch_end {
                true => STAND_GROWTH_AT_NOTCH,
                false => STAND_GROWTH,
            };
            let stood = start - probe > 1 && now - then > growth * now;
            if stood || self.advance[probe] < target - self.reach {
                break;
            }
            if self.advance[probe] > self.advance[probe - 1] {
                start = probe;
            }
        }
        start
    }

    fn pulls(&self, probe: usize) -> bool {
        let row = &self.series.probes[probe];
        row.strain > 0.0 && row.sigma_yy > 0.0
    }

    fn creeps(&self, start: usize, there: usize, setting: &Setting) -> bool {
        let [first, last] = [start, there].map(|probe| &self.series.probes[probe]);
        let gained = self.advance[there] - self.advance[start];
        let is_slow = gained < ARREST_SPEED * setting.rayleigh_speed * (last.time - first.time);
        is_slow && last.strain - first.strain > CREEP_GROWTH * first.strain
    }
}
