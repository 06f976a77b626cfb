//! Other studies whose cases stand beside those of a study.

use std::path::Path;

use super::gather;
use crate::cli::CliError;
use crate::cli::survey::{self, Survey};
use crate::report::OtherStudy;
use crate::store::State;

/// Another study: its file, and what there is of it in the same folder of results.
pub struct Other {
    file: String,
    pub survey: Result<Survey, CliError>,
}

/// Looks at all that a study names. That one of them cannot be read is no failure of this one.
pub fn survey(survey: &Survey) -> Vec<Other> {
    let folder = Path::new(survey.plan.file()).parent().unwrap_or(Path::new(""));
    let results = survey.store.root().parent().unwrap_or(Path::new(""));
    let other = |name: &String| {
        let beside = folder.join(format!("{name}.yaml"));
        let file = match beside.exists() {
            true => beside.display().to_string(),
            // One that comes with the program is known by its name alone.
            false => format!("{name}.yaml"),
        };
        Other {
            survey: survey::survey(&file, results),
            file,
        }
    };
    survey.plan.beside.iter().map(other).collect()
}

impl Other {
    /// Its cases that have the name of one of `own`, and what is missing of them.
    pub fn gather(&self, own: &Survey) -> OtherStudy {
        let Ok(other) = &self.survey else {
            let file = &self.file;
            return OtherStudy {
                missing: Some(format!("{file}: cannot be read; `cgaft study check {file}` tells why.")),
                ..OtherStudy::default()
            };
        };
        let is_known = |name: &str| own.plan.cases.iter().any(|case| case.name == name);
        let alike = other.entries.iter().filter(|entry| is_known(&entry.planned.name));
        let (done, missing): (Vec<_>, Vec<_>) = alike.partition(|entry| matches!(entry.state, State::Done(_)));
        let names: Vec<&str> = missing.iter().map(|entry| entry.planned.name.as_str()).collect();
        OtherStudy {
            name: other.plan.study.clone(),
            cases: done.iter().map(|entry| gather::case_result(other, entry, false)).collect(),
            missing: (!names.is_empty()).then(|| {
                let (study, file) = (&other.plan.study, &self.file);
                let only: String = names.iter().map(|name| format!(" --only {name}")).collect();
                let results = other.store.root().parent().unwrap_or(Path::new("")).display();
                format!(
                    "{study}: no result of {} yet; `cgaft study run {file}{only} --results {results}` computes what is missing.",
                    names.join(", ")
                )
            }),
        }
    }
}
