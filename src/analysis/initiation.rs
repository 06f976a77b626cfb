//! When the crack sets out for good.

use super::crack::Tip;
use super::series::{Series, Setting};

/// Spacings beyond one element edge by which the tip must advance, and to which it must never come back. Bonds at a
/// loaded tip open and close by one or two, and a coarse mesh opens a whole element edge at once.
pub const ADVANCE_SPACINGS: f64 = 2.0;

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

/// The beginning of the advance that takes the crack beyond the threshold and never back to the notch: the first probe
/// from which it grew, probe by probe, until it was there. The beginning does not depend on the size of the elements,
/// however far an advance must reach to count.
pub fn initiation(tips: &[Tip], series: &Series, setting: &Setting) -> Option<Initiation> {
    let notch = tips.first()?.arc_length;
    let back = notch + ADVANCE_SPACINGS * setting.spacing;
    let left = tips.iter().rposition(|tip| tip.arc_length <= back)? + 1;
    let far = notch + threshold(setting);
    let there = left + tips[left..].iter().position(|tip| tip.arc_length > far)?;
    let stands = |&probe: &usize| tips[probe].arc_length <= tips[probe - 1].arc_length;
    let start = (1..there).rev().find(stands).unwrap_or(0) + 1;
    let row = series.probes.get(start)?;
    Some(Initiation {
        probe: start,
        time: row.time,
        strain: row.strain,
    })
}
