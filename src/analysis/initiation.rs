//! When the crack sets out for good.

use super::crack::Tip;
use super::series::{Series, Setting};

/// Spacings beyond one element edge by which the tip must have advanced. Bonds at a loaded tip open and close by one
/// or two, and a coarse mesh opens a whole element edge at once.
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

/// The first probe from which on the crack stays longer than at the start by more than the threshold.
pub fn initiation(tips: &[Tip], series: &Series, setting: &Setting) -> Option<Initiation> {
    let start = tips.first()?.arc_length + threshold(setting);
    let probe = tips.iter().rposition(|tip| tip.arc_length <= start)? + 1;
    let row = series.probes.get(probe)?;
    Some(Initiation {
        probe,
        time: row.time,
        strain: row.strain,
    })
}
