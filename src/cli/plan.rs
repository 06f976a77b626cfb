use serde_json::json;

use super::CliError;
use super::run::{self, Arguments as RunArguments};
use super::survey::{self, OfResults};
use super::terminal::Terminal;
use crate::executor::launch;
use crate::store::State;

/// `cgaft study plan FILE`: every case, and the command that computes it.
pub fn plan(arguments: &OfResults) -> Result<u8, CliError> {
    show(&RunArguments::planning(
        arguments.common.clone(),
        arguments.place.clone(),
    ))
}

/// What `run` would do with these arguments; changes nothing.
pub fn show(arguments: &RunArguments) -> Result<u8, CliError> {
    let survey = survey::survey(&arguments.common.study, &arguments.place.results)?;
    let chosen = run::chosen(&survey, &arguments.only)?;
    let prepared = run::prepare(&survey, &chosen, arguments)?;
    let share = prepared.share;
    // A plan is worth showing before the solver is installed.
    let solver = launch::find_solver().unwrap_or_else(|_| "cgaft-solve".into());
    let mut words = String::new();
    let mut cases = Vec::new();
    for &position in &chosen {
        let entry = &survey.entries[position];
        let threads = entry
            .planned
            .case
            .execution
            .threads
            .filter(|_| arguments.threads.is_none());
        let folder = survey.store.partial_folder(&entry.id);
        let command = launch::launch(&solver, &folder, threads.unwrap_or(share.threads)).to_string();
        let runs = arguments.fresh || !matches!(entry.state, State::Done(_));
        let doing = if runs { "run" } else { "skip" };
        let reason = if runs && matches!(entry.state, State::Done(_)) {
            run::FRESH
        } else {
            &entry.reason
        };
        words.push_str(&format!("{}: {doing} ({reason})\n", entry.planned.name));
        if runs {
            words.push_str(&format!("    {command}\n"));
        }
        let mut case = entry.to_json();
        case["runs"] = json!(runs);
        case["reason"] = json!(reason);
        case["command"] = json!(command);
        cases.push(case);
    }
    words.push_str(&format!("\n{}\n", run::summary(prepared.jobs.len(), share)));
    if !prepared.jobs.is_empty() {
        words.push_str(
            "`study run` writes each case.yaml before it starts the command, and holds its standard input.\n",
        );
    }
    let json = json!({ "study": survey.plan.study, "jobs": share.jobs, "threads": share.threads, "cases": cases });
    Terminal {
        quiet: false,
        json: arguments.common.json,
    }
    .result(&json, || words)?;
    Ok(0)
}
