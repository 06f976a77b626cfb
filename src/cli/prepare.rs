//! What a run is asked for, and the work that is left of it.

use std::thread;

use clap::{Args, ValueEnum};
use glob::Pattern;
use jiff::Timestamp;

use super::estimate::estimates;
use super::survey::{self, Common, Entry, Place, Survey};
use super::{CliError, format, specimen, warnings};
use crate::executor::Job;
use crate::executor::share::{Crew, Demand, Share, share};
use crate::plan::{self as planning, PlannedCase};
use crate::setup::{Estimate, MOST_THREADS_A_CORE, cautions};
use crate::store::State;
use crate::study::case::{MOST_RANKS, MOST_THREADS};

#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub place: Place,
    /// Run these cases only: names or patterns such as 'length-10nm*', with commas between them; may be given several times
    #[arg(long, value_name = "CASES", value_delimiter = ',')]
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
    /// MPI ranks per case [default: what the study says, else 1]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_RANKS)))]
    pub ranks: Option<u32>,
    /// Threads per rank [default: the cores of this machine, shared between jobs and ranks; on Slurm, what the study says,
    /// else 1]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_THREADS)))]
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

impl Arguments {
    /// A plain run, for showing what it would do.
    pub fn planning(common: Common, place: Place, only: Vec<String>, crew: CrewChoice, on: On) -> Arguments {
        Arguments {
            common,
            place,
            only,
            crew,
            on,
            detach: false,
            dry_run: true,
            fresh: false,
            quiet: false,
        }
    }
}

/// The cases that the user means, as positions in the study.
pub fn chosen(survey: &Survey, only: &[String]) -> Result<Vec<usize>, CliError> {
    let names: Vec<&str> = survey.entries.iter().map(|entry| entry.planned.name.as_str()).collect();
    let mut patterns = Vec::new();
    for wanted in only {
        let pattern = Pattern::new(wanted)
            .map_err(|error| CliError::Input(format!("--only: `{wanted}` is no pattern of names: {error}")))?;
        if !names.iter().any(|name| pattern.matches(name)) {
            survey::named(&survey.plan, wanted)?;
        }
        patterns.push(pattern);
    }
    let means = |name: &str| only.is_empty() || patterns.iter().any(|pattern| pattern.matches(name));
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
    /// What `check` warns of.
    pub warnings: Vec<String>,
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
    let laid: Vec<_> = asked
        .iter()
        .zip(estimates.iter().map(|estimate| &estimate.specimen))
        .collect();
    let cautions = asked.iter().zip(&estimates).flat_map(|(planned, estimate)| {
        let cautions = cautions(&planned.case, estimate.time()).into_iter();
        cautions.map(|caution| (planned.name.as_str(), caution))
    });
    let mut warnings = specimen::warnings(&laid);
    warnings.extend(warnings::once(cautions));
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
    if arguments.on == On::Local {
        refuse_too_many_threads(&jobs, cores)?;
    }
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
        warnings,
    })
}

/// The solver refuses so many too, but only when it is started.
fn refuse_too_many_threads(jobs: &[Job], cores: usize) -> Result<(), CliError> {
    let most = MOST_THREADS_A_CORE * cores as u32;
    let asked = jobs.iter().filter_map(|job| Some((job, job.threads?)));
    match asked.max_by_key(|(_, threads)| *threads) {
        Some((job, threads)) if threads > most => Err(CliError::Input(format!(
            "{}: {threads} threads are more than {MOST_THREADS_A_CORE} for each of the {cores} cores of this machine; ask for \
             {cores} or fewer",
            job.name
        ))),
        _ => Ok(()),
    }
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
