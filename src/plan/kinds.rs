//! Slabs and solids in one study, and what only the report of slabs has.

use super::PlannedCase;
use super::duplicates::Origin;
use crate::study::{Finding, Findings, Study};

/// A report is of slabs or of solids; that of solids has no parts that speak of one crack along a line.
pub fn refuse(study: &Study, cases: &[PlannedCase], origins: &[Origin], findings: &Findings) {
    let is_solid = |case: &PlannedCase| case.case.solid().is_some();
    let Some(first) = cases.first() else { return };
    let mut both = cases.iter().zip(origins);
    if let Some((other, (_, place))) = both.find(|(case, _)| is_solid(case) != is_solid(first)) {
        let kind = |case: &PlannedCase| if is_solid(case) { "solid" } else { "slab" };
        let message = format!(
            "`{}` is a {} and `{}` a {}: nothing of the two can be compared",
            first.name,
            kind(first),
            other.name,
            kind(other)
        );
        findings.add(Finding::at(*place, message).help("make a study of each kind"));
    }
    if !is_solid(first) {
        return;
    }
    let report = study.content.report.right();
    let parts = report.map(|report| {
        [
            ("stages", report.stages.place()),
            ("beside", report.beside.place()),
            ("side-by-side", report.side_by_side.place()),
        ]
    });
    for (part, place) in parts.into_iter().flatten() {
        if let Some(place) = place {
            let message = format!("`report.{part}` is for slabs: the report of solids sets all cases side by side");
            findings.add(Finding::at(place, message).help("leave it out"));
        }
    }
}
