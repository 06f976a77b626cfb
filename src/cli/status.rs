use clap::Args;
use serde_json::json;

use super::survey::{self, Entry, OfResults, Survey};
use super::terminal::Terminal;
use super::{CliError, format};
use crate::store::{Manifest, State};

#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    pub of: OfResults,
    /// Read every published file and compare it with its checksum; exit code 1 if one is damaged
    #[arg(long)]
    pub verify: bool,
}

/// `cgaft study status FILE`
pub fn status(arguments: &Arguments) -> Result<u8, CliError> {
    let OfResults { common, place } = &arguments.of;
    let mut survey = survey::survey(&common.study, &place.results)?;
    if arguments.verify {
        survey.verify();
    }
    let cases: Vec<_> = survey.entries.iter().map(Entry::to_json).collect();
    let json = json!({ "study": survey.plan.study, "results": survey.store.root(), "cases": cases });
    let terminal = Terminal {
        quiet: false,
        json: common.json,
    };
    terminal.result(&json, || {
        let mut told = words(&survey);
        if arguments.verify {
            told += &verdict(&survey);
        }
        told
    })?;
    Ok(u8::from(arguments.verify && survey.damaged().next().is_some()))
}

/// What came of comparing content with checksums.
fn verdict(survey: &Survey) -> String {
    let done = |with_checksums: bool| {
        let is_meant = |entry: &&Entry| match &entry.state {
            State::Done(manifest) => manifest.blake3.is_empty() != with_checksums,
            _ => false,
        };
        survey.entries.iter().filter(is_meant).count()
    };
    let found = [
        (done(true), "as published, every byte"),
        (
            done(false),
            "of the right sizes; published before there were checksums, more is not known",
        ),
        (survey.damaged().count(), "damaged"),
    ];
    let told = found.iter().filter(|(count, _)| *count > 0);
    told.map(|(count, what)| format!("{}: {what}\n", format::count(*count, "case")))
        .collect()
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
        State::Corrupt { why } => format!("{why}; `cgaft study run` computes it again"),
        _ => entry.reason.clone(),
    }
}
