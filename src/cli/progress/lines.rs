use std::collections::HashMap;
use std::time::{Duration, Instant};

use super::{Pace, STOPPING, WAITING, ending_words, failure_words, progress_words};
use crate::cli::terminal::{Terminal, warn};
use crate::executor::{Ending, Job, Progress, Watcher};
use crate::store::Store;

/// Time between two lines of one case.
const LINE_EVERY: Duration = Duration::from_secs(5);

/// A plain log.
pub struct Lines {
    terminal: Terminal,
    store: Store,
    /// By the id of the case: its pace, and when it was last spoken of.
    cases: HashMap<String, (Pace, Instant)>,
}

impl Lines {
    pub fn new(terminal: Terminal, store: Store) -> Lines {
        Lines {
            terminal,
            store,
            cases: HashMap::new(),
        }
    }
}

impl Watcher for Lines {
    fn started(&mut self, job: &Job) {
        self.terminal.say(&format!("{}: started", job.name));
    }

    fn progress(&mut self, job: &Job, progress: &Progress) {
        let begin = || (Pace::starting_at(progress.percent), Instant::now());
        let (pace, said) = self.cases.entry(job.id.clone()).or_insert_with(begin);
        if said.elapsed() >= LINE_EVERY {
            *said = Instant::now();
            let words = progress_words(progress, pace);
            self.terminal
                .say(&format!("{}: {:.0} %  {words}", job.name, progress.percent));
        }
    }

    fn waiting(&mut self, job: &Job) {
        self.terminal.say(&format!("{}: {WAITING}", job.name));
    }

    fn stopping(&mut self) {
        self.terminal.say(STOPPING);
    }

    fn ended(&mut self, job: &Job, ending: &Ending) {
        match ending {
            Ending::Failed(failure) => warn(&failure_words(job, failure, &self.store)),
            _ => self.terminal.say(&ending_words(job, ending)),
        }
    }
}
