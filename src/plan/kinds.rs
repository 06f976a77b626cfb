//! Specimens of several kinds in one study, and what only the report of pulled slabs has.

use super::PlannedCase;
use super::duplicates::Origin;
use crate::study::case::{Body, Loading};
use crate::study::{Finding, Findings, Study};

/// What a report is of.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    PulledSlab,
    /// A slab that a pulse goes through.
    PulsedSlab,
    Solid,
}

impl Kind {
    fn of(case: &PlannedCase) -> Self {
        match &case.case.body {
            Body::Solid(_) => Self::Solid,
            Body::Slab(slab) => match slab.loading {
                Loading::StrainRate { .. } => Self::PulledSlab,
                Loading::Pulse { .. } => Self::PulsedSlab,
            },
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::PulledSlab => "slab",
            Self::PulsedSlab => "slab under a pulse",
            Self::Solid => "solid",
        }
    }
}

/// A report is of one kind; those of solids and of pulses have no parts that speak of one crack along a line.
pub fn refuse(study: &Study, cases: &[PlannedCase], origins: &[Origin], findings: &Findings) {
    let Some(first) = cases.first() else { return };
    let kind = Kind::of(first);
    let mut both = cases.iter().zip(origins);
    if let Some((other, (_, place))) = both.find(|(case, _)| Kind::of(case) != kind) {
        let message = format!(
            "`{}` is a {} and `{}` a {}: nothing of the two can be compared",
            first.name,
            kind.name(),
            other.name,
            Kind::of(other).name()
        );
        findings.add(Finding::at(*place, message).help("make a study of each kind"));
    }
    let others = match kind {
        Kind::PulledSlab => return,
        Kind::PulsedSlab => "pulses",
        Kind::Solid => "solids",
    };
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
            let message = format!("`report.{part}` is for slabs: the report of {others} sets all cases side by side");
            findings.add(Finding::at(place, message).help("leave it out"));
        }
    }
}
