//! Every bond that broke, with its place and time.

use super::crack::Tracker;
use super::crack::plaquette::Bond;
use super::frame::Frame;
use super::series::{Series, Setting};

/// A bond that broke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrokenBond {
    /// Its middle, nm from the left edge and from the crack plane.
    pub x: f64,
    pub y: f64,
    /// When it first broke, ps and strain.
    pub time: f64,
    pub strain: f64,
    /// Of the bond in the perfect crystal, degrees from the x axis: 0, 60 or 120.
    pub direction: f64,
    /// Whether it had closed again by the end of the run.
    pub closed: bool,
}

/// The bonds that broke, in the order in which they first did; empty without a crack.
pub fn broken_bonds(series: &Series, setting: &Setting) -> Vec<BrokenBond> {
    let frame = Frame::of(setting);
    let Some(tracker) = Tracker::new(&frame.setting(setting)) else {
        return Vec::new();
    };
    let mut found: Vec<BrokenBond> = Vec::new();
    let mut number = std::collections::HashMap::new();
    for event in &series.bonds {
        let Some(row) = series.probes.get(event.probe as usize) else {
            continue;
        };
        let event = &frame.event(event);
        if let Some(&known) = number.get(&Bond::of(event)) {
            let bond: &mut BrokenBond = &mut found[known];
            bond.closed = !event.broken;
        } else if event.broken && !tracker.is_cut(event) {
            number.insert(Bond::of(event), found.len());
            let [x, y] = frame.place(tracker.place(event));
            found.push(BrokenBond {
                x,
                y,
                time: row.time,
                strain: row.strain,
                direction: 60.0 * f64::from(event.direction),
                closed: false,
            });
        }
    }
    found
}
