//! `cgaft-solve`: one case, from its file to its folder.

use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock};
use std::thread;
use std::time::Duration;

use clap::{CommandFactory, Parser};
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use super::progress;
use super::terminal::{self, warn};
use crate::domain::{self, Ranks};
use crate::durable;
use crate::executor::{Progress, exit};
use crate::plan::{self, CaseId, Plan, PlannedCase};
use crate::setup::{self, RunCaseError};
use crate::solver::{self, Ending};
use crate::store::{self, FolderLock, Outcome, StoreError};
use crate::study::StudyError;
use crate::study::case::Case;
use crate::study::case::MOST_THREADS;

/// Compute one case of a study.
///
/// Started by mpirun, all ranks compute it together, to the same bits.
/// Ctrl-C writes a checkpoint and stops; the same command goes on from there.
/// Exit codes: 0 done, 2 bad input, 3 something is missing on this machine, 4 the physics failed,
/// 5 output could not be written, 130 interrupted.
#[derive(Debug, Parser)]
#[command(name = "cgaft-solve", version = VERSION.as_str())]
struct Arguments {
    /// The case, as `cgaft study run` writes it beside each run
    case: PathBuf,
    /// Folder for everything that the run writes
    #[arg(long, value_name = "DIR")]
    into: PathBuf,
    /// Threads [default: what the case says, else the cores of this machine]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_THREADS)))]
    threads: Option<u32>,
    /// How to tell progress [default: a bar on a terminal, else lines]
    #[arg(long, value_enum)]
    progress: Option<progress::Style>,
    /// Stop with a checkpoint when standard input closes, so that nothing outlives the one who started it
    #[arg(long)]
    parent_pipe: bool,
}

/// How a computation ended, if it did not fail.
#[derive(Clone, Debug, PartialEq)]
pub enum Ended {
    Finished(Outcome),
    /// It was asked to stop, and has left a checkpoint.
    Interrupted,
}

/// Why a case could not be computed to its end; each has its exit code.
#[derive(Debug, thiserror::Error)]
pub enum SolveError {
    #[error(transparent)]
    Study(#[from] StudyError),
    #[error("{0}")]
    Input(String),
    #[error("{0}")]
    Environment(String),
    /// With the step, the place and what to try.
    #[error("{0}")]
    Physics(String),
    #[error("{0}")]
    Output(String),
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// With what it was built; the runner looks at the second line.
static VERSION: LazyLock<String> = LazyLock::new(|| {
    let mpi = domain::library().map(|library| format!("mpi ({library})"));
    let version = env!("CARGO_PKG_VERSION");
    format!("{version}\nfeatures: {}", mpi.unwrap_or_else(|| "none".to_owned()))
});

/// What may be typed, for man pages and completions.
pub fn command() -> clap::Command {
    Arguments::command()
}

/// The whole of `cgaft-solve`.
pub fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let (ranks, _session) = match domain::start() {
        Ok(started) => started,
        Err(error) => return refuse(&SolveError::Environment(error.to_string())),
    };
    match solve(&arguments, ranks) {
        Ok(Ended::Finished(_)) => ExitCode::SUCCESS,
        Ok(Ended::Interrupted) => {
            if ranks.is_first() {
                warn("interrupted; the same command goes on from the checkpoint");
            }
            ExitCode::from(exit::INTERRUPTED)
        }
        // All ranks know of it, and end together.
        Err(error @ SolveError::Physics(_)) if !ranks.is_first() => ExitCode::from(error.exit_code()),
        Err(error @ SolveError::Physics(_)) => refuse(&error),
        Err(error) => {
            // What the first rank meets too it tells, and ends all.
            if !ranks.is_first() {
                thread::sleep(Duration::from_secs(2));
            }
            let code = refuse(&error);
            ranks.abort(error.exit_code());
            code
        }
    }
}

fn refuse(error: &SolveError) -> ExitCode {
    warn(&error.render(terminal::color()));
    ExitCode::from(error.exit_code())
}

fn solve(arguments: &Arguments, ranks: Ranks) -> Result<Ended, SolveError> {
    let plan = read_case(&arguments.case)?;
    let PlannedCase { name, case, .. } = &plan.cases[0];
    let _lock = ranks.is_first().then(|| take_folder(arguments, case)).transpose()?;
    let stop = stop_flag(arguments.parent_pipe, ranks)?;
    let cores = || thread::available_parallelism().map_or(1, usize::from) as u32;
    let threads = arguments.threads.or(case.execution.threads).unwrap_or_else(cores);
    let ended = compute(case, name, arguments, ranks, threads, &stop).map_err(|error| refused(error, &plan))?;
    if let (true, Ended::Finished(outcome)) = (ranks.is_first(), &ended) {
        outcome.write(&arguments.into)?;
    }
    Ok(ended)
}

/// Keeps other solvers, and other cases, out of the folder.
fn take_folder(arguments: &Arguments, case: &Case) -> Result<FolderLock, SolveError> {
    let patience = Duration::from_secs(30);
    let Some(lock) = FolderLock::take(&arguments.into, patience)? else {
        let folder = arguments.into.display();
        return Err(SolveError::Output(format!(
            "another solver writes into {folder}; wait for it, or choose another folder"
        )));
    };
    refuse_another_case(case, &arguments.case, &arguments.into)?;
    Ok(lock)
}

fn read_case(path: &Path) -> Result<Plan, SolveError> {
    let text = path
        .to_str()
        .ok_or_else(|| SolveError::Input(format!("{} is not UTF-8; rename it", path.display())))?;
    Ok(plan::read_case(text)?)
}

/// A checkpoint of one case must not become the start of another.
fn refuse_another_case(case: &Case, path: &Path, into: &Path) -> Result<(), SolveError> {
    let kept = into.join("case.yaml");
    if kept.exists() {
        let old = &read_case(&kept)?.cases[0].case;
        return if CaseId::of(old) == CaseId::of(case) {
            Ok(())
        } else {
            Err(SolveError::Input(other_case(into)))
        };
    }
    let text =
        durable::read(path).map_err(|error| SolveError::Input(format!("cannot read {}: {error}", path.display())))?;
    Ok(store::write(&kept, &text)?)
}

fn other_case(into: &Path) -> String {
    format!(
        "{} holds the run of another case; choose another folder, or remove that one first",
        into.display()
    )
}

/// Becomes true at Ctrl-C, SIGTERM and, if wanted, at the end of standard input. A second Ctrl-C ends the program at once,
/// unless somebody holds the pipe, who can do that too: a scheduler sends its signals several times, and means one.
fn stop_flag(parent_pipe: bool, ranks: Ranks) -> Result<Arc<AtomicBool>, SolveError> {
    let stop = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        let failed = |error| SolveError::Environment(format!("cannot catch Ctrl-C: {error}"));
        if !parent_pipe {
            flag::register_conditional_shutdown(signal, i32::from(exit::INTERRUPTED), stop.clone()).map_err(failed)?;
        }
        flag::register(signal, stop.clone()).map_err(failed)?;
    }
    // mpirun hands its standard input to the first rank.
    if parent_pipe && ranks.is_first() {
        let stop = stop.clone();
        thread::spawn(move || {
            let mut input = io::stdin().lock();
            while !matches!(input.read(&mut [0; 64]), Ok(0) | Err(_)) {}
            stop.store(true, Ordering::SeqCst);
        });
    }
    Ok(stop)
}

impl SolveError {
    fn exit_code(&self) -> u8 {
        match self {
            SolveError::Study(_) | SolveError::Input(_) => exit::BAD_INPUT,
            SolveError::Environment(_) => exit::MISSING_ENVIRONMENT,
            SolveError::Physics(_) => exit::PHYSICS_FAILED,
            SolveError::Store(store) if store.is_of_the_input() => exit::BAD_INPUT,
            SolveError::Output(_) | SolveError::Store(_) => exit::OUTPUT_FAILED,
        }
    }

    fn render(&self, color: bool) -> String {
        match self {
            SolveError::Study(study) => study.render(color).trim_end().to_owned(),
            other => format!("error: {other}"),
        }
    }
}

/// Computes the case into the folder, going on from its checkpoint if there is one: the one call to `setup`. Only the first
/// rank speaks.
fn compute(
    case: &Case,
    name: &str,
    arguments: &Arguments,
    ranks: Ranks,
    threads: u32,
    stop: &AtomicBool,
) -> Result<Ended, RunCaseError> {
    let mut teller = progress::teller(arguments.progress, name);
    let mut tell = |progress: &solver::Progress| {
        let of = progress.of.max(1);
        teller(&Progress {
            step: progress.step,
            of,
            time_ps: progress.time,
            strain: progress.strain,
            tip_nm: progress.tip,
            residual: progress.residual,
            percent: 100.0 * progress.step as f64 / of as f64,
        });
    };
    let finished = setup::run_case(case, &arguments.into, ranks, threads, stop, &mut tell, &mut warn)?;
    if finished.ending == Ending::Interrupted {
        return Ok(Ended::Interrupted);
    }
    Ok(Ended::Finished(Outcome {
        end_reason: finished.ending.to_string(),
        steps: finished.steps,
        time_step_ps: finished.time_step,
        stability_limit_ps: finished.stability_limit,
        energy_error_relative: finished.energy_error,
        closest_approach_spacings: finished.closest_approach,
        peak_memory_bytes: setup::memory::peak().map(|bytes| ranks.largest(bytes as f64) as u64),
        core_seconds: Some(finished.cost.core_seconds),
        cost: finished.cost.phases,
        messages: finished.messages.map(|messages| store::MessageCost {
            latency_s: messages.latency,
            seconds_a_byte: messages.a_byte,
            reduction_s: messages.reduction,
        }),
    }))
}

/// What kept a case from its end, with the exit code that it means.
fn refused(error: RunCaseError, plan: &Plan) -> SolveError {
    match error {
        RunCaseError::Setup(setup) => SolveError::Study(plan.refuse([(plan.cases[0].name.as_str(), setup.refusal())])),
        physics @ RunCaseError::Physics(..) => SolveError::Physics(physics.to_string()),
        RunCaseError::Record(record) if record.is_write_failure() => SolveError::Output(record.to_string()),
        RunCaseError::Record(record) => SolveError::Input(record.to_string()),
        RunCaseError::Store(store) => SolveError::Store(store),
        threads @ RunCaseError::Threads { .. } => SolveError::Environment(threads.to_string()),
    }
}
