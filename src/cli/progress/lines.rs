use std::collections::HashMap;
use std::time::{Duration, Instant};

use super::{
    Pace, STOPPING, WAITING, Whole, ending_words, failure_words, progress_words, reached_words, study_words,
    widened_words,
};
use crate::cli::terminal::{Terminal, warn};
use crate::executor::{Ending, Job, Progress, Watcher};
use crate::store::{Reached, Store};

/// Time between two lines of one case.
const LINE_EVERY: Duration = Duration::from_secs(5);

/// A plain log.
pub struct Lines {
    terminal: Terminal,
    store: Store,
    /// By the id of the case: its pace, and when it was last spoken of.
    cases: HashMap<String, (Pace, Instant)>,
    whole: Whole,
}

impl Lines {
    pub fn new(terminal: Terminal, store: Store, whole: Whole) -> Lines {
        Lines {
            terminal,
            store,
            cases: HashMap::new(),
            whole,
        }
    }
}

impl Lines {
    fn now_and_then(&mut self, job: &Job, percent: f64, words: impl FnOnce(&mut Pace) -> String) {
        let begin = || (Pace::starting_at(percent), Instant::now());
        let (pace, said) = self.cases.entry(job.id.clone()).or_insert_with(begin);
        if said.elapsed() >= LINE_EVERY {
            *said = Instant::now();
            let words = words(pace);
            self.terminal.say(&format!("{}: {percent:.0} %  {words}", job.name));
        }
    }
}

impl Watcher for Lines {
    fn submitted(&mut self, job: &Job, id: &str) {
        self.terminal.say(&format!("{}: submitted as Slurm job {id}", job.name));
    }

    fn queued(&mut self, job: &Job, why: &str) {
        self.terminal.say(&format!("{}: queued ({why})", job.name));
    }

    fn started(&mut self, job: &Job) {
        let count = self.whole.count(job);
        let words = match self.whole.is_several() {
            true => format!("{}: started ({count})", job.name),
            false => format!("{}: started", job.name),
        };
        self.terminal.say(&words);
    }

    fn widened(&mut self, job: &Job, cores: usize) {
        self.cases.remove(&job.id);
        self.terminal.say(&format!("{}: {}", job.name, widened_words(cores)));
    }

    fn progress(&mut self, job: &Job, progress: &Progress) {
        self.whole.reach(job, progress.percent);
        let of_study = study_words(&self.whole)
            .map(|words| format!("  {words}"))
            .unwrap_or_default();
        self.now_and_then(job, progress.percent, |pace| progress_words(progress, pace) + &of_study);
    }

    fn reached(&mut self, job: &Job, reached: &Reached) {
        self.now_and_then(job, reached.percent, |_| reached_words(reached));
    }

    fn waiting(&mut self, job: &Job) {
        self.terminal.say(&format!("{}: {WAITING}", job.name));
    }

    fn stopping(&mut self) {
        self.terminal.say(STOPPING);
    }

    fn ended(&mut self, job: &Job, ending: &Ending) {
        self.whole.end(job);
        match ending {
            Ending::Failed(failure) => warn(&failure_words(job, failure, &self.store)),
            _ => self.terminal.say(&ending_words(job, ending)),
        }
    }
}
