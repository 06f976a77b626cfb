//! Bonds that break away from the crack.

use super::crack::Tracker;
use super::series::{BondEvent, Setting};

/// Damage up to this share of the height from the crack plane lies in the way of the crack; what is farther off does not.
pub const IN_THE_WAY_SHARE: f64 = 0.25;

/// Width of the stretches of the length in which a broken bond is looked for, spacings.
pub const STRETCH_SPACINGS: f64 = 4.0;

/// The specimen has parted along a band when so many of the stretches have a broken bond there.
pub const PARTED_SHARE: f64 = 0.8;

/// The foremost bond that breaks in the way of the crack, whether or not it hangs together with it, nm from the left edge; of
/// nothing, the end of the crack.
///
/// A crack in small elements goes on in pieces that touch each other only later. Its tip is where it hangs together with the
/// notch, but it has not come to rest as long as pieces open ahead.
pub fn front(tracker: &Tracker, events: &[BondEvent], setting: &Setting) -> f64 {
    let off = IN_THE_WAY_SHARE * setting.height;
    let broken = events.iter().filter(|event| event.broken);
    let places = broken.map(|event| tracker.place(event)).filter(|[_, y]| y.abs() <= off);
    places.map(|[x, _]| x).fold(tracker.tip().x, f64::max)
}

/// Where bonds have broken far from the crack plane without being part of the crack: below and above.
#[derive(Clone, Debug)]
pub struct Band {
    off: f64,
    width: f64,
    sides: [Side; 2],
}

#[derive(Clone, Debug)]
struct Side {
    broken: Vec<bool>,
    /// Number and sum of the heights of the bonds, nm.
    count: usize,
    height: f64,
}

impl Band {
    pub fn new(setting: &Setting) -> Band {
        let width = STRETCH_SPACINGS * setting.spacing;
        let side = Side {
            broken: vec![false; ((setting.length / width) as usize).max(1)],
            count: 0,
            height: 0.0,
        };
        Band {
            off: IN_THE_WAY_SHARE * setting.height,
            width,
            sides: [side.clone(), side],
        }
    }

    /// Takes the events of a probe, which the tracker has followed; the mean height of a band that has parted the specimen.
    pub fn follow(&mut self, tracker: &Tracker, events: &[BondEvent]) -> Option<f64> {
        for event in events.iter().filter(|event| event.broken) {
            let [x, y] = tracker.place(event);
            // Behind the middle of a notch inside runs another crack, which is not followed.
            if x < 0.0 || y.abs() <= self.off || tracker.depth(event).is_some() {
                continue;
            }
            let side = &mut self.sides[usize::from(y > 0.0)];
            let stretch = (x / self.width) as usize;
            let last = side.broken.len() - 1;
            side.broken[stretch.min(last)] = true;
            side.count += 1;
            side.height += y;
        }
        let parted = self.sides.iter().find(|side| {
            let broken = side.broken.iter().filter(|&&broken| broken).count();
            broken as f64 >= PARTED_SHARE * side.broken.len() as f64
        });
        parted.map(|side| side.height / side.count as f64)
    }
}
