use serde_json::json;

use super::survey::{self, Entry, OfResults, Survey};
use super::terminal::Terminal;
use super::{CliError, format};
use crate::store::{Manifest, State};

/// `cgaft study status FILE`
pub fn status(arguments: &OfResults) -> Result<u8, CliError> {
    let survey = survey::survey(&arguments.common.study, &arguments.place.results)?;
    let cases: Vec<_> = survey.entries.iter().map(Entry::to_json).collect();
    let json = json!({ "study": survey.plan.study, "results": survey.store.root(), "cases": cases });
    let terminal = Terminal {
        quiet: false,
        json: arguments.common.json,
    };
    terminal.result(&json, || words(&survey))?;
    Ok(0)
}

fn words(survey: &Survey) -> String {
    let rows: Vec<_> = survey
        .entries
        .iter()
        .map(|entry| {
            vec![
                entry.planned.name.clone(),
                entry.word().to_owned(),
                detail(survey, entry),
            ]
        })
        .collect();
    let done = survey
        .entries
        .iter()
        .filter(|entry| matches!(entry.state, State::Done(_)))
        .count();
    format!(
        "{}\n{} of {} cases done in {}\n",
        format::list(&rows),
        done,
        rows.len(),
        survey.store.root().display()
    )
}

/// `2 threads`, `4 ranks of 1 thread`
fn crew(manifest: &Manifest) -> String {
    let threads = format::count(manifest.threads as usize, "thread");
    match manifest.ranks {
        1 => threads,
        ranks => format!("{ranks} ranks of {threads}"),
    }
}

fn detail(survey: &Survey, entry: &Entry) -> String {
    match &entry.state {
        State::Done(manifest) => format!(
            "{}; {} on {}, {}",
            manifest.outcome.end_reason,
            format::duration(manifest.wall_seconds),
            crew(manifest),
            manifest.ended.strftime("%F %R UTC")
        ),
        State::Failed(_) => {
            format!(
                "{}; log in {}",
                entry.reason,
                survey.store.partial_folder(&entry.id).join("log.txt").display()
            )
        }
        _ => entry.reason.clone(),
    }
}
