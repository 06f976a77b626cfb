//! `report.beside` and `report.side-by-side`: what the report sets side by side.

use super::draft::Draft;
use super::name;
use super::named_cases::named_cases;
use crate::study::{Finding, Findings, Given, Name, SideBySideFile, Study};
use serde::Serialize;

/// Cases of a study side by side, and how near they must come to each other to agree.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SideBySide {
    pub name: String,
    /// Names of at least two cases; the others are measured against the first.
    pub cases: Vec<String>,
    /// Difference of the strains at initiation over that of the first.
    pub initiation_strain: Option<f64>,
    /// How much later after its start than the first a crack may branch, or earlier, ps.
    pub first_branch: Option<f64>,
}

/// The names of the other studies whose cases stand beside those of this one.
pub fn others(study: &Study, findings: &Findings) -> Vec<String> {
    let named = study.content.report.right().and_then(|report| report.beside.right());
    let mut others = Vec::new();
    for given in named.into_iter().flatten() {
        let Given::Right(other, place) = given else { continue };
        name::check(other, *place, "study", findings);
        if study.content.study.right() == Some(other) {
            let message = format!("`{other}` is this study, and stands beside itself already");
            findings.add(Finding::at(*place, message).help("name another study, or cases below `side-by-side`"));
        }
        others.push(other.clone());
    }
    others
}

/// Cases of this study side by side.
pub fn resolve(study: &Study, drafts: &[Draft], findings: &Findings) -> Vec<SideBySide> {
    let given = study
        .content
        .report
        .right()
        .and_then(|report| report.side_by_side.right());
    let sets = given.map_or([].as_slice(), |sets| &sets.0);
    let read = |(name, given): &(Name, Given<SideBySideFile>)| Some(set(name, given.right()?, drafts, findings));
    sets.iter().filter_map(read).collect()
}

fn set(name: &Name, typed: &SideBySideFile, drafts: &[Draft], findings: &Findings) -> SideBySide {
    let cases = named_cases(&typed.cases, drafts, findings);
    let few = |given: &Vec<Given<String>>| given.len() < 2 && cases.len() < 2;
    if matches!(typed.cases, Given::Absent) || typed.cases.right().is_some_and(few) {
        let message = format!("`{}` sets no two cases side by side", name.text);
        findings.add(Finding::at(name.place, message).help("write for example `cases: [A, B]`"));
    }
    let agree = typed.agree.right();
    SideBySide {
        name: name.text.clone(),
        cases,
        initiation_strain: agree.and_then(|agree| Some(agree.initiation_strain.right()?.value)),
        first_branch: agree.and_then(|agree| Some(agree.first_branch.right()?.value)),
    }
}
