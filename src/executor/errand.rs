//! Cases that are to be computed, and what comes of them: the same for processes here and for jobs of a scheduler.

use jiff::Timestamp;
use serde::{Deserialize, Serialize};

use super::Progress;
use super::share::Demand;
use crate::store::{Attempt, Failure, Manifest, Reached, Store};

/// A list of cases to see through.
pub struct Errand<'a> {
    pub store: &'a Store,
    pub jobs: &'a [Job],
    pub watcher: &'a mut dyn Watcher,
    /// In the order of the jobs.
    pub endings: Vec<Ending>,
    /// Those of which the watcher knows that another process has them.
    told_busy: Vec<bool>,
}

impl<'a> Errand<'a> {
    pub fn new(store: &'a Store, jobs: &'a [Job], watcher: &'a mut dyn Watcher) -> Self {
        Errand {
            store,
            jobs,
            watcher,
            endings: vec![Ending::NotStarted; jobs.len()],
            told_busy: vec![false; jobs.len()],
        }
    }

    /// Another process works on a job; the watcher is told once.
    pub fn tell_busy(&mut self, job: usize) {
        if !std::mem::replace(&mut self.told_busy[job], true) {
            self.watcher.waiting(&self.jobs[job]);
        }
    }

    pub fn end(&mut self, job: usize, ending: Ending) {
        self.watcher.ended(&self.jobs[job], &ending);
        self.endings[job] = ending;
    }
}

/// A case to compute.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Job {
    pub name: String,
    /// Identity of the case: names its run.
    pub id: String,
    /// Content of the case file that the solver reads.
    pub case_text: String,
    /// The case for the manifest.
    pub case: serde_json::Value,
    /// Estimated time on one core, s.
    pub seconds: f64,
    /// Where the user or the study says how many; else one.
    pub ranks: Option<u32>,
    /// Where the user or the study says how many; else all jobs have the same.
    pub threads: Option<u32>,
    /// Since when it is wanted afresh: what was begun before counts for nothing. `None`: whatever there is serves.
    pub fresh: Option<Timestamp>,
}

impl Job {
    pub fn demand(&self) -> Demand {
        Demand {
            seconds: self.seconds,
            ranks: self.ranks.unwrap_or(1),
            threads: self.threads,
        }
    }
}

/// How a case ended.
#[derive(Clone, Debug)]
pub enum Ending {
    Done(Box<Manifest>),
    /// Another process has computed it meanwhile.
    DoneElsewhere(Box<Manifest>),
    Failed(Box<Failure>),
    /// It has stopped on request and goes on from its last checkpoint next time.
    Interrupted(Option<Attempt>),
    /// The request to stop came before its turn.
    NotStarted,
    /// It waits or runs as this job of a scheduler, and nobody waits for it here.
    HandedOver(String),
}

/// Is told what happens.
pub trait Watcher {
    /// A scheduler has taken it, under this id.
    fn submitted(&mut self, job: &Job, id: &str);
    /// It waits in the queue of a scheduler, which says why.
    fn queued(&mut self, job: &Job, why: &str);
    fn started(&mut self, job: &Job);
    /// It goes on with more cores, so many together.
    fn widened(&mut self, job: &Job, cores: usize);
    fn progress(&mut self, job: &Job, progress: &Progress);
    /// How far a case is that runs elsewhere.
    fn reached(&mut self, job: &Job, reached: &Reached);
    /// Another process works on it.
    fn waiting(&mut self, job: &Job);
    fn stopping(&mut self);
    fn ended(&mut self, job: &Job, ending: &Ending);
}
