//! Cases that differ in what computes them: their results are the same to the bit, and only their costs differ.

use super::{CaseId, PlannedCase, RunId};
use crate::study::{
    Finding, Findings, Given, Growth, Study,
    case::{Body, Case, solid::Shape},
};

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
        if !alike_but_for_growth(&case.case, &first.case, growth) {
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

/// Whether a case is so many times another, in its width or in the blocks along one axis, and nothing else differs.
fn alike_but_for_growth(case: &Case, other: &Case, growth: f64) -> bool {
    let mut alike = case.clone();
    match (&mut alike.body, &other.body) {
        (Body::Slab(slab), Body::Slab(other)) => {
            if (slab.specimen.width / (other.specimen.width * growth) - 1.0).abs() > SAME {
                return false;
            }
            slab.specimen.width = other.specimen.width;
        }
        (Body::Solid(solid), Body::Solid(other)) => {
            let blocks = |shape: Shape| match shape {
                Shape::Blocks(blocks) => blocks.iter().map(|&number| f64::from(number)).product(),
                Shape::Box { size, .. } => size.iter().product::<f64>(),
            };
            if (blocks(solid.specimen.shape) / (blocks(other.specimen.shape) * growth) - 1.0).abs() > SAME {
                return false;
            }
            solid.specimen.shape = other.specimen.shape;
        }
        _ => return false,
    }
    CaseId::of(&alike) == CaseId::of(other)
}
