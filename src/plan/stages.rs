//! `report.stages`: a case that the report shows in pictures at strains of interest, and in motion.

use super::expansion::Draft;
use crate::study::{Finding, Findings, Given, Place, Study, suggestion};
use serde::Serialize;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stages {
    /// Name of the case.
    pub case: String,
    /// Nominal strains.
    pub strains: Vec<f64>,
}

/// `None` where the study asks for none, or does so wrongly.
pub fn resolve(study: &Study, drafts: &[Draft], findings: &Findings) -> Option<Stages> {
    let Given::Right(stages, place) = &study.content.report.right()?.stages else {
        return None;
    };
    let missing = |key: &str, example: &str| {
        let message = format!("`report.stages.{key}` is missing");
        findings.add(Finding::at(*place, message).help(format!("write `{key}: {example}`")));
    };
    let case = match &stages.of {
        Given::Right(case, at) => {
            if drafts.iter().all(|draft| draft.name != *case) {
                refuse_unknown(case, *at, drafts, findings);
            }
            Some(case.clone())
        }
        Given::Absent => {
            missing("of", "A");
            None
        }
        Given::Wrong(_) => None,
    };
    let strains = match &stages.strains {
        Given::Right(strains, _) => Some(
            strains
                .iter()
                .filter_map(|strain| Some(strain.right()?.value))
                .collect(),
        ),
        Given::Absent => {
            missing("strains", "[0.5 %, 1 %]");
            None
        }
        Given::Wrong(_) => None,
    };
    Some(Stages {
        case: case?,
        strains: strains?,
    })
}

/// Tells that no case has this name; where no case could be read at all, that has been told.
pub fn refuse_unknown(case: &str, at: Place, drafts: &[Draft], findings: &Findings) {
    if drafts.is_empty() {
        return;
    }
    let names: Vec<&str> = drafts.iter().map(|draft| draft.name.as_str()).collect();
    let message = format!("the study has no case `{case}`");
    findings.add(Finding::at(at, message).help(suggestion(case, &names)));
}
