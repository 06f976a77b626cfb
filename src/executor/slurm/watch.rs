//! Hands cases over and watches them until the last has ended, or until the one who asked has seen enough.

mod hand_over;

use std::thread;
use std::time::{Duration, Instant};

use super::commands::{self, Sighting};
use super::script::Setting;
use super::{Ticket, ending, job_name, ticket, waiting};
use crate::executor::queue::tail_of;
use crate::executor::{Ending, Errand, ExecutorError, Job, Stop};
use crate::store::State;

#[derive(Clone, Debug)]
pub struct Settings {
    pub study: String,
    pub setting: Setting,
    /// Hand everything over, and do not wait for it.
    pub detach: bool,
}

/// Sees that every job is in the queue or at work, each once, and then to its end; the endings are in the order of the
/// jobs. Jobs that were handed over before are found again.
pub fn run<'a>(errand: Errand<'a>, settings: &'a Settings, stop: &Stop) -> Result<Vec<Ending>, ExecutorError> {
    let mut watch = Watch::new(errand, settings);
    watch.hand_over(stop)?;
    if settings.detach {
        return Ok(watch.errand.endings);
    }
    let mut told = false;
    let mut pause = FIRST_PAUSE;
    while !watch.cases.is_empty() && !stop.insisted() {
        if stop.requested() && !told {
            told = true;
            watch.cancel()?;
            pause = FIRST_PAUSE;
        }
        rest(pause, stop, told);
        pause = if watch.look(stop)? {
            FIRST_PAUSE
        } else {
            LONGEST_PAUSE.min(pause * 5 / 4)
        };
        watch.hand_over(stop)?;
    }
    Ok(watch.errand.endings)
}

/// Time between two questions to Slurm: short after something has happened, so that small cases are no waste of time,
/// and long when nothing does, so that thousands of users can ask.
const FIRST_PAUSE: Duration = Duration::from_millis(500);
const LONGEST_PAUSE: Duration = Duration::from_secs(20);
/// How long a Ctrl-C may go unseen.
const HEED: Duration = Duration::from_millis(50);
/// Questions in a row that Slurm may leave unanswered: it is restarted now and then.
const MOST_UNANSWERED: u32 = 8;
/// Looks at an ended job before its result is taken for missing, in case the network is slow.
const LOOKS_FOR_A_RESULT: u32 = 3;

struct Watch<'a> {
    errand: Errand<'a>,
    settings: &'a Settings,
    cases: Vec<Case>,
    unanswered: u32,
    /// When Slurm last had no room for a job, and it was not known that there is some again.
    full: Option<Instant>,
    submitted: usize,
}

/// A case that has not ended.
struct Case {
    /// Its position in the list.
    job: usize,
    /// Its ticket; `None` while another process has it, or before it is handed over.
    ticket: Option<Ticket>,
    sighting: Option<Sighting>,
    /// Looks since it left the queue.
    missed: u32,
    /// Whether the watcher knows that Slurm had no room for it.
    told_full: bool,
}

impl<'a> Watch<'a> {
    fn new(errand: Errand<'a>, settings: &'a Settings) -> Self {
        let case = |job| Case {
            job,
            ticket: None,
            sighting: None,
            missed: 0,
            told_full: false,
        };
        Watch {
            cases: (0..errand.jobs.len()).map(case).collect(),
            errand,
            settings,
            unanswered: 0,
            full: None,
            submitted: 0,
        }
    }

    fn cancel(&mut self) -> Result<(), ExecutorError> {
        self.errand.watcher.stopping();
        let ids = self
            .cases
            .iter()
            .filter_map(|case| case.ticket.as_ref()?.slurm_id.as_deref());
        Ok(commands::cancel(ids)?)
    }

    /// Asks where the jobs are; whether anything has changed.
    fn look(&mut self, stop: &Stop) -> Result<bool, ExecutorError> {
        let seen = match commands::sightings(&job_name(&self.settings.study)) {
            Ok(seen) => seen,
            Err(error) if self.unanswered >= MOST_UNANSWERED => return Err(error.into()),
            Err(_) => {
                self.unanswered += 1;
                return Ok(false);
            }
        };
        self.unanswered = 0;
        let mut changed = false;
        for position in (0..self.cases.len()).rev() {
            let slurm_id = self.cases[position]
                .ticket
                .as_ref()
                .and_then(|ticket| ticket.slurm_id.clone());
            let sighting = slurm_id.as_ref().and_then(|id| seen.get(id)).cloned();
            changed |= self.tell(position, sighting);
            if let Some(ending) = self.ending(position, stop)? {
                self.errand.end(self.cases.remove(position).job, ending);
                self.full = None;
                changed = true;
            }
        }
        Ok(changed)
    }

    /// Passes on what the queue and the run itself say; whether it is news.
    fn tell(&mut self, position: usize, sighting: Option<Sighting>) -> bool {
        let case = &mut self.cases[position];
        let job = &self.errand.jobs[case.job];
        let news = case.sighting != sighting;
        match &sighting {
            Some(Sighting::Queued { why }) if news => self.errand.watcher.queued(job, &waiting::reason(why)),
            Some(Sighting::Running) => {
                if news {
                    self.errand.watcher.started(job);
                }
                if let Some(reached) = self.errand.store.attempt(&job.id).and_then(|attempt| attempt.reached) {
                    self.errand.watcher.reached(job, &reached);
                }
            }
            _ => {}
        }
        let live = matches!(sighting, Some(Sighting::Queued { .. } | Sighting::Running));
        case.missed = if live { 0 } else { case.missed + 1 };
        case.sighting = sighting;
        news
    }

    /// How a case has ended; `None` if it has not, or not for certain.
    fn ending(&self, position: usize, stop: &Stop) -> Result<Option<Ending>, ExecutorError> {
        let case = &self.cases[position];
        let job = &self.errand.jobs[case.job];
        if case.missed > 0 {
            self.errand.store.look_anew(&job.id);
        }
        let state = self.errand.store.state(&job.id);
        let Some(Ticket {
            submitted,
            slurm_id: Some(slurm_id),
            ..
        }) = &case.ticket
        else {
            let done = matches!(&state, State::Done(manifest) if job.fresh.is_none_or(|since| manifest.ended >= since));
            return Ok(match state {
                State::Done(manifest) if done => Some(Ending::DoneElsewhere(manifest)),
                State::Running(_) => None,
                _ => stop.requested().then_some(Ending::NotStarted),
            });
        };
        match state {
            State::Done(manifest) if job.fresh.is_none_or(|since| manifest.ended >= since.min(*submitted)) => {
                return Ok(Some(Ending::Done(manifest)));
            }
            State::Failed(failure) if failure.ended >= *submitted => return Ok(Some(Ending::Failed(failure))),
            State::Running(_) => return Ok(None),
            _ if case.missed < LOOKS_FOR_A_RESULT => return Ok(None),
            _ => {}
        }
        let word = match &case.sighting {
            Some(Sighting::Ended(word)) => Some(word.clone()),
            _ => commands::accounted(&[slurm_id], *submitted).remove(slurm_id),
        };
        if stop.requested() || word.as_deref() == Some("CANCELLED") {
            return Ok(Some(Ending::Interrupted(self.errand.store.attempt(&job.id))));
        }
        self.fail(job, slurm_id, word.as_deref())
    }

    /// Writes down why a case has no result; nothing if another process works on it again.
    fn fail(&self, job: &Job, slurm_id: &str, word: Option<&str>) -> Result<Option<Ending>, ExecutorError> {
        let Some(mut claim) = self.errand.store.claim(&job.id)? else {
            return Ok(None);
        };
        if !claim.folder().exists() {
            claim.begin(&job.case_text, false)?;
        }
        let said = tail_of(&ticket::output(self.errand.store, slurm_id));
        let failure = claim.fail(None, ending::meaning(slurm_id, word), said)?;
        Ok(Some(Ending::Failed(Box::new(failure))))
    }
}

/// Waits, unless it is asked to stop and has not been told yet.
fn rest(pause: Duration, stop: &Stop, told: bool) {
    let start = Instant::now();
    while start.elapsed() < pause && !stop.insisted() && (told || !stop.requested()) {
        thread::sleep(HEED);
    }
}
