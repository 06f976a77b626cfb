//! `report.stages`: cases that the report shows in pictures at strains of interest, the first of them in motion.

use super::draft::Draft;
use super::named_cases::named_cases;
use crate::study::{Finding, Findings, Given, Study};
use serde::Serialize;

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stages {
    /// Names of the cases.
    pub cases: Vec<String>,
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
    let cases = named_cases(&stages.cases, drafts, findings);
    if stages.cases.right().is_some_and(Vec::is_empty) || matches!(stages.cases, Given::Absent) {
        missing("cases", "[A]");
    }
    if matches!(stages.strains, Given::Absent) {
        missing("strains", "[0.5 %, 1 %]");
    }
    let strains = stages.strains.right()?.iter();
    let strains = strains.filter_map(|strain| Some(strain.right()?.value)).collect();
    (!cases.is_empty()).then_some(Stages { cases, strains })
}
