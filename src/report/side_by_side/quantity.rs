//! What is told of cases that stand side by side.

use crate::report::Analysed;
use crate::report::branching;
use crate::report::expected::shown;
use crate::report::numbers::{signed_percent, significant};
use crate::report::toughness::Definition;
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
            Self::BranchTime => branching::after_start(case),
            Self::BranchStrain => Some(branch()?.strain),
            Self::BranchAngle => Some(branch()?.angle),
            Self::WorkDensity => Some(case.result.series.work_density()? * MEGAJOULE_A_CUBIC_METRE),
        }
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
            Self::InitiationTime | Self::BranchTime => Some("ps"),
            Self::BranchAngle => Some("°"),
            _ => None,
        };
        match (from, unit) {
            (None, _) => text,
            (Some(from), Some(unit)) => format!("{text} ({})", signed(value - from, unit)),
            (Some(from), None) => format!("{text} ({})", signed_percent(value / from - 1.0)),
        }
    }
}

/// What rounding leaves of equal moments, ps, and angles, degrees.
const ROUNDING: f64 = 1e-9;

/// `+12 ps`
pub fn signed(value: f64, unit: &str) -> String {
    let value = if value.abs() < ROUNDING { 0.0 } else { value };
    let sign = if value > 0.0 { "+" } else { "" };
    format!("{sign}{} {unit}", significant(value, 3))
}
