//! Lists in `report` that name cases of the study.

use super::draft::Draft;
use crate::study::{Finding, Findings, Given, Place, suggestion};

/// The cases that are named: of a sweep and of repeats all, by their name. Refuses what no case is called.
pub fn named_cases(given: &Given<Vec<Given<String>>>, drafts: &[Draft], findings: &Findings) -> Vec<String> {
    let mut cases = Vec::new();
    for given in given.right().into_iter().flatten() {
        let Given::Right(wanted, place) = given else { continue };
        let found = drafts.iter().filter(|draft| {
            let names = [Some(&draft.name), Some(&draft.origin), draft.repeat_of.as_ref()];
            names.contains(&Some(wanted))
        });
        let before = cases.len();
        cases.extend(found.map(|draft| draft.name.clone()));
        if cases.len() == before {
            refuse_unknown(wanted, *place, drafts, findings);
        }
    }
    cases
}

/// Where no case could be read at all, that has been told.
fn refuse_unknown(case: &str, at: Place, drafts: &[Draft], findings: &Findings) {
    if drafts.is_empty() {
        return;
    }
    let names: Vec<&str> = drafts.iter().map(|draft| draft.name.as_str()).collect();
    let message = format!("the study has no case `{case}`");
    findings.add(Finding::at(at, message).help(suggestion(case, &names)));
}
