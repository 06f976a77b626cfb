use std::path::Path;
use std::thread;

use clap::{Args, ValueEnum};
use jiff::Timestamp;
use serde_json::{Value, json};

use super::estimate::estimates;
use super::progress;
use super::survey::{self, Common, Entry, Place, Survey};
use super::terminal::Terminal;
use super::{CliError, cluster, format, plan, report};
use crate::executor::share::{Share, share};
use crate::executor::{self, Ending, Job, Settings, Stop, exit, launch, slurm};
use crate::plan as planning;
use crate::setup::Estimate;
use crate::store::State;

#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub place: Place,
    /// Run this case only; may be given several times
    #[arg(long, value_name = "CASE")]
    pub only: Vec<String>,
    /// Cases at once [default: what ends first without more threads than cores; on Slurm, as many as it starts]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub jobs: Option<u16>,
    /// MPI ranks a case; more than 1 is not in this version
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub ranks: Option<u32>,
    /// Threads a case [default: the cores of this machine, shared between the jobs; on Slurm, what the study says, else 1]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub threads: Option<u32>,
    /// Where the cases are computed
    #[arg(long, value_enum, default_value = "local")]
    pub on: On,
    /// Hand the cases to Slurm and do not wait for them; the same command without this waits and builds the report
    #[arg(long)]
    pub detach: bool,
    /// Tell what would run and why, and change nothing
    #[arg(long)]
    pub dry_run: bool,
    /// Compute the cases again from the start, even those that are done
    #[arg(long)]
    pub fresh: bool,
    /// Print nothing but failures
    #[arg(long, short)]
    pub quiet: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum On {
    /// On this machine
    Local,
    /// As jobs of Slurm
    Slurm,
}

/// Why a case that is done runs all the same.
pub const FRESH: &str = "asked for by --fresh";

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
    let endings = compute(&survey, &prepared, arguments, &stop, terminal)?;
    let reasons: Vec<String> = survey.entries.iter().map(|entry| entry.reason.clone()).collect();
    survey.refresh();
    link(&survey)?;
    let code = exit_code(&endings, stop.requested());
    let report = if code == exit::INTERRUPTED || arguments.detach {
        None
    } else {
        Some(report::bring_up_to_date(&survey)?)
    };
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
    if arguments.ranks.is_some_and(|ranks| ranks > 1) {
        let advice = "MPI ranks are not in this version; use `--threads N` instead";
        return Err(CliError::Environment(advice.to_owned()));
    }
    Ok(())
}

/// The cases that the user means, as positions in the study.
pub fn chosen(survey: &Survey, only: &[String]) -> Result<Vec<usize>, CliError> {
    let names: Vec<&str> = survey.entries.iter().map(|entry| entry.planned.name.as_str()).collect();
    for wanted in only {
        survey::named(&survey.plan, wanted)?;
    }
    let means = |name: &str| only.is_empty() || only.iter().any(|wanted| wanted == name);
    Ok((0..names.len()).filter(|&position| means(names[position])).collect())
}

/// The work that is left, and how the machine is shared between it.
pub struct Prepared {
    pub jobs: Vec<Job>,
    pub share: Share,
}

/// Every chosen case that is not done, once each.
pub fn prepare(survey: &Survey, chosen: &[usize], arguments: &Arguments) -> Result<Prepared, CliError> {
    let mut wanted: Vec<&Entry> = Vec::new();
    for entry in chosen.iter().map(|&position| &survey.entries[position]) {
        let is_done = matches!(entry.state, State::Done(_)) && !arguments.fresh;
        if !is_done && wanted.iter().all(|other| other.id != entry.id) {
            wanted.push(entry);
        }
    }
    let estimates = estimates(&survey.plan, wanted.iter().map(|entry| &entry.planned))?;
    let now = Timestamp::now();
    let job = |(entry, estimate): (&Entry, &Estimate)| Job {
        name: entry.planned.name.clone(),
        id: entry.id.clone(),
        case_text: planning::write_case(&entry.planned),
        case: planning::spelled(&entry.planned.case),
        seconds: estimate.seconds,
        threads: arguments.threads.or(entry.planned.case.execution.threads),
        fresh: arguments.fresh.then_some(now),
    };
    let jobs: Vec<Job> = wanted.into_iter().zip(&estimates).map(job).collect();
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let seconds: Vec<f64> = jobs.iter().map(|job| job.seconds).collect();
    let threads = jobs.iter().filter_map(|job| job.threads).max();
    let share = share(&seconds, cores, arguments.jobs.map(usize::from), threads);
    Ok(Prepared { jobs, share })
}

/// `2 cases to run, 2 at once with 1 thread each`
pub fn summary(cases: usize, share: Share) -> String {
    if cases == 0 {
        return "nothing to run".to_owned();
    }
    let at_once = share.jobs.min(cases);
    format!(
        "{} to run, {at_once} at once with {} each",
        format::count(cases, "case"),
        format::count(share.threads as usize, "thread")
    )
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
        if planned.case.execution.ranks > 1 {
            let ranks = planned.case.execution.ranks;
            terminal.say(&format!(
                "{}: `ranks: {ranks}` needs MPI, which is not in this version: 1 is used",
                planned.name
            ));
        }
    }
    if !prepared.jobs.is_empty() {
        terminal.say(&match arguments.on {
            On::Local => summary(prepared.jobs.len(), prepared.share),
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
    survey.store.prepare()?;
    let (store, jobs) = (&survey.store, &prepared.jobs);
    let mut watcher = progress::watcher(terminal, store);
    let watcher = watcher.as_mut();
    Ok(match arguments.on {
        On::Local => {
            let share = prepared.share;
            stop.with_care(|| executor::run(store, jobs, &Settings { solver, share }, stop, watcher))?
        }
        On::Slurm => {
            let settings = slurm::Settings {
                study: survey.plan.study.clone(),
                setting: cluster::setting(survey, arguments)?,
                detach: arguments.detach,
            };
            stop.with_care(|| slurm::run(store, jobs, &settings, stop, watcher))?
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

fn conclusion(endings: &[Ending], report: Option<&Path>, code: u8) -> String {
    let Some(report) = report else {
        return if code == exit::INTERRUPTED {
            "stopped; the same command goes on from the last checkpoints\n".to_owned()
        } else {
            "Slurm has them; `cgaft study status` tells how far they are, and the same command without --detach waits \
             and builds the report\n"
                .to_owned()
        };
    };
    let failed = endings
        .iter()
        .filter(|ending| matches!(ending, Ending::Failed(_)))
        .count();
    let failed = if failed > 0 {
        format!("{failed} of {} cases failed\n", endings.len())
    } else {
        String::new()
    };
    format!("{failed}report: {}\n", report.display())
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

fn exit_code(endings: &[Ending], stopped: bool) -> u8 {
    let all_done = endings.iter().all(|ending| {
        matches!(
            ending,
            Ending::Done(_) | Ending::DoneElsewhere(_) | Ending::HandedOver(_)
        )
    });
    match (all_done, stopped) {
        (true, _) => 0,
        (false, true) => exit::INTERRUPTED,
        (false, false) => 1,
    }
}

impl Arguments {
    /// A plain run, for showing what it would do.
    pub fn planning(common: Common, place: Place, on: On) -> Arguments {
        Arguments {
            common,
            place,
            only: Vec::new(),
            jobs: None,
            ranks: None,
            threads: None,
            on,
            detach: false,
            dry_run: true,
            fresh: false,
            quiet: false,
        }
    }
}
