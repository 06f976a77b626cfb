use clap::Args;
use serde_json::json;

use super::prepare::{self, Arguments as RunArguments, CrewChoice, On};
use super::survey::{self, OfResults};
use super::terminal::Terminal;
use super::{CliError, cluster, warnings};
use crate::executor::launch;
use crate::executor::share::Crew;
use crate::store::State;

#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    pub of: OfResults,
    /// Show these cases only: names or patterns such as 'length-10nm*', with commas between them; may be given several times
    #[arg(long, value_name = "CASES", value_delimiter = ',')]
    pub only: Vec<String>,
    #[command(flatten)]
    pub crew: CrewChoice,
    /// Where the cases would be computed
    #[arg(long, value_enum, default_value = "local")]
    pub on: On,
}

/// `cgaft study plan FILE`: every case, and the command or the script that computes it.
pub fn plan(arguments: &Arguments) -> Result<u8, CliError> {
    let OfResults { common, place } = arguments.of.clone();
    let only = arguments.only.clone();
    show(&RunArguments::planning(
        common,
        place,
        only,
        arguments.crew,
        arguments.on,
    ))
}

/// What `run` would do with these arguments; changes nothing.
pub fn show(arguments: &RunArguments) -> Result<u8, CliError> {
    let survey = survey::survey(&arguments.common.study, &arguments.place.results)?;
    let chosen = prepare::chosen(&survey, &arguments.only)?;
    let prepared = prepare::prepare(&survey, &chosen, arguments)?;
    let share = prepared.share;
    // A plan is worth showing before the solver is installed.
    let solver = launch::find_solver().unwrap_or_else(|_| "cgaft-solve".into());
    let mut words = String::new();
    let mut cases = Vec::new();
    for &position in &chosen {
        let entry = &survey.entries[position];
        let execution = &entry.planned.case.execution;
        let crew = Crew {
            ranks: arguments.crew.ranks.or(execution.ranks).unwrap_or(1),
            threads: arguments.crew.threads.or(execution.threads).unwrap_or(share.threads),
        };
        let folder = survey.store.partial_folder(&entry.id);
        let command = launch::launch(&solver, &folder, crew).to_string();
        let runs = arguments.fresh || !matches!(entry.state, State::Done(_));
        let waits = arguments.on == On::Slurm && entry.is_on_slurm();
        let doing = match (runs, waits) {
            (true, true) => "wait",
            (true, false) => "run",
            (false, _) => "skip",
        };
        let reason = if runs && matches!(entry.state, State::Done(_)) {
            prepare::FRESH
        } else {
            &entry.reason
        };
        words.push_str(&format!("{}: {doing} ({reason})\n", entry.planned.name));
        if runs && arguments.on == On::Local {
            words.push_str(&format!("    {command}\n"));
        }
        let mut case = entry.to_json();
        case["runs"] = json!(runs && !waits);
        case["reason"] = json!(reason);
        case["command"] = json!(command);
        cases.push(case);
    }
    let mut json = json!({ "study": survey.plan.study, "cases": cases });
    let number = prepared.jobs.len();
    let most_ranks = |of_cluster: Option<u32>| prepared.jobs.iter().filter_map(|job| job.ranks.or(of_cluster)).max();
    let warning;
    match arguments.on {
        On::Local => {
            json["jobs"] = json!(share.jobs);
            json["threads"] = json!(share.threads);
            warning = most_ranks(None).and_then(warnings::of_ranks);
            words.push_str(&format!("\n{}\n", prepared.summary()));
            if number > 0 {
                words.push_str(
                    "`study run` writes each case.yaml before it starts the command, and holds its standard input.\n",
                );
            }
        }
        On::Slurm => {
            let setting = cluster::setting(&survey, arguments)?;
            warning = most_ranks(setting.cluster.ranks).and_then(warnings::of_ranks_elsewhere);
            let scripts = cluster::scripts_of(&survey, &prepared, &setting);
            let texts: Vec<String> = scripts.iter().map(ToString::to_string).collect();
            words.push_str(&format!("\n{}\n", cluster::summary(&survey, &prepared)));
            texts.iter().for_each(|text| words.push_str(&format!("\n{text}")));
            json["scripts"] = json!(texts);
        }
    }
    if let Some(warning) = &warning {
        words.push_str(&format!("{warning}\n"));
    }
    json["warnings"] = json!(warning.into_iter().collect::<Vec<String>>());
    Terminal {
        quiet: false,
        json: arguments.common.json,
    }
    .result(&json, || words)?;
    Ok(0)
}
