//! A study becomes a list of cases, each with a name, every choice made, and an identity.

mod compared;
mod comparison;
mod difference;
mod draft;
mod duplicates;
mod expansion;
mod figures;
mod identity;
mod kinds;
mod label;
mod name;
mod named_cases;
mod range;
mod repeats;
mod scaling;
mod side_by_side;
mod spelling;
mod stages;
mod starter;
mod sweep;
mod swept;
mod write;

pub use compared::{COMPARED, Compared, SCALING};
pub use comparison::{Comparison, Expected, reference};
pub use difference::explain_difference;
pub use identity::{CaseId, RunId};
pub use side_by_side::SideBySide;
pub use spelling::spelled;
pub use stages::Stages;
pub use starter::starter;
pub use swept::{Swept, SweptValue};
pub use write::write_case;

use crate::study::{
    self, CaseFile, Finding, Findings, Given, Growth, Place, Refusal, Study, StudyError, Table, case::Case,
    cluster::Cluster, resolve,
};
use std::collections::HashMap;

/// What is to be computed, in the order of the study file.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Name of the study: one folder of results.
    pub study: String,
    pub question: Option<String>,
    /// Headline of the report.
    pub title: Option<String>,
    /// Width of the figures as files of their own, nm.
    pub figure_width: Option<f64>,
    /// The case to be shown in pictures, and at which strains.
    pub stages: Option<Stages>,
    /// Where the cases are to show what ranks gain: what becomes of the specimen meanwhile.
    pub scaling: Option<Growth>,
    /// What the results are to be compared with.
    pub comparisons: Vec<Comparison>,
    /// Other studies whose cases stand beside those of the same name here.
    pub beside: Vec<String>,
    pub side_by_side: Vec<SideBySide>,
    pub cases: Vec<PlannedCase>,
    /// What its jobs get on a cluster.
    pub cluster: Cluster,
    /// The study as read, and its cases as typed: where a refusal points.
    read: Study,
    typed: HashMap<String, Given<CaseFile>>,
}

/// One case, every choice made.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedCase {
    /// Unique in its study and fit to be a file name: `B`, `B-element-10`.
    pub name: String,
    pub case: Case,
    /// The tables it was made for. All are always written; no part of its identity.
    pub tables: Vec<Table>,
    /// Of its run.
    pub id: RunId,
    /// The name that the sweep started from; its own where there is no sweep.
    pub origin: String,
    /// What the sweep has set in it, in the order of the sweep.
    pub swept: Vec<Swept>,
    /// The name of the case that it repeats with noise of its own.
    pub repeat_of: Option<String>,
}

/// Expand a study into its cases. All mistakes of the file, those of reading it too, come back at once.
pub fn plan(study: &Study) -> Result<Plan, StudyError> {
    let content = &study.content;
    let findings = &study.findings.clone();
    let name = study_name(study, findings);
    let mut cases = Vec::new();
    let mut origins = Vec::new();
    let mut typed = HashMap::new();
    // Names end up as folders, and not every file system tells B from b.
    let mut places: HashMap<String, Place> = HashMap::new();
    let drafts = expansion::expand(content, findings);
    let number = drafts.len();
    let comparisons = comparison::read(study, &drafts, findings);
    let stages = stages::resolve(study, &drafts, findings);
    let figure_width = figures::width(study, findings);
    let beside = side_by_side::others(study, findings);
    let side_by_side = side_by_side::resolve(study, &drafts, findings);
    let cluster = study::cluster::resolve(&content.cluster, findings);
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
            let id = RunId::of(&resolved.case);
            typed.insert(draft.name.clone(), draft.values);
            origins.push((draft.origin.clone(), draft.place));
            cases.push(PlannedCase {
                name: draft.name,
                case: resolved.case,
                tables: resolved.tables,
                id,
                origin: draft.origin,
                swept: draft.swept,
                repeat_of: draft.repeat_of,
            });
        }
    }
    let scaling = scaling::resolve(study, &cases, findings);
    scaling::tell_apart(&mut cases, scaling);
    if content.sweep.right().is_some() {
        duplicates::refuse(&cases, &origins, findings);
    }
    kinds::refuse(study, &cases, &origins, findings);
    findings.forget_common_cases(number);
    if !findings.is_empty() {
        return Err(study.error(findings));
    }
    let text = |given: &Given<String>| given.right().map(|text| text.trim().to_owned());
    Ok(Plan {
        study: name,
        question: text(&content.question),
        title: content.report.right().and_then(|report| text(&report.title)),
        figure_width,
        stages,
        scaling,
        comparisons,
        beside,
        side_by_side,
        cases,
        cluster,
        read: study.clone(),
        typed,
    })
}

/// Read a file of one case, such as [`write_case`] makes.
pub fn read_case(path: &str) -> Result<Plan, StudyError> {
    let plan = plan(&study::read(path)?)?;
    if plan.cases.len() == 1 {
        return Ok(plan);
    }
    let message = format!("a run needs a file of one case, and this one has {}", plan.cases.len());
    Err(plan.error([Finding::whole(message).help("start it with `cgaft study run`")]))
}

impl Plan {
    /// The study file as it was named.
    pub fn file(&self) -> &str {
        &self.read.file
    }

    /// Its text.
    pub fn source(&self) -> &str {
        &self.read.text
    }

    /// Whether cases are compared by what computes them, so that each needs the machine for itself.
    pub fn compares_crews(&self) -> bool {
        self.cases.iter().any(|case| case.id != RunId::of(&case.case))
    }

    /// Refusals of cases, each with the name of its case, told at their places in the study file.
    pub fn refuse<'a>(&self, refusals: impl IntoIterator<Item = (&'a str, Refusal)>) -> StudyError {
        let typed = |case: &str| self.typed.get(case).cloned().unwrap_or_default();
        self.error(
            refusals
                .into_iter()
                .map(|(case, refusal)| refusal.finding(&typed(case)).case(case)),
        )
    }

    fn error(&self, found: impl IntoIterator<Item = Finding>) -> StudyError {
        let findings = Findings::default();
        found.into_iter().for_each(|finding| findings.add(finding));
        findings.forget_common_cases(self.cases.len());
        self.read.error(&findings)
    }
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
