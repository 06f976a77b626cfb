//! Inside a job: one case on one node, as `study run` computes it, and back into the queue when time is up.

use std::env;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use signal_hook::consts::{SIGINT, SIGTERM, SIGUSR1};
use signal_hook::iterator::Signals;

use super::{Ticket, commands};
use crate::executor::queue::{self, Settings};
use crate::executor::share::Share;
use crate::executor::{Ending, Errand, ExecutorError, Stop, Watcher, launch, mpi};
use crate::store::{Attempt, Store};

/// What Slurm tells a job by signals.
#[derive(Clone, Debug, Default)]
pub struct Bell {
    stop: Stop,
    /// Its time is nearly up, and nobody has cancelled it.
    time_up: Arc<AtomicBool>,
}

impl Bell {
    /// Listens from now on. However often it rings, it asks once: Slurm repeats itself, and kills by other means.
    pub fn on_signals() -> std::io::Result<Bell> {
        let bell = Bell::default();
        let Bell { stop, time_up } = bell.clone();
        let mut signals = Signals::new([SIGINT, SIGTERM, SIGUSR1])?;
        thread::spawn(move || {
            for signal in signals.forever() {
                time_up.store(signal == SIGUSR1, Ordering::SeqCst);
                if !stop.requested() {
                    stop.request();
                }
            }
        });
        Ok(bell)
    }
}

/// Computes the case of a ticket; `None` where there is no such ticket.
///
/// A case that was stopped because its time was up is put back into the queue. One that has not come a single step
/// further would do so for ever: it fails.
pub fn carry_out(
    store: &Store,
    id: &str,
    bell: &Bell,
    watcher: &mut dyn Watcher,
) -> Result<Option<Ending>, ExecutorError> {
    let Some(ticket) = Ticket::read(store, id) else {
        return Ok(None);
    };
    let counts = |attempt: &Attempt| ticket.job.fresh.is_none_or(|since| attempt.started >= since);
    let began_at = steps(store.attempt(id).filter(counts).as_ref());
    let solver = launch::find_solver()?;
    mpi::check(&solver, ticket.job.demand().ranks)?;
    let settings = Settings {
        solver,
        share: Share {
            jobs: 1,
            threads: ticket.threads,
            cores: None,
        },
        worth_a_restart: queue::WORTH_A_RESTART,
        slurm_job: own_id(),
    };
    let errand = Errand::new(store, std::slice::from_ref(&ticket.job), watcher);
    let ending = queue::run(errand, &settings, &bell.stop)?.pop();
    let slurm_id = own_id().filter(|_| bell.time_up.load(Ordering::SeqCst));
    let (Some(Ending::Interrupted(attempt)), Some(slurm_id)) = (&ending, slurm_id) else {
        return Ok(ending);
    };
    let why = if steps(attempt.as_ref()) > began_at {
        match commands::requeue(&slurm_id) {
            Ok(()) => return Ok(ending),
            Err(error) => format!("it is out of time and has a checkpoint, but cannot go back into the queue: {error}"),
        }
    } else {
        super::ending::meaning(&slurm_id, Some("TIMEOUT"))
    };
    let Some(claim) = store.claim(id)? else {
        return Ok(ending);
    };
    Ok(Some(Ending::Failed(Box::new(claim.fail(None, why, Vec::new())?))))
}

fn steps(attempt: Option<&Attempt>) -> u64 {
    let reached = attempt.and_then(|attempt| attempt.reached);
    reached.map_or(0, |reached| reached.step)
}

/// As Slurm names this job, or this task of an array.
fn own_id() -> Option<String> {
    let [array, task, job] =
        ["SLURM_ARRAY_JOB_ID", "SLURM_ARRAY_TASK_ID", "SLURM_JOB_ID"].map(|name| env::var(name).ok());
    array.zip(task).map(|(array, task)| format!("{array}_{task}")).or(job)
}
