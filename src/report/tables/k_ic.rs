//! The stress intensity at initiation by every definition, side by side.

use polars::prelude::Column;

use crate::analysis::series::{Probe, RINGS, Setting};
use crate::analysis::stress_intensity::handbook::{self, Grips};
use crate::analysis::stress_intensity::{
    FROM_ELEMENTS, FROM_SPACINGS, LEAST_GRIFFITH_SHARE, MOST_CORRECTION, MOST_ERROR_SHARE, MOST_RING_SHARE,
    RING_CLEAR_SHARE, RING_ELEMENTS, RING_SPACINGS, Refusal, TO_SHARE,
};
use crate::plan::{self, Comparison};
use crate::report::Analysed;
use crate::report::numbers::{mean, signed_percent, significant};
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

/// Which definition of K comes nearest to the source's values.
pub fn agreement(cases: &[Analysed], comparisons: &[Comparison]) -> Option<String> {
    let offs = |definition: Definition| -> Vec<f64> {
        let pairs = cases
            .iter()
            .filter_map(|case| definition.value(case).zip(reference(case, comparisons)));
        pairs.map(|(own, other)| own / other - 1.0).collect()
    };
    let mut found: Vec<(Definition, Vec<f64>)> = Definition::ALL
        .map(|definition| (definition, offs(definition)))
        .into_iter()
        .filter(|(_, offs)| !offs.is_empty())
        .collect();
    let size = |offs: &[f64]| mean(&offs.iter().map(|off| off.abs()).collect::<Vec<f64>>());
    found.sort_by(|a, b| size(&a.1).total_cmp(&size(&b.1)));
    let (nearest, others) = found.split_first()?;
    let others: Vec<String> = others
        .iter()
        .map(|(definition, offs)| format!("{} by {}", definition.words(), signed_percent(mean(offs))))
        .collect();
    let mut text = format!(
        "Nearest to the source comes {}, off by {} % on average ({} with sign).",
        nearest.0.words(),
        significant(100.0 * size(&nearest.1), 2),
        signed_percent(mean(&nearest.1))
    );
    if !others.is_empty() {
        text.push_str(&format!(" With sign and on average are off {}.", others.join(", ")));
    }
    text.extend(one_factor(cases, comparisons));
    Some(text)
}

/// Factors alike within this share are one factor.
const ONE_FACTOR: f64 = 0.03;

/// Whether one factor takes K near the tip to the source's value in all cases, as it does where only the definitions differ.
fn one_factor(cases: &[Analysed], comparisons: &[Comparison]) -> Option<String> {
    let factor = |case| Some(reference(case, comparisons)? / Definition::NearTip.value(case)?);
    let factors: Vec<f64> = cases.iter().filter_map(factor).collect();
    let mean = mean(&factors);
    let is_one = factors.len() > 2 && factors.iter().all(|factor| (factor / mean - 1.0).abs() < ONE_FACTOR);
    is_one.then(|| {
        format!(
            " The source's value is {} times that of the field near the tip in all {} cases, within {} %: the loads are the \
             same, and the definitions of K differ by a factor.",
            significant(mean, 3),
            factors.len(),
            significant(100.0 * ONE_FACTOR, 1)
        )
    })
}

/// What each definition means here, and when it is refused.
pub fn method() -> Vec<(&'static str, String)> {
    let percent = |share: f64| significant(share * 100.0, 3);
    vec![
        (
            "K near the tip",
            format!(
                "Least-squares fit of σyy √(2πr) = K (1 + c r) at the last probe before initiation, from r = \
                 {FROM_SPACINGS} spacings (at least {FROM_ELEMENTS} element edges) to {} % of the crack length, the \
                 ligament or the height, whichever is smallest; ± is the standard error of the fit alone. Refused where K is not positive, where \
                 that error is above {} % of K, and where c r is above {MOST_CORRECTION} at the end of the range.",
                percent(TO_SHARE),
                percent(MOST_ERROR_SHARE)
            ),
        ),
        (
            "K of the J-integral",
            format!(
                "√(EJ) at the same probe, J being the energy that the field around the tip would give for its advance: \
                 the domain integral with finite strain and inertia, in {RINGS} rings side by side that reach to at most \
                 {RING_SPACINGS} spacings (at least {RING_ELEMENTS} element edges), and to at most {} % of the way to the nearest \
                 edge or grip. The value is the mean of the rings; they agree to half of the range between \
                 them, which is no uncertainty of K. Refused where they agree to no better than {} %, and below {} % of Griffith's K: \
                 a crack that sets out gets what its surfaces cost. Waves that pass the tip let J itself swing by some percent \
                 within picoseconds, in all rings alike. Absent where there is no room for rings.",
                percent(RING_CLEAR_SHARE),
                percent(MOST_RING_SHARE),
                percent(LEAST_GRIFFITH_SHARE)
            ),
        ),
        (
            "K of Griffith",
            "√(2γE) over the thickness, with the energy that the potential and its treatment at the cutoff need to \
             part a close-packed row, and the two-dimensional Young's modulus."
                .to_owned(),
        ),
        (
            "K of the energy balance",
            "√(E C H / 2) times the strain at the same probe, C being the stiffness of the uncracked slab and H its height: what \
             the slab holds far ahead of a long crack and gives up for its advance. Exact where crack and ligament are longer \
             than the height; a short crack has less."
                .to_owned(),
        ),
        (
            "K between grips",
            "F E ε √(πa) at the same probe, with the factor F of an edge crack between grips that move, from the static release \
             of energy of the lattice (`make verify`, single edge), linear between the geometries computed. Waves that the \
             loading itself has made are not in it."
                .to_owned(),
        ),
        (
            "K under stress",
            "F σ √(πa) with the handbook factor of an edge crack in a long strip under uniform stress (Tada), put to the stress on \
             the grips at the same probe: what one gets who takes moving grips for a stress. Up to several times too large, \
             because grips that stand still take load off a crack that is long for their distance."
                .to_owned(),
        ),
    ]
}
