//! The crack of a run, followed in the frame of the analysis.

use super::j_integral::Rings;
use super::probe::bond_events;
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
        })
    }

    /// Takes the events between two probes; where the front of the damage is then.
    pub fn follow(&mut self, events: &[BondEvent]) -> f64 {
        let events: Vec<BondEvent> = events.iter().map(|event| self.frame.event(event)).collect();
        self.tracker.follow(&events);
        damage::front(&self.tracker, &events, &self.setting)
    }

    pub fn tip(&self) -> Tip {
        self.tracker.tip()
    }

    pub fn has_left_plane(&self) -> bool {
        self.tracker.has_left_plane()
    }

    pub fn has_branch(&self) -> bool {
        branches::arms(&self.tracker, spur(&self.setting)).len() > 1
    }

    /// A tip on the crack plane at x, nm from the left edge of the specimen.
    pub fn place(&self, x: f64) -> f64 {
        self.frame.place([x, 0.0])[0]
    }

    /// Bonds beyond the notch that the crack has parted, ascending by column, row and direction.
    pub fn parted(&self) -> Vec<[i32; 3]> {
        let mut parted = self.tracker.parted();
        parted.iter_mut().for_each(|bond| *bond = self.frame.bond(*bond));
        parted.sort_unstable();
        parted
    }

    /// Goes on from the bonds that it had parted by a probe.
    pub fn go_on_from(&mut self, parted: &[[i32; 3]], probe: u32) {
        self.follow(&bond_events(&[], parted, probe));
    }

    /// Rings around the tip, in which J is read; `None` where there is no room for them.
    pub fn rings(&self, mesh: &Mesh) -> Option<Rings> {
        Rings::around(self.tip(), mesh, &self.frame, &self.setting)
    }
}
