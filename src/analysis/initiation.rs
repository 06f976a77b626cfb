//! When the crack sets out for good.

use super::crack::Tip;
use super::series::{Series, Setting};

/// Spacings beyond one element edge by which the tip must advance, and to which it must never come back. Bonds at a
/// loaded tip open and close by one or two, and a coarse mesh opens a whole element edge at once.
pub const ADVANCE_SPACINGS: f64 = 2.0;

/// A crack slower than this share of the Rayleigh speed stands still.
pub const ARREST_SPEED: f64 = 0.1;

/// The first lasting advance of the tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Initiation {
    pub probe: usize,
    /// ps
    pub time: f64,
    pub strain: f64,
}

/// Advance along the path that counts as lasting, nm.
pub fn threshold(setting: &Setting) -> f64 {
    (ADVANCE_SPACINGS + f64::from(setting.element_at_crack)) * setting.spacing
}

/// The beginning of the advance that takes the crack beyond the threshold and never back to the notch: where the tip had
/// stood still for longer than a crack at [`ARREST_SPEED`] needs for one edge of the elements at the crack, which open
/// one edge at a time.
pub fn initiation(tips: &[Tip], series: &Series, setting: &Setting) -> Option<Initiation> {
    let notch = tips.first()?.arc_length;
    let last_within = |reach: f64| tips.iter().rposition(|tip| tip.arc_length <= notch + reach);
    let left = last_within(ADVANCE_SPACINGS * setting.spacing)? + 1;
    let far = notch + threshold(setting);
    let there = left + tips[left..].iter().position(|tip| tip.arc_length > far)?;
    let edge = f64::from(setting.element_at_crack) * setting.spacing;
    let patience = edge / (ARREST_SPEED * setting.rayleigh_speed);
    let time = |probe: usize| series.probes[probe].time;
    let mut start = there;
    for probe in (last_within(0.0)? + 1..there).rev() {
        if time(start) - time(probe) > patience {
            break;
        }
        if tips[probe].arc_length > tips[probe - 1].arc_length {
            start = probe;
        }
    }
    let row = series.probes.get(start)?;
    Some(Initiation {
        probe: start,
        time: row.time,
        strain: row.strain,
    })
}
