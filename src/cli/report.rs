mod gather;
mod others;

use std::path::PathBuf;

use serde_json::json;

use super::CliError;
use super::survey::{self, OfResults, Survey};
use super::terminal::{self, Terminal};
use crate::durable;
use crate::report;
use crate::store::{Program, State};
use others::Other;

/// `cgaft study report FILE`
pub fn rebuild_report(arguments: &OfResults) -> Result<u8, CliError> {
    let mut survey = survey::survey(&arguments.common.study, &arguments.place.results)?;
    survey.store.prepare()?;
    let Built { path, damaged } = rebuild(&mut survey)?;
    let json = json!({ "study": survey.plan.study, "report": path });
    let terminal = Terminal {
        quiet: false,
        json: arguments.common.json,
    };
    terminal.result(&json, || format!("report: {}\n", path.display()))?;
    Ok(u8::from(damaged))
}

/// A report that is up to date.
pub struct Built {
    pub path: PathBuf,
    /// A case is not in it because its published files were found to be damaged.
    pub damaged: bool,
}

/// Builds the report unless it is there and tells of exactly these runs.
pub fn bring_up_to_date(survey: &mut Survey) -> Result<Built, CliError> {
    let path = survey.store.root().join("report.html");
    let others = others::survey(survey);
    let current = durable::read_to_string(&stamp_path(survey)).is_ok_and(|stamp| stamp == fingerprint(survey, &others));
    if current && path.exists() {
        let damaged = survey.damaged().next().is_some();
        Ok(Built { path, damaged })
    } else {
        rebuild_beside(survey, &others)
    }
}

fn rebuild(survey: &mut Survey) -> Result<Built, CliError> {
    let others = others::survey(survey);
    rebuild_beside(survey, &others)
}

fn rebuild_beside(survey: &mut Survey, others: &[Other]) -> Result<Built, CliError> {
    let _lock = survey.store.lock_report()?;
    // A kill while the report is built leaves no stamp that fits.
    stamp(survey, "")?;
    survey.verify();
    let mut damaged = false;
    for (case, why) in survey.damaged() {
        damaged = true;
        terminal::warn(&format!("{case}: damaged: {why}; `cgaft study run` computes it again"));
    }
    let path = build(survey, others)?;
    stamp(survey, &fingerprint(survey, others))?;
    Ok(Built { path, damaged })
}

fn stamp(survey: &Survey, fingerprint: &str) -> Result<(), CliError> {
    let path = stamp_path(survey);
    durable::write(&path, fingerprint).map_err(|source| CliError::Output {
        what: path.display().to_string(),
        source,
    })
}

fn stamp_path(survey: &Survey) -> PathBuf {
    survey.store.root().join(".report-of")
}

/// Changes with everything that the report shows: the study's text, what it compares with, the program, and what
/// became of each case, those of other studies too.
fn fingerprint(survey: &Survey, others: &[Other]) -> String {
    let surveys = others.iter().filter_map(|other| other.survey.as_ref().ok());
    let entries = std::iter::once(survey)
        .chain(surveys)
        .flat_map(|survey| &survey.entries);
    let endings: Vec<_> = entries
        .map(|entry| match &entry.state {
            State::Done(manifest) => (&entry.planned.name, &entry.id, "done", Some(manifest.ended)),
            State::Failed(failure) => (&entry.planned.name, &entry.id, "failed", Some(failure.ended)),
            other => (&entry.planned.name, &entry.id, other.word(), None),
        })
        .collect();
    let all = json!([
        Program::current(),
        survey.plan.source(),
        survey.plan.comparisons,
        endings
    ]);
    blake3::hash(all.to_string().as_bytes()).to_hex().to_string()
}

/// Tables, figures and pages from the runs of the store: the one call to `report`.
fn build(survey: &Survey, others: &[Other]) -> Result<PathBuf, CliError> {
    let folder = survey.store.root();
    let others = others.iter().map(|other| other.gather(survey)).collect();
    report::write(&gather::gather(survey, others), folder)?;
    Ok(folder.join("report.html"))
}
