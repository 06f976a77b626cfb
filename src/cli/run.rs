mod outcome;

use serde_json::{Value, json};

use outcome::{conclusion, exit_code};

use super::prepare::{Arguments, FRESH, On, Prepared, chosen, prepare};
use super::survey::{self, Entry, Survey};
use super::terminal::{self, Terminal};
use super::{CliError, cluster, plan, progress, report, room};
use crate::executor::{self, Ending, Errand, ExecutorError, Settings, Stop, exit, launch, mpi, slurm};
use crate::store::State;

/// `cgaft study run FILE`
pub fn run(arguments: &Arguments) -> Result<u8, CliError> {
    refuse_what_is_not_here(arguments)?;
    if arguments.dry_run {
        return plan::show(arguments);
    }
    let terminal = Terminal {
        quiet: arguments.quiet,
        json: arguments.common.json,
    };
    let mut survey = survey::survey(&arguments.common.study, &arguments.place.results)?;
    let chosen = chosen(&survey, &arguments.only)?;
    let prepared = prepare(&survey, &chosen, arguments)?;
    let stop = Stop::on_signals().map_err(|error| CliError::Environment(format!("cannot catch Ctrl-C: {error}")))?;
    tell_plan(&survey, &chosen, &prepared, arguments, terminal);
    if let Some(warning) = room::warning(&arguments.place.results, prepared.disk) {
        terminal::warn(&warning);
    }
    let endings = compute(&survey, &prepared, arguments, &stop, terminal)?;
    let reasons: Vec<String> = survey.entries.iter().map(|entry| entry.reason.clone()).collect();
    survey.refresh();
    link(&survey)?;
    let mut code = exit_code(&endings, stop.requested());
    let mut report = None;
    if code != exit::INTERRUPTED && !arguments.detach {
        let built = report::bring_up_to_date(&mut survey)?;
        code = code.max(u8::from(built.damaged));
        report = Some(built.path);
    }
    let results: Vec<Value> = chosen
        .iter()
        .map(|&position| result(&survey.entries[position], &reasons[position], &prepared))
        .collect();
    let json = json!({
        "study": survey.plan.study, "results": survey.store.root(), "report": report, "cases": results,
    });
    terminal.result(&json, || conclusion(&endings, report.as_deref(), code))?;
    Ok(code)
}

fn refuse_what_is_not_here(arguments: &Arguments) -> Result<(), CliError> {
    if arguments.detach && arguments.on == On::Local {
        let advice = "only Slurm goes on by itself; add `--on slurm`, or leave out `--detach`";
        return Err(CliError::Input(advice.to_owned()));
    }
    Ok(())
}

fn tell_plan(survey: &Survey, chosen: &[usize], prepared: &Prepared, arguments: &Arguments, terminal: Terminal) {
    for &position in chosen {
        let Entry {
            planned, state, reason, ..
        } = &survey.entries[position];
        terminal.say(&match state {
            State::Done(_) if arguments.fresh => format!("{}: runs ({FRESH})", planned.name),
            State::Done(_) => format!("{}: done (unchanged)", planned.name),
            State::Running(_) => format!("{}: {reason}", planned.name),
            _ if arguments.on == On::Slurm && survey.entries[position].is_on_slurm() => {
                format!("{}: {reason}", planned.name)
            }
            _ => format!("{}: runs ({reason})", planned.name),
        });
    }
    prepared.warnings.iter().for_each(|warning| terminal.say(warning));
    if !prepared.jobs.is_empty() {
        terminal.say(&match arguments.on {
            On::Local => prepared.summary(),
            On::Slurm => cluster::summary(survey, prepared),
        });
    }
}

fn compute(
    survey: &Survey,
    prepared: &Prepared,
    arguments: &Arguments,
    stop: &Stop,
    terminal: Terminal,
) -> Result<Vec<Ending>, CliError> {
    if prepared.jobs.is_empty() {
        survey.store.prepare()?;
        return Ok(Vec::new());
    }
    let solver = launch::find_solver()?;
    let (store, jobs) = (&survey.store, &prepared.jobs);
    let most_ranks = |of_cluster: Option<u32>| {
        jobs.iter()
            .filter_map(|job| job.ranks.or(of_cluster))
            .max()
            .unwrap_or(1)
    };
    let mut watcher = progress::watcher(terminal, store, jobs);
    let errand = Errand::new(store, jobs, watcher.as_mut());
    Ok(match arguments.on {
        On::Local => {
            mpi::check(&solver, most_ranks(None)).map_err(ExecutorError::from)?;
            store.prepare()?;
            let settings = Settings {
                solver,
                share: prepared.share,
                worth_a_restart: executor::WORTH_A_RESTART,
                slurm_job: None,
            };
            stop.with_care(|| executor::run(errand, &settings, stop))?
        }
        On::Slurm => {
            let setting = cluster::setting(survey, arguments)?;
            mpi::check_elsewhere(&solver, most_ranks(setting.cluster.ranks)).map_err(ExecutorError::from)?;
            store.prepare()?;
            let settings = slurm::Settings {
                study: survey.plan.study.clone(),
                setting,
                detach: arguments.detach,
            };
            stop.with_care(|| slurm::run(errand, &settings, stop))?
        }
    })
}

/// Two names of one case share its run; a renamed case finds the run it had.
fn link(survey: &Survey) -> Result<(), CliError> {
    for entry in &survey.entries {
        if matches!(entry.state, State::Done(_)) {
            survey.store.link(&entry.planned.name, &entry.id)?;
        }
    }
    Ok(())
}

fn result(entry: &Entry, reason: &str, prepared: &Prepared) -> Value {
    let mut result = entry.to_json();
    result["reason"] = json!(reason);
    result["ran"] = json!(prepared.jobs.iter().any(|job| job.id == entry.id));
    match &entry.state {
        State::Done(manifest) => {
            result["wall_s"] = json!(manifest.wall_seconds);
            result["end_reason"] = json!(manifest.outcome.end_reason);
        }
        State::Failed(failure) => {
            result["failure"] =
                json!({ "exit_code": failure.exit_code, "meaning": failure.meaning, "log_tail": failure.log_tail });
        }
        _ => {}
    }
    result
}
