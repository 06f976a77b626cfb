//! The crack of a run, followed in the frame of the analysis.

use super::j_integral::Rings;
use crate::analysis::crack::{Tip, Tracker, branches, spur};
use crate::analysis::damage;
use crate::analysis::frame::Frame;
use crate::analysis::series::{BondEvent, Setting};
use crate::mesh::Mesh;

/// Follows the crack from probe to probe. Bonds go in and come out as those of the specimen; tips are in the frame of the
/// crack.
pub struct Crack {
    frame: Frame,
    /// In the frame of the crack.
    setting: Setting,
    tracker: Tracker,
    /// The probes at which it joined one ahead of it.
    joins: Vec<u32>,
}

impl Crack {
    /// The crack as cut; `None` where the specimen has none.
    pub fn new(setting: &Setting) -> Option<Self> {
        let frame = Frame::of(setting);
        let setting = frame.setting(setting);
        let tracker = Tracker::new(&setting)?;
        Some(Self {
            frame,
            setting,
            tracker,
            joins: Vec::new(),
        })
    }

    /// Takes the events between the probe before and this one; where the front of the damage is then.
    pub fn follow(&mut self, events: &[BondEvent], probe: u32) -> f64 {
        let events: Vec<BondEvent> = events.iter().map(|event| self.frame.event(event)).collect();
        let earlier = self.tip();
        self.tracker.follow(&events);
        if !events.is_empty() && self.tracker.joined(earlier, probe, spur(&self.setting)).is_some() {
            self.joins.push(probe);
        }
        damage::front(&self.tracker, &events, &self.setting)
    }

    pub fn tip(&self) -> Tip {
        self.tracker.tip()
    }

    pub fn has_left_plane(&self) -> bool {
        self.tracker.has_left_plane()
    }

    pub fn has_branch(&self) -> bool {
        let arms = branches::arms(&self.tracker, spur(&self.setting));
        arms.iter().any(|arm| arm.is_branch(&self.joins))
    }

    /// A tip on the crack plane at x, nm from the left edge of the specimen.
    pub fn place(&self, x: f64) -> f64 {
        self.frame.place([x, 0.0])[0]
    }

    /// The probes at which it joined one ahead of it.
    pub fn joins(&self) -> &[u32] {
        &self.joins
    }

    /// Bonds beyond the notch that the crack has parted, with the probes at which they broke, ascending by column, row and
    /// direction.
    pub fn parted(&self) -> Vec<BondEvent> {
        let parted = self.tracker.parted();
        let mut parted: Vec<BondEvent> = parted.iter().map(|event| self.frame.event(event)).collect();
        parted.sort_unstable_by_key(|event| (event.column, event.row, event.direction));
        parted
    }

    /// Goes on from the bonds that it had parted, and the probes at which it had joined one ahead.
    pub fn go_on_from(&mut self, parted: &[BondEvent], joins: &[u32]) {
        let parted: Vec<BondEvent> = parted.iter().map(|event| self.frame.event(event)).collect();
        self.tracker.follow(&parted);
        self.joins = joins.to_vec();
    }

    /// Rings around the tip, in which J is read; `None` where there is no room for them.
    pub fn rings(&self, mesh: &Mesh) -> Option<Rings> {
        Rings::around(self.tip(), mesh, &self.frame, &self.setting)
    }
}
