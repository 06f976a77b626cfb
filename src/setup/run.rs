//! One case, from its checkpoint or from the start, into its folder.

use std::error::Error;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use super::recorder::{Recorded, Recorder, RowsOf};
use super::{SetupError, slab, solid};
use crate::domain::{MessageCost, Ranks};
use crate::plan::CaseId;
use crate::record::{self, CHECKPOINT_FILE, RecordError};
use crate::solver::checkpoint::Checkpoint;
use crate::solver::{self, Ending, Progress, RunError, Solver, SolverError};
use crate::store::{Phase, Spent, StoreError};
use crate::study::case::{Body, Case};

/// How a run ended and what it cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Finished {
    pub ending: Ending,
    pub steps: u64,
    /// Time step at the end and its stability limit, ps.
    pub time_step: f64,
    pub stability_limit: f64,
    /// Largest energy imbalance over the largest work; `None` before any work was done.
    pub energy_error: Option<f64>,
    /// The closest that sites have come, as a share of the spacing.
    pub closest_approach: Option<f64>,
    /// Of all attempts together; the mesh and the publishing of the last.
    pub cost: Spent,
    /// `None` where there was one rank, and nothing to be sent.
    pub messages: Option<MessageCost>,
}

/// More threads than this on every core bring a machine to a halt; it leaves room for tests of many threads.
pub const MOST_THREADS_A_CORE: u32 = 32;

/// Why a case was not computed.
#[derive(Debug, thiserror::Error)]
pub enum RunCaseError {
    #[error(transparent)]
    Setup(#[from] SetupError),
    #[error("{0}\nEverything up to here is kept in {1}.")]
    Physics(SolverError, String),
    #[error(transparent)]
    Record(#[from] RecordError),
    #[error(transparent)]
    Store(#[from] StoreError),
    #[error("cannot start {threads} threads: {why}; ask for fewer with --threads")]
    Threads { threads: u32, why: String },
}

/// Computes a case into its folder and publishes the series and the fields there. Goes on from the folder's
/// checkpoint if there is one, and says so through `warn`; a damaged one too, and then the run starts afresh. All ranks
/// call it together, each with so many threads; the first writes.
pub fn run_case(
    case: &Case,
    into: &Path,
    ranks: Ranks,
    threads: u32,
    stop: &AtomicBool,
    tell: &mut (dyn FnMut(&Progress) + Send),
    warn: &mut (dyn FnMut(&str) + Send),
) -> Result<Finished, RunCaseError> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from) as u32;
    if threads > MOST_THREADS_A_CORE * cores {
        let why = format!("this machine has {cores} cores");
        return Err(RunCaseError::Threads { threads, why });
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads as usize).build();
    let pool = pool.map_err(|error| RunCaseError::Threads {
        threads,
        why: error.to_string(),
    })?;
    pool.install(|| match &case.body {
        Body::Slab(slab) => {
            let set_up = || slab::shared_solver(case, slab, ranks);
            compute(case, set_up, into, ranks, stop, tell, warn)
        }
        Body::Solid(solid) => compute(
            case,
            || solid::solver(case, solid, ranks),
            into,
            ranks,
            stop,
            tell,
            warn,
        ),
    })
}

fn compute<B: Recorded<D>, const D: usize>(
    case: &Case,
    set_up: impl FnOnce() -> Result<Solver<B, D>, SetupError>,
    into: &Path,
    ranks: Ranks,
    stop: &AtomicBool,
    tell: &mut (dyn FnMut(&Progress) + Send),
    warn: &mut (dyn FnMut(&str) + Send),
) -> Result<Finished, RunCaseError> {
    let id = CaseId::of(case).to_string();
    let start = Instant::now();
    let mut solver = set_up()?;
    let set_up = start.elapsed().as_secs_f64();
    let mesh = set_up - solver.cost().seconds(solver::Phase::SetUp) - solver.cost().seconds(solver::Phase::Cut);
    resume(&mut solver, into, ranks, &id, warn)?;
    let mut recorder = Recorder::new(into, id.clone(), &solver, tell);
    let ended = solver.run(&mut recorder, stop);
    let ending = match ended {
        Ok(ending) => ending,
        Err(RunError::Output(error)) => return Err(error),
        Err(RunError::Physics(error)) => {
            if ranks.is_first() {
                recorder.flush()?;
                publish(solver, into, &id)?;
            }
            return Err(RunCaseError::Physics(error, into.display().to_string()));
        }
    };
    let cost = solver.cost();
    let messages = (ending != Ending::Interrupted).then(|| ranks.message_cost()).flatten();
    let [time_step, stability_limit] = solver.time_step();
    let mut finished = Finished {
        ending,
        steps: solver.step_count(),
        time_step,
        stability_limit,
        energy_error: solver.ledger().relative_error(),
        closest_approach: solver.closest_approach(),
        cost: recorder.total_cost(&cost),
        messages,
    };
    // What the solver has no clock for.
    finished.cost.phases.push(phase("mesh", mesh));
    if ranks.is_first() && ending != Ending::Interrupted {
        let start = Instant::now();
        publish(solver, into, &id)?;
        let seconds = start.elapsed().as_secs_f64();
        finished.cost.phases.push(phase("publishing", seconds));
    }
    // What has been worked since the last checkpoint.
    finished.cost.core_seconds += ranks.core_seconds() - cost.core_seconds;
    Ok(finished)
}

/// Something done once.
fn phase(name: &str, seconds: f64) -> Phase {
    Phase {
        name: name.to_owned(),
        calls: 1,
        seconds,
    }
}

/// Goes back to the folder's checkpoint, and removes what was recorded after it. The first rank decides whether there is
/// one.
fn resume<B: Recorded<D>, const D: usize>(
    solver: &mut Solver<B, D>,
    into: &Path,
    ranks: Ranks,
    id: &str,
    warn: &mut (dyn FnMut(&str) + Send),
) -> Result<(), RunCaseError> {
    let path = into.join(CHECKPOINT_FILE);
    let found = if ranks.is_first() {
        usable_checkpoint::<B, D>(into, &path, id, warn)?
    } else {
        None
    };
    let mut is_there = [f64::from(u8::from(found.is_some()))];
    ranks.follow_first(&mut is_there);
    if is_there[0] == 0.0 {
        return Ok(());
    }
    let checkpoint = found.map_or_else(|| record::checkpoint::read(&path, id), Ok)?;
    // Nobody goes on, and perhaps replaces it, before all have read it.
    ranks.wait_for_all();
    match solver.restore(&checkpoint) {
        Ok(()) => (),
        Err(SolverError::OtherSpecimen(_)) if !ranks.is_first() => return Ok(()),
        Err(error @ SolverError::OtherSpecimen(_)) => return start_afresh::<B, D>(into, &error, warn),
        Err(error) => return Err(RunCaseError::Physics(error, into.display().to_string())),
    }
    if ranks.is_first() {
        record::cut_back::<RowsOf<B, D>>(into, Some(checkpoint.step))?;
        warn(&format!(
            "going on from step {}, {:.3} ps",
            checkpoint.step, checkpoint.time
        ));
    }
    Ok(())
}

/// The folder's checkpoint; where there is none of use, nothing else is left either.
fn usable_checkpoint<B: Recorded<D>, const D: usize>(
    into: &Path,
    path: &Path,
    id: &str,
    warn: &mut (dyn FnMut(&str) + Send),
) -> Result<Option<Checkpoint<B::Kept, D>>, RunCaseError> {
    match record::checkpoint::read(path, id) {
        Ok(checkpoint) => return Ok(Some(checkpoint)),
        Err(RecordError::Absent { .. }) => record::cut_back::<RowsOf<B, D>>(into, None)?,
        Err(error @ (RecordError::Damaged { .. } | RecordError::NotOurs { .. })) => {
            start_afresh::<B, D>(into, &error, warn)?;
        }
        Err(error) => return Err(error.into()),
    }
    Ok(None)
}

/// Forgets a run whose checkpoint is of no use.
fn start_afresh<B: Recorded<D>, const D: usize>(
    into: &Path,
    why: &dyn Error,
    warn: &mut (dyn FnMut(&str) + Send),
) -> Result<(), RunCaseError> {
    warn(&format!("{why}; starting afresh"));
    Ok(record::cut_back::<RowsOf<B, D>>(into, None)?)
}

/// Ends a solver: what publishing takes of memory must not come on top of its own.
fn publish<B: Recorded<D>, const D: usize>(solver: Solver<B, D>, into: &Path, id: &str) -> Result<(), RecordError> {
    let setting = solver.body().setting();
    let mesh = B::field_mesh(&solver.into_body().into_mesh());
    record::publish_series(into, id, &setting)?;
    record::publish_fields(into, id, &mesh)
}
