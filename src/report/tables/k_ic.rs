//! The stress intensity at initiation by every definition, side by side.

use polars::prelude::Column;

use crate::analysis::series::{Probe, Setting};
use crate::analysis::stress_intensity::Refusal;
use crate::analysis::stress_intensity::handbook::{self, Grips};
use crate::plan::{self, Comparison};
use crate::report::Analysed;
use crate::report::table::Rows;
use crate::report::units::MEGAPASCAL_ROOT_METRE;

/// One way to say what K is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Definition {
    NearTip,
    JIntegral,
    EnergyBalance,
    BetweenGrips,
    UnderStress,
    Griffith,
}

impl Definition {
    pub const ALL: [Definition; 6] = [
        Self::NearTip,
        Self::JIntegral,
        Self::EnergyBalance,
        Self::BetweenGrips,
        Self::UnderStress,
        Self::Griffith,
    ];

    pub fn column(self) -> &'static str {
        match self {
            Self::NearTip => "k_near_tip_mpa_sqrt_m",
            Self::JIntegral => "k_j_integral_mpa_sqrt_m",
            Self::EnergyBalance => "k_energy_balance_mpa_sqrt_m",
            Self::BetweenGrips => "k_between_grips_mpa_sqrt_m",
            Self::UnderStress => "k_under_stress_mpa_sqrt_m",
            Self::Griffith => "k_griffith_mpa_sqrt_m",
        }
    }

    pub fn words(self) -> &'static str {
        match self {
            Self::NearTip => "the fit of the field near the tip",
            Self::JIntegral => "the J-integral",
            Self::EnergyBalance => "the energy stored ahead of a long crack",
            Self::BetweenGrips => "the geometry factor for moving grips",
            Self::UnderStress => "the geometry factor for a uniform stress, put to the stress on the grips",
            Self::Griffith => "Griffith's balance with the surface energy",
        }
    }

    /// Why it gives no number, where that is known.
    pub fn refused(self, case: &Analysed) -> Option<Refusal> {
        match self {
            Self::NearTip => case.findings.near_tip_refused,
            Self::JIntegral => case.findings.from_j_refused,
            Self::BetweenGrips | Self::UnderStress => {
                let (setting, _) = at_initiation(case)?;
                setting.is_crack_inside().then_some(Refusal::NotFromAnEdge)
            }
            Self::EnergyBalance | Self::Griffith => None,
        }
    }

    /// MPa sqrt(m); `None` where there is no crack that started, and where the definition takes the moduli of the lattice and
    /// the specimen has others.
    pub fn value(self, case: &Analysed) -> Option<f64> {
        let findings = &case.findings;
        let value = match self {
            Self::EnergyBalance | Self::BetweenGrips if case.is_nodal() => return None,
            Self::NearTip => findings.near_tip?.value,
            Self::JIntegral => findings.from_j?.value,
            Self::EnergyBalance => {
                let (setting, probe) = at_initiation(case)?;
                handbook::of_stored_energy(setting, probe.strain)
            }
            Self::BetweenGrips => {
                let (setting, probe) = at_initiation(case)?;
                handbook::between_grips(setting, grips(case)?, probe.strain)?
            }
            Self::UnderStress => {
                let (setting, probe) = at_initiation(case)?;
                handbook::under_stress(setting, probe.grip_stress)?
            }
            Self::Griffith => findings.griffith?,
        };
        Some(value * MEGAPASCAL_ROOT_METRE)
    }
}

/// Why definitions give no number: `the J-integral: there is no room for rings …`.
fn reasons(case: &Analysed) -> Option<String> {
    let reason = |definition: Definition| Some(format!("{}: {}", definition.words(), definition.refused(case)?));
    let reasons: Vec<String> = Definition::ALL.into_iter().filter_map(reason).collect();
    (!reasons.is_empty()).then(|| reasons.join("; "))
}

/// The specimen, and the last probe before the crack starts.
fn at_initiation<'a>(case: &'a Analysed) -> Option<(&'a Setting, &'a Probe)> {
    let probe = case.findings.initiation?.probe.checked_sub(1)?;
    Some((case.result.setting.as_ref()?, case.result.series.probes.get(probe)?))
}

fn grips(case: &Analysed) -> Option<Grips> {
    let chosen = case.result.choices.iter().find(|(key, _)| key == "specimen.grips")?;
    match chosen.1.as_str() {
        "clamped" => Some(Grips::Clamped),
        "sliding" => Some(Grips::Sliding),
        _ => None,
    }
}

/// What the source of a comparison says, MPa sqrt(m).
pub fn reference(case: &Analysed, comparisons: &[Comparison]) -> Option<f64> {
    plan::reference(comparisons, "k_ic", "k_ic_reference_mpa_sqrt_m", case.name(), &[])
}

pub fn columns(cases: &[Analysed], comparisons: &[Comparison]) -> Vec<Column> {
    let rows = Rows(cases.iter().collect());
    let mut columns = vec![rows.text("case", |case: &&Analysed| case.name())];
    columns.extend(Definition::ALL.map(|definition| rows.number(definition.column(), |case| definition.value(case))));
    columns.push(rows.number("k_ic_reference_mpa_sqrt_m", |case| reference(case, comparisons)));
    let reasons: Vec<Option<String>> = rows.0.iter().map(|case| reasons(case)).collect();
    columns.push(Column::new("reasons".into(), reasons));
    columns
}
