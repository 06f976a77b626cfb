//! What a person sees while cases run: a bar each on a terminal, plain lines elsewhere.

mod bars;
mod lines;
mod pace;
mod teller;
mod whole;

pub use teller::{Style, teller};

use pace::Pace;
use whole::Whole;

use std::io::{IsTerminal, stderr};

use super::format;
use super::terminal::Terminal;
use crate::executor::{Ending, Job, Progress, Watcher};
use crate::store::{Failure, Reached, Store};

/// The way of showing progress that fits where the output goes.
pub fn watcher(terminal: Terminal, store: &Store, jobs: &[Job]) -> Box<dyn Watcher> {
    let (folders, whole) = (store.clone(), Whole::of(jobs));
    if stderr().is_terminal() && !terminal.quiet {
        Box::new(bars::Bars::new(terminal, folders, whole))
    } else {
        Box::new(lines::Lines::new(terminal, folders, whole))
    }
}

/// `about 40 s left  strain 0.310 %  tip 56.2 nm  step 1200/20000`
fn progress_words(progress: &Progress, pace: &mut Pace) -> String {
    // A narrow terminal cuts the end off, so the time left comes first.
    let left = pace
        .seconds_left(progress.percent)
        .map(|left| format!("about {} left  ", format::duration(left)));
    format!("{}{progress}", left.unwrap_or_default())
}

/// `about 12 min left of the study`; nothing for one case, whose own time is told.
fn study_words(whole: &Whole) -> Option<String> {
    let left = whole.is_several().then(|| whole.seconds_left())??;
    Some(format!("about {} left of the study", format::duration(left)))
}

const STOPPING: &str = "stopping: the cases write their checkpoints (Ctrl-C again ends them at once)";
const WAITING: &str = "another process computes it; waiting for it";

/// `goes on with 2 cores`
fn widened_words(cores: usize) -> String {
    format!("goes on with {cores} cores, nobody else needs them")
}

/// `step 1200 of 20000`
fn reached_words(reached: &Reached) -> String {
    format!("step {} of {}", reached.step, reached.of)
}

/// How a case ended, in one line.
fn ending_words(job: &Job, ending: &Ending) -> String {
    let name = &job.name;
    match ending {
        Ending::Done(manifest) => {
            let seconds = format::duration(manifest.wall_seconds);
            format!("{name}: done in {seconds} ({})", manifest.outcome.end_reason)
        }
        Ending::DoneElsewhere(_) => format!("{name}: done (computed by another process)"),
        Ending::Failed(failure) => format!("{name}: failed: {}", failure.meaning),
        Ending::Interrupted(attempt) => {
            let reached = attempt.as_ref().and_then(|attempt| attempt.reached);
            let at = reached
                .map(|reached| format!(" at step {} of {}", reached.step, reached.of))
                .unwrap_or_default();
            format!("{name}: interrupted{at}")
        }
        Ending::NotStarted => format!("{name}: not started"),
        Ending::HandedOver(id) => format!("{name}: handed over as Slurm job {id}"),
    }
}

/// A failure as a person needs it: what it means, the end of the log, and where the rest is.
fn failure_words(job: &Job, failure: &Failure, store: &Store) -> String {
    let mut words = format!("{}: failed: {}\n", job.name, failure.meaning);
    for line in &failure.log_tail {
        words.push_str(&format!("    | {line}\n"));
    }
    let log = store.partial_folder(&job.id).join("log.txt");
    words.push_str(&format!("    the whole log is in {}", log.display()));
    words
}
