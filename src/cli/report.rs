use std::fs;
use std::path::PathBuf;

use clap::Args;
use serde_json::{Value, json};

use super::CliError;
use super::survey::{self, Common, Entry, Place, Survey};
use super::terminal::Terminal;
use crate::store::{self, Program, State};
use crate::{plan, record, report};

#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub place: Place,
}

/// `cgaft study report FILE`
pub fn report(arguments: &Arguments) -> Result<u8, CliError> {
    let survey = survey::survey(&arguments.common.study, &arguments.place.results)?;
    survey.store.prepare()?;
    let path = rebuild(&survey)?;
    let json = json!({ "study": survey.plan.study, "report": path });
    let terminal = Terminal {
        quiet: false,
        json: arguments.common.json,
    };
    terminal.result(&json, || format!("report: {}\n", path.display()))?;
    Ok(0)
}

/// Builds the report unless it is there and tells of exactly these runs; where it is.
pub fn bring_up_to_date(survey: &Survey) -> Result<PathBuf, CliError> {
    let path = survey.store.root().join("report.html");
    let current = fs::read_to_string(stamp_path(survey)).is_ok_and(|stamp| stamp == fingerprint(survey));
    if current && path.exists() {
        Ok(path)
    } else {
        rebuild(survey)
    }
}

fn rebuild(survey: &Survey) -> Result<PathBuf, CliError> {
    let _lock = survey.store.lock_report()?;
    let path = build(survey)?;
    let stamp = stamp_path(survey);
    fs::write(&stamp, fingerprint(survey)).map_err(|source| CliError::Output {
        what: stamp.display().to_string(),
        source,
    })?;
    Ok(path)
}

fn stamp_path(survey: &Survey) -> PathBuf {
    survey.store.root().join(".report-of")
}

/// Changes with everything that the report shows: the study's text, the program, and what became of each case.
fn fingerprint(survey: &Survey) -> String {
    let endings: Vec<_> = survey
        .entries
        .iter()
        .map(|entry| match &entry.state {
            State::Done(manifest) => (&entry.planned.name, &entry.id, "done", Some(manifest.ended)),
            State::Failed(failure) => (&entry.planned.name, &entry.id, "failed", Some(failure.ended)),
            other => (&entry.planned.name, &entry.id, other.word(), None),
        })
        .collect();
    let all = json!([Program::current(), survey.plan.source, endings]);
    blake3::hash(all.to_string().as_bytes()).to_hex().to_string()
}

/// Tables, figures and pages from the runs of the store: the one call to `report`.
fn build(survey: &Survey) -> Result<PathBuf, CliError> {
    let cases = survey.entries.iter().map(|entry| result(survey, entry)).collect::<Result<_, _>>()?;
    let study = report::Study {
        name: survey.plan.study.clone(),
        title: survey.plan.title.clone(),
        question: survey.plan.question.clone(),
        text: survey.plan.source.clone(),
        cases,
    };
    report::write(&study, survey.store.root())?;
    Ok(survey.store.root().join("report.html"))
}

/// All there is of one case: its published run, or what a failed one left behind.
fn result(survey: &Survey, entry: &Entry) -> Result<report::CaseResult, CliError> {
    let planned = &entry.planned;
    let mut result = report::CaseResult {
        name: planned.name.clone(),
        id: entry.id.clone(),
        resolved: plan::write_case(planned),
        choices: choices(&plan::spelled(&planned.case), ""),
        manifest: report::Manifest { state: entry.state.word().to_owned(), ..report::Manifest::default() },
        ..report::CaseResult::default()
    };
    let folder = match &entry.state {
        State::Done(manifest) => {
            result.manifest = told(manifest);
            survey.store.run_folder(&entry.id)
        }
        State::Failed(failure) => {
            let reason = failure.meaning.clone();
            result.failure = Some(report::Failure { reason, log_tail: failure.log_tail.join("\n") });
            survey.store.partial_folder(&entry.id)
        }
        _ => return Ok(result),
    };
    let series = folder.join(record::SERIES_FILE);
    if series.exists() {
        let (setting, series) = record::read_series(&series)?;
        (result.setting, result.series) = (Some(setting), series);
    }
    let fields = folder.join(record::FIELDS_FILE);
    if fields.exists() {
        let (mesh, frames) = record::read_fields(&fields)?;
        let last = frames.times().len().checked_sub(1);
        result.last_frame = last.map(|last| frames.frame(last)).transpose()?.map(|frame| (mesh, frame));
    }
    Ok(result)
}

fn told(manifest: &store::Manifest) -> report::Manifest {
    let outcome = &manifest.outcome;
    let phase = |phase: &store::Phase| report::Phase {
        name: phase.name.clone(),
        calls: phase.calls,
        seconds: phase.seconds,
    };
    report::Manifest {
        state: "done".to_owned(),
        version: manifest.program.version.clone(),
        commit: manifest.program.commit.clone(),
        host: manifest.host.clone(),
        ranks: Some(manifest.ranks),
        threads: Some(manifest.threads),
        started: Some(manifest.started.to_string()),
        ended: Some(manifest.ended.to_string()),
        wall_seconds: Some(manifest.wall_seconds),
        end_reason: Some(outcome.end_reason.clone()),
        time_step: Some(outcome.time_step_ps),
        stability_limit: Some(outcome.stability_limit_ps),
        steps: Some(outcome.steps),
        energy_error: outcome.energy_error_relative,
        cost: outcome.cost.iter().map(phase).collect(),
    }
}

/// The leaves of a resolved case as dotted keys with their values.
fn choices(value: &Value, path: &str) -> Vec<(String, String)> {
    let Value::Object(map) = value else {
        let text = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        return vec![(path.to_owned(), text)];
    };
    let below = |(key, value)| {
        let path = if path.is_empty() { String::clone(key) } else { format!("{path}.{key}") };
        choices(value, &path)
    };
    map.iter().flat_map(below).collect()
}
