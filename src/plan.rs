//! A study becomes a list of cases, each with a name, every choice made, and an identity.

mod difference;
mod expansion;
mod identity;
mod name;
mod range;
mod spelling;
mod starter;
mod sweep;
mod write;

pub use difference::explain_difference;
pub use identity::CaseId;
pub use spelling::spelled;
pub use starter::starter;
pub use write::write_case;

use crate::study::{Finding, Findings, Given, Place, Study, StudyError, Table, case::Case, resolve};
use std::collections::HashMap;

/// What is to be computed, in the order of the study file.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Name of the study: one folder of results.
    pub study: String,
    pub question: Option<String>,
    /// Headline of the report.
    pub title: Option<String>,
    /// What to compare with: quantity and file, as written in the study.
    pub compare: Vec<(String, String)>,
    /// The study file as it was named, and its text.
    pub file: String,
    pub source: String,
    pub cases: Vec<PlannedCase>,
}

/// One case, every choice made.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedCase {
    /// Unique in its study and fit to be a file name: `B`, `B-element-10`.
    pub name: String,
    pub case: Case,
    /// The tables it was made for. All are always written; no part of its identity.
    pub tables: Vec<Table>,
    pub id: CaseId,
}

/// Expand a study into its cases. All mistakes of the file, those of reading it too, come back at once.
pub fn plan(study: &Study) -> Result<Plan, StudyError> {
    let content = &study.content;
    let findings = &study.findings.clone();
    let name = study_name(study, findings);
    let mut cases = Vec::new();
    // Names end up as folders, and not every file system tells B from b.
    let mut places: HashMap<String, Place> = HashMap::new();
    let drafts = expansion::expand(content, findings);
    let number = drafts.len();
    for draft in drafts {
        if let Some(first) = places.insert(draft.name.to_lowercase(), draft.place) {
            let message = format!("two cases would be called `{}`", draft.name);
            findings.add(
                Finding::at(draft.place, message)
                    .with(first, "the other one")
                    .help("rename or remove one of them"),
            );
        }
        if let Some(resolved) = resolve(&draft.values, &draft.name, findings) {
            let id = CaseId::of(&resolved.case);
            cases.push(PlannedCase {
                name: draft.name,
                case: resolved.case,
                tables: resolved.tables,
                id,
            });
        }
    }
    findings.forget_common_cases(number);
    if !findings.is_empty() {
        return Err(Study {
            findings: findings.clone(),
            ..study.clone()
        }
        .error());
    }
    let text = |given: &Given<String>| given.right().map(|text| text.trim().to_owned());
    let compare = content.compare.right().map_or([].as_slice(), |compare| &compare.0);
    Ok(Plan {
        study: name,
        question: text(&content.question),
        title: content.report.right().and_then(|report| text(&report.title)),
        compare: compare
            .iter()
            .filter_map(|(name, file)| Some((name.text.clone(), file.right()?.clone())))
            .collect(),
        file: study.file.clone(),
        source: study.text.to_string(),
        cases,
    })
}

fn study_name(study: &Study, findings: &Findings) -> String {
    match &study.content.study {
        Given::Right(text, place) => {
            name::check(text, *place, "study", findings);
            text.clone()
        }
        Given::Wrong(_) => String::new(),
        Given::Absent => {
            let missing = Finding::at(study.start, "the study has no name").help("write `study: my-study`");
            findings.add(missing);
            String::new()
        }
    }
}

#[cfg(test)]
mod tests;
