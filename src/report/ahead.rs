//! The stress ahead of the tip when the crack starts.

use super::Analysed;
use crate::analysis::stress_intensity;

/// One bin ahead of the tip.
pub struct Ahead {
    /// ps
    pub time: f64,
    /// nm
    pub distance: f64,
    /// Virial stress xx, yy, xy and traction x, y across the crack plane, eV/nm^3; runs of older versions have no traction.
    pub stress: [f64; 3],
    pub traction: Option<[f64; 2]>,
}

/// The profile at the probe before initiation.
pub fn profile_at_initiation(case: &Analysed) -> Vec<Ahead> {
    let Some(probe) = case.findings.initiation.and_then(|start| start.probe.checked_sub(1)) else {
        return Vec::new();
    };
    let (series, tip) = (&case.result.series, case.findings.tips[probe].x);
    let time = series.probes[probe].time;
    let bin = |(distance, stress, traction)| Ahead {
        time,
        distance,
        stress,
        traction,
    };
    stress_intensity::ahead(series, probe, tip).map(bin).collect()
}
