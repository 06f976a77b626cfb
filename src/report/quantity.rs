//! What is told of cases that stand side by side.

use crate::report::Analysed;
use crate::report::numbers::{signed_percent, significant};
use crate::report::tables::comparison::shown;
use crate::report::tables::first_branch;
use crate::report::tables::k_ic::Definition;
use crate::report::units::{MEGAJOULE_A_CUBIC_METRE, PERCENT};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    Nodes,
    Elements,
    Atoms,
    Steps,
    CoreSeconds,
    InitiationStrain,
    InitiationTime,
    StressIntensity(Definition),
    PeakSpeed,
    BranchTime,
    BranchStrain,
    BranchAngle,
    ArrestTime,
    WorkDensity,
}

impl Quantity {
    /// In the order in which they are shown.
    pub fn all() -> Vec<Self> {
        let mut all = vec![
            Self::Nodes,
            Self::Elements,
            Self::Atoms,
            Self::Steps,
            Self::CoreSeconds,
            Self::InitiationStrain,
            Self::InitiationTime,
        ];
        all.extend(Definition::ALL.map(Self::StressIntensity));
        all.extend([
            Self::PeakSpeed,
            Self::BranchTime,
            Self::BranchStrain,
            Self::BranchAngle,
            Self::ArrestTime,
            Self::WorkDensity,
        ]);
        all
    }

    /// Its name in tables, with the unit.
    pub fn column(self) -> &'static str {
        match self {
            Self::Nodes => "nodes",
            Self::Elements => "elements",
            Self::Atoms => "represented_atoms",
            Self::Steps => "steps",
            Self::CoreSeconds => "core_seconds",
            Self::InitiationStrain => "initiation_strain",
            Self::InitiationTime => "initiation_time_ps",
            Self::StressIntensity(definition) => definition.column(),
            Self::PeakSpeed => "peak_speed_over_c_r",
            Self::BranchTime => "first_branch_after_start_ps",
            Self::BranchStrain => "first_branch_strain",
            Self::BranchAngle => "first_branch_angle_deg",
            Self::ArrestTime => "arrest_after_start_ps",
            Self::WorkDensity => "work_density_mj_m3",
        }
    }

    pub fn label(self) -> String {
        match self {
            Self::Nodes => "nodes".to_owned(),
            Self::Elements => "elements".to_owned(),
            Self::Atoms => "atoms represented".to_owned(),
            Self::Steps => "steps".to_owned(),
            Self::CoreSeconds => "core-seconds".to_owned(),
            Self::InitiationStrain => "crack starts at strain (%)".to_owned(),
            Self::InitiationTime => "crack starts after (ps)".to_owned(),
            Self::StressIntensity(definition) => format!("K at initiation, {} (MPa √m)", definition.words()),
            Self::PeakSpeed => "highest speed / c_R".to_owned(),
            Self::BranchTime => "first branch after the start (ps)".to_owned(),
            Self::BranchStrain => "first branch at strain (%)".to_owned(),
            Self::BranchAngle => "first branch at angle (°)".to_owned(),
            Self::ArrestTime => "stands still from (ps after the start)".to_owned(),
            Self::WorkDensity => "area under stress over strain (MJ/m³)".to_owned(),
        }
    }

    /// In the unit of its column.
    pub fn value(self, case: &Analysed) -> Option<f64> {
        let setting = || case.result.setting.as_ref();
        let branch = || case.findings.first_branch();
        match self {
            Self::Nodes => Some(setting()?.nodes as f64),
            Self::Elements => Some(setting()?.elements as f64),
            Self::Atoms => Some(setting()?.represented_atoms as f64),
            Self::Steps => Some(case.result.manifest.steps? as f64),
            Self::CoreSeconds => case.core_seconds(),
            Self::InitiationStrain => Some(case.findings.initiation?.strain),
            Self::InitiationTime => Some(case.findings.initiation?.time),
            Self::StressIntensity(definition) => definition.value(case),
            Self::PeakSpeed => case.peak_speed_over_rayleigh(),
            Self::BranchTime => first_branch::after_start(case),
            Self::BranchStrain => Some(branch()?.strain),
            Self::BranchAngle => Some(branch()?.angle),
            Self::ArrestTime => arrest(case),
            Self::WorkDensity => Some(case.result.series.work_density()? * MEGAJOULE_A_CUBIC_METRE),
        }
    }

    /// How far a value is from another in its unit; of angles, what a mirror leaves.
    pub fn difference(self, value: f64, from: f64) -> f64 {
        if self == Self::BranchAngle && is_mirrored(value, from) {
            value.abs() - from.abs()
        } else {
            value - from
        }
    }

    /// The same as a share; of angles and their zero nobody asks for one.
    pub fn relative_difference(self, value: f64, from: f64) -> Option<f64> {
        (self != Self::BranchAngle).then(|| value / from - 1.0)
    }

    /// A value as a person reads it, and in brackets how far it is from another: moments and angles in their own unit, all
    /// else in percent.
    pub fn shown(self, value: f64, from: Option<f64>) -> String {
        let factor = match self {
            Self::InitiationStrain | Self::BranchStrain => PERCENT,
            _ => 1.0,
        };
        let text = shown(value * factor);
        let unit = match self {
            Self::InitiationTime | Self::BranchTime | Self::ArrestTime => Some("ps"),
            Self::BranchAngle => Some("°"),
            _ => None,
        };
        match (from, unit) {
            (None, _) => text,
            (Some(from), Some("°")) => format!("{text} ({})", turned(value, from)),
            (Some(from), Some(unit)) => format!("{text} ({})", signed(value - from, unit)),
            (Some(from), None) => format!("{text} ({})", signed_percent(value / from - 1.0)),
        }
    }
}

/// When the main crack last advances, ps after its start, where it stands still at the end of the run.
fn arrest(case: &Analysed) -> Option<f64> {
    case.findings.branches.first().filter(|main| main.arrested)?;
    let tips = &case.findings.tips;
    let farthest = tips.iter().map(|tip| tip.x).max_by(f64::total_cmp)?;
    let last = tips.iter().position(|tip| tip.x == farthest)?;
    Some(case.result.series.probes.get(last)?.time - case.findings.initiation?.time)
}

/// What rounding leaves of equal moments, ps, and angles, degrees.
const ROUNDING: f64 = 1e-9;

/// How an angle differs from another: the specimen is its own mirror image in the crack plane, so a crack that turns the
/// other way differs by a mirror and the rest, `mirrored, −3 °`.
fn turned(value: f64, from: f64) -> String {
    let rest = signed(Quantity::BranchAngle.difference(value, from), "°");
    if is_mirrored(value, from) {
        format!("mirrored, {rest}")
    } else {
        rest
    }
}

fn is_mirrored(value: f64, from: f64) -> bool {
    value * from < 0.0 && (value + from).abs() < (value - from).abs()
}

/// `+12 ps`
pub fn signed(value: f64, unit: &str) -> String {
    let value = if value.abs() < ROUNDING { 0.0 } else { value };
    let sign = if value > 0.0 { "+" } else { "" };
    format!("{sign}{} {unit}", significant(value, 3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_angle_to_the_other_side_differs_by_a_mirror_and_the_rest() {
        let shown = |value, from| Quantity::BranchAngle.shown(value, Some(from));
        assert_eq!(shown(57.0, -60.0), "57 (mirrored, −3.00 °)");
        assert_eq!(shown(57.0, 60.0), "57 (−3.00 °)");
        assert_eq!(shown(-62.0, 60.0), "−62.00 (mirrored, +2.00 °)");
        assert_eq!(shown(-1.0, 2.0), "−1.000 (mirrored, −1.00 °)");
    }
}
