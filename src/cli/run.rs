use std::path::Path;
use std::thread;

use clap::{Args, ValueEnum};
use jiff::Timestamp;
use serde_json::{Value, json};

use super::estimate::estimates;
use super::progress;
use super::survey::{self, Common, Entry, Place, Survey};
use super::terminal::Terminal;
use super::{CliError, cluster, format, plan, report, room};
use crate::executor::share::{Crew, Demand, Share, share};
use crate::executor::{self, Ending, Errand, ExecutorError, Job, Settings, Stop, exit, launch, mpi, slurm};
use crate::plan::{self as planning, PlannedCase};
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
    #[command(flatten)]
    pub crew: CrewChoice,
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

/// How many cases at once, and what computes each.
#[derive(Args, Clone, Copy, Debug, Default)]
pub struct CrewChoice {
    /// Cases at once [default: what ends first without more ranks and threads than cores; on Slurm, as many as it starts]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub jobs: Option<u16>,
    /// MPI ranks a case [default: what the study says, else 1]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub ranks: Option<u32>,
    /// Threads a rank [default: the cores of this machine, shared between jobs and ranks; on Slurm, what the study says,
    /// else 1]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub threads: Option<u32>,
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
    room::tell(&arguments.place.results, prepared.disk);
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
    /// What they may take of the disk, bytes.
    pub disk: u64,
    /// Of this machine.
    pub cores: usize,
}

/// Every chosen case that is not done, once each.
pub fn prepare(survey: &Survey, chosen: &[usize], arguments: &Arguments) -> Result<Prepared, CliError> {
    refuse_another_crew(survey, arguments.crew)?;
    let mut wanted: Vec<&Entry> = Vec::new();
    for entry in chosen.iter().map(|&position| &survey.entries[position]) {
        let is_done = matches!(entry.state, State::Done(_)) && !arguments.fresh;
        if !is_done && wanted.iter().all(|other| other.id != entry.id) {
            wanted.push(entry);
        }
    }
    let asked: Vec<PlannedCase> = wanted
        .iter()
        .map(|entry| with_ranks(&entry.planned, arguments))
        .collect();
    let estimates = estimates(&survey.plan, &asked)?;
    let now = Timestamp::now();
    let job = |(entry, estimate): (&Entry, &Estimate)| Job {
        name: entry.planned.name.clone(),
        id: entry.id.clone(),
        case_text: planning::write_case(&entry.planned),
        case: planning::spelled(&entry.planned.case),
        seconds: estimate.seconds,
        ranks: arguments.crew.ranks.or(entry.planned.case.execution.ranks),
        threads: arguments.crew.threads.or(entry.planned.case.execution.threads),
        fresh: arguments.fresh.then_some(now),
    };
    let jobs: Vec<Job> = wanted.into_iter().zip(&estimates).map(job).collect();
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let demands: Vec<Demand> = jobs.iter().map(Job::demand).collect();
    // Cases side by side would disturb each other's time.
    let alone = survey.plan.compares_crews().then_some(1);
    let share = share(&demands, cores, arguments.crew.jobs.map(usize::from).or(alone));
    let disk = estimates.iter().map(|estimate| estimate.disk_bytes).sum();
    Ok(Prepared {
        jobs,
        share,
        disk,
        cores,
    })
}

/// Where cases are compared by their ranks or threads, one number for all would make them other cases.
fn refuse_another_crew(survey: &Survey, crew: CrewChoice) -> Result<(), CliError> {
    let ids = || survey.entries.iter().map(|entry| &entry.planned.id);
    let said = [
        ("ranks", crew.ranks.is_some() && ids().any(|id| id.ranks.is_some())),
        (
            "threads",
            crew.threads.is_some() && ids().any(|id| id.threads.is_some()),
        ),
    ];
    match said.into_iter().find(|(_, is_said_twice)| *is_said_twice) {
        None => Ok(()),
        Some((what, _)) => Err(CliError::Input(format!(
            "study {} compares what computes its cases; leave out `--{what}`, and write into the study what its cases shall have",
            survey.plan.study
        ))),
    }
}

/// A case with the ranks that will compute it on this machine.
fn with_ranks(planned: &PlannedCase, arguments: &Arguments) -> PlannedCase {
    let mut planned = planned.clone();
    let execution = &mut planned.case.execution;
    execution.ranks = match arguments.on {
        On::Local => arguments.crew.ranks.or(execution.ranks),
        On::Slurm => None,
    };
    planned
}

impl Prepared {
    /// `2 cases to run, 2 at once with 1 thread each`
    pub fn summary(&self) -> String {
        let crews: Vec<Crew> = self.jobs.iter().map(|job| self.share.crew(&job.demand())).collect();
        let Some(&first) = crews.first() else {
            return "nothing to run".to_owned();
        };
        let mut at_once = Vec::new();
        while at_once.len() < crews.len() && self.share.has_room(&at_once, crews[at_once.len()]) {
            at_once.push(crews[at_once.len()]);
        }
        let each = match first {
            _ if crews.iter().any(|crew| *crew != first) => "as many ranks and threads as each asks for".to_owned(),
            Crew { ranks: 1, threads } => format!("{} each", format::count(threads as usize, "thread")),
            Crew { ranks, threads } => {
                let threads = format::count(threads as usize, "thread");
                format!("{} of {threads} each", format::count(ranks as usize, "rank"))
            }
        };
        let to_run = format::count(crews.len(), "case");
        let summary = format!("{to_run} to run, {} at once with {each}", at_once.len());
        let taken: usize = at_once.iter().map(|crew| crew.cores()).sum();
        let most = crews.iter().map(|crew| crew.cores()).max().unwrap_or(taken).max(taken);
        if most <= self.cores {
            return summary;
        }
        let cores = format::count(self.cores, "core");
        format!("{summary}: {most} in all on {cores}, which they take turns on")
    }
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
    let mut watcher = progress::watcher(terminal, store);
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

fn conclusion(endings: &[Ending], report: Option<&Path>, code: u8) -> String {
    let Some(report) = report else {
        return match code {
            exit::INTERRUPTED => "stopped; the same command goes on from the last checkpoints\n".to_owned(),
            _ => cluster::handed_over(endings),
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
    pub fn planning(common: Common, place: Place, crew: CrewChoice, on: On) -> Arguments {
        Arguments {
            common,
            place,
            only: Vec::new(),
            crew,
            on,
            detach: false,
            dry_run: true,
            fresh: false,
            quiet: false,
        }
    }
}
