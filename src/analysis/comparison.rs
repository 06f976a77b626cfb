//! How far one case is from another that resolves the same specimen more finely.

use super::Findings;
use super::series::{Series, Setting};

/// Two specimens are the same when their lengths, loads and constants agree to this: meshes round alike, sweeps do not
/// step this finely.
const SAME: f64 = 1e-3;

/// Below this share of the common range of strain stresses are too small to be compared in percent.
pub const FROM_SHARE: f64 = 0.25;

/// A case as the comparison sees it.
#[derive(Clone, Copy)]
pub struct Candidate<'a> {
    pub series: &'a Series,
    pub setting: &'a Setting,
    pub findings: &'a Findings,
    /// What else two runs of the same specimen must have in common, in words.
    pub conditions: &'a str,
}

/// Differences of one case from its reference, relative (0.01 is 1 %).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// Largest difference of sigma_yy at equal strain, over the reference's stress there.
    pub stress: Option<f64>,
    /// Strain up to which stresses were compared: the earliest initiation among the cases of the specimen.
    pub up_to_strain: Option<f64>,
    pub initiation_strain: Option<f64>,
    /// Mean difference of the speed, without sign, at equal strain while both run, over the reference's mean speed.
    pub speed: Option<f64>,
    /// Largest difference of the measured arrivals of waves that both have.
    pub arrival: Option<f64>,
    /// Of the stress intensity of the J-integral at initiation.
    pub stress_intensity: Option<f64>,
}

/// For each case the one that it is measured against: of those with the same specimen and loading, the one with the
/// most nodes (the first of equals). A case has itself when it is the reference of others, and `None` when alone.
pub fn references(cases: &[Option<Candidate>]) -> Vec<Option<usize>> {
    let alike = |a: &Candidate, b: &Candidate| a.conditions == b.conditions && same_specimen(a.setting, b.setting);
    cases
        .iter()
        .map(|case| {
            let case = case.as_ref()?;
            let group = cases
                .iter()
                .enumerate()
                .filter_map(|(index, other)| Some((index, other.as_ref()?)));
            let group: Vec<_> = group.filter(|(_, other)| alike(case, other)).collect();
            let finest = group.iter().rev().max_by_key(|(_, other)| other.setting.nodes)?;
            (group.len() > 1).then_some(finest.0)
        })
        .collect()
}

/// The earliest initiation strain among the cases that share a reference.
pub fn earliest_initiation(cases: &[Option<Candidate>], references: &[Option<usize>], group: usize) -> Option<f64> {
    let members = cases
        .iter()
        .zip(references)
        .filter(|(_, reference)| **reference == Some(group));
    let strains = members.filter_map(|(case, _)| Some(case.as_ref()?.findings.initiation?.strain));
    strains.min_by(f64::total_cmp)
}

/// One case against its reference. `earliest` is from [`earliest_initiation`].
pub fn difference(case: Candidate, reference: Candidate, earliest: Option<f64>) -> Difference {
    let end = |series: &Series| series.probes.last().map(|row| row.strain);
    let up_to = [end(case.series), end(reference.series), earliest]
        .into_iter()
        .flatten()
        .min_by(f64::total_cmp);
    let start = |candidate: Candidate| candidate.findings.initiation.map(|start| start.strain);
    Difference {
        stress: up_to.and_then(|strain| stress_difference(case.series, reference.series, strain)),
        up_to_strain: up_to,
        initiation_strain: start(case).zip(start(reference)).map(|(own, other)| own / other - 1.0),
        speed: speed_difference(case, reference),
        arrival: arrival_difference(case.findings, reference.findings),
        stress_intensity: {
            let value = |findings: &Findings| findings.from_j.map(|j| j.value);
            value(case.findings)
                .zip(value(reference.findings))
                .map(|(own, other)| own / other - 1.0)
        },
    }
}

fn stress_difference(case: &Series, reference: &Series, up_to: f64) -> Option<f64> {
    let curve: Vec<(f64, f64)> = case.probes.iter().map(|row| (row.strain, row.sigma_yy)).collect();
    let range = FROM_SHARE * up_to..=up_to;
    let rows = reference
        .probes
        .iter()
        .filter(|row| range.contains(&row.strain) && row.sigma_yy != 0.0);
    let differences = rows.filter_map(|row| Some((interpolate(&curve, row.strain)? / row.sigma_yy - 1.0).abs()));
    differences.max_by(f64::total_cmp)
}

fn arrival_difference(case: &Findings, reference: &Findings) -> Option<f64> {
    let differences = reference.arrivals.iter().filter_map(|expected| {
        let same = case
            .arrivals
            .iter()
            .find(|own| (own.wave, own.face) == (expected.wave, expected.face))?;
        Some((same.measured? / expected.measured? - 1.0).abs())
    });
    differences.max_by(f64::total_cmp)
}

fn speed_difference(case: Candidate, reference: Candidate) -> Option<f64> {
    let curve = |candidate: Candidate| -> Vec<(f64, f64)> {
        let rows = candidate.series.probes.iter().zip(&candidate.findings.speeds);
        rows.filter_map(|(row, speed)| Some((row.strain, speed.as_ref()?.value)))
            .collect()
    };
    let (own, other) = (curve(case), curve(reference));
    let both = other
        .iter()
        .filter_map(|&(strain, speed)| Some((interpolate(&own, strain)?, speed)));
    let (misfit, total) = both.fold((0.0, 0.0), |sum, (own, other)| {
        (sum.0 + (own - other).abs(), sum.1 + other)
    });
    (total > 0.0).then(|| misfit / total)
}

/// Linear between the points of a curve with ascending x; `None` outside.
fn interpolate(curve: &[(f64, f64)], x: f64) -> Option<f64> {
    let after = curve.partition_point(|point| point.0 < x);
    let right = curve.get(after)?;
    if right.0 == x {
        return Some(right.1);
    }
    let left = curve.get(after.checked_sub(1)?)?;
    Some(left.1 + (right.1 - left.1) * (x - left.0) / (right.0 - left.0))
}

fn same_specimen(a: &Setting, b: &Setting) -> bool {
    let numbers = |setting: &Setting| {
        [
            setting.spacing,
            setting.length,
            setting.height,
            setting.notch()[0],
            setting.notch()[1],
            setting.strain_rate,
            setting.thickness,
            setting.longitudinal_speed,
            setting.fracture_energy,
        ]
    };
    let close = |(a, b): (f64, f64)| (a - b).abs() <= SAME * a.abs().max(b.abs());
    numbers(a).into_iter().zip(numbers(b)).all(close)
}
