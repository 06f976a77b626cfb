//! Cases that differ in what computes them: their results are the same to the bit, and only their costs differ.

use super::{CaseId, PlannedCase, RunId};
use crate::study::{Finding, Findings, Given, Growth, Study, case::Case};

/// Widths that belong to as many ranks may differ by this, relative: meshes round them to whole rows.
const SAME: f64 = 0.01;

/// Gives every case a run of its own that differs from another in ranks or threads alone; in a study of scaling every one.
pub fn tell_apart(cases: &mut [PlannedCase], scaling: Option<Growth>) {
    let crew = |case: &PlannedCase| (case.case.execution.ranks, case.case.execution.threads);
    let known: Vec<_> = cases.iter().map(|case| (case.id.case, crew(case))).collect();
    for case in cases {
        let own = crew(case);
        let is_compared = known.iter().any(|&(id, other)| id == case.id.case && other != own);
        if is_compared || scaling.is_some() {
            case.id = RunId {
                ranks: own.0,
                threads: own.1,
                ..case.id
            };
        }
    }
}

/// What `report.scaling` asks for; that the cases do not fit it goes to `findings`.
pub fn resolve(study: &Study, cases: &[PlannedCase], findings: &Findings) -> Option<Growth> {
    let Given::Right(growth, place) = study.content.report.right()?.scaling else {
        return None;
    };
    let refuse = |message: String, help: &str| findings.add(Finding::at(place, message).help(help));
    let first = cases.first()?;
    for case in cases {
        let name = &case.name;
        let Some(ranks) = case.case.execution.ranks else {
            let message = format!("this compares numbers of ranks, and `{name}` does not say how many it has");
            refuse(
                message,
                "sweep `run.ranks: [1, 2]`, or give each case its `run: {ranks: …}`",
            );
            continue;
        };
        let Some(ranks_of_first) = first.case.execution.ranks else {
            continue;
        };
        let growth = growth.with(ranks) / growth.with(ranks_of_first);
        let width = first.case.specimen.width * growth;
        if (case.case.specimen.width / width - 1.0).abs() > SAME || !alike_but_for_width(&case.case, &first.case) {
            let message = format!("`{name}` and `{}` are not alike but for their ranks", first.name);
            refuse(
                message,
                "with `scaling: fixed` let nothing differ but `run.ranks`; with `scaling: scaled` the width as well, such as \
                 `sweep: {zip: {run.ranks: [1, 2], specimen.width: [177 nm, 354 nm]}}`",
            );
        }
    }
    Some(growth)
}

fn alike_but_for_width(case: &Case, other: &Case) -> bool {
    let mut case = case.clone();
    case.specimen.width = other.specimen.width;
    CaseId::of(&case) == CaseId::of(other)
}
