//! Sees a list of cases through: several at once, the longest first, none twice, none stopped by another's failure.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::ExitStatus;
use std::sync::mpsc::{self, Receiver, Sender};
use std::time::{Duration, Instant};

use jiff::Timestamp;

use super::exit::{self, Ended};
use super::local::{self, Event, Running};
use super::share::{Crew, Share};
use super::{Ending, Errand, ExecutorError, Progress, Stop, launch, mpi};
use crate::store::{Claim, Program, Reached, State, StoreError};

#[derive(Clone, Debug)]
pub struct Settings {
    pub solver: PathBuf,
    pub share: Share,
    /// The job of Slurm that all this happens in, such as `123_4`.
    pub slurm_job: Option<String>,
}

/// Computes all jobs; the endings are in the order of the jobs.
pub fn run<'a>(errand: Errand<'a>, settings: &'a Settings, stop: &Stop) -> Result<Vec<Ending>, ExecutorError> {
    let mut queue = Queue::new(errand, settings);
    let mut told = false;
    loop {
        if stop.requested() && !told {
            told = true;
            queue.interrupt();
        }
        if stop.insisted() {
            queue.running.iter_mut().for_each(|work| work.process.kill());
        }
        if !stop.requested() {
            queue.start_what_fits()?;
        }
        queue.collect(stop.requested())?;
        if queue.running.is_empty() && (stop.requested() || queue.waiting.is_empty()) {
            return Ok(queue.errand.endings);
        }
        if let Ok(Event::Progress(job, progress)) = queue.listen.recv_timeout(POLL) {
            queue.progress(job, &progress)?;
        }
    }
}

/// How long an ended child, a freed run or a Ctrl-C may go unseen.
const POLL: Duration = Duration::from_millis(50);
/// Time between two notes in the store of how far a case is.
const NOTE_EVERY: Duration = Duration::from_secs(2);
/// Lines of its log that a failed case shows.
const LOG_TAIL: usize = 20;

struct Queue<'a> {
    errand: Errand<'a>,
    settings: &'a Settings,
    /// Still to be started, the longest last.
    waiting: Vec<usize>,
    running: Vec<Work>,
    speak: Sender<Event>,
    listen: Receiver<Event>,
}

struct Work {
    job: usize,
    process: Running,
    claim: Claim,
    crew: Crew,
    reached: Option<Reached>,
    /// When the store was last told of it.
    noted: Instant,
}

impl<'a> Queue<'a> {
    fn new(errand: Errand<'a>, settings: &'a Settings) -> Self {
        let (speak, listen) = mpsc::channel();
        let mut waiting: Vec<usize> = (0..errand.jobs.len()).collect();
        let duration = |job: usize| settings.share.duration(&errand.jobs[job].demand());
        waiting.sort_by(|&a, &b| duration(a).total_cmp(&duration(b)).then(b.cmp(&a)));
        Queue {
            errand,
            settings,
            waiting,
            running: Vec::new(),
            speak,
            listen,
        }
    }

    fn start_what_fits(&mut self) -> Result<(), ExecutorError> {
        for job in self.waiting.clone().into_iter().rev() {
            let at_work: Vec<Crew> = self.running.iter().map(|work| work.crew).collect();
            // A wide case is not overtaken by narrow ones behind it, or it would wait for all of them.
            if !self.settings.share.has_room(&at_work, self.crew(job)) {
                return Ok(());
            }
            if let Some(claim) = self.errand.store.claim(&self.errand.jobs[job].id)? {
                self.waiting.retain(|&other| other != job);
                self.start_or_skip(job, claim)?;
            } else {
                self.errand.tell_busy(job);
            }
        }
        Ok(())
    }

    fn crew(&self, job: usize) -> Crew {
        self.settings.share.crew(&self.errand.jobs[job].demand())
    }

    fn start_or_skip(&mut self, number: usize, mut claim: Claim) -> Result<(), ExecutorError> {
        let job = &self.errand.jobs[number];
        let state = claim.state();
        match state {
            State::Done(manifest) if job.fresh.is_none_or(|since| manifest.ended >= since) => {
                self.errand.end(number, Ending::DoneElsewhere(manifest));
                return Ok(());
            }
            _ => {
                let over = job
                    .fresh
                    .map_or_else(|| starts_over(&state), |since| claim.began_before(since));
                claim.begin(&job.case_text, over)?;
            }
        }
        let folder = claim.folder();
        let crew = self.crew(number);
        let mut command = launch::launch(&self.settings.solver, &folder, crew);
        if crew.ranks > 1 && self.settings.slurm_job.is_some() {
            command = mpi::shielded(command);
        }
        let log = open_log(&folder, &command)?;
        let process = local::start(number, &command, log, self.speak.clone())?;
        self.errand.watcher.started(job);
        self.running.push(Work {
            job: number,
            process,
            claim,
            crew,
            reached: None,
            noted: Instant::now() - NOTE_EVERY,
        });
        Ok(())
    }

    fn progress(&mut self, job: usize, progress: &Progress) -> Result<(), ExecutorError> {
        let Some(work) = self.running.iter_mut().find(|work| work.job == job) else {
            return Ok(());
        };
        work.reached = Some(Reached {
            step: progress.step,
            of: progress.of,
            percent: progress.percent,
        });
        if work.noted.elapsed() >= NOTE_EVERY {
            work.noted = Instant::now();
            work.claim.note(work.reached)?;
        }
        self.errand.watcher.progress(&self.errand.jobs[job], progress);
        Ok(())
    }

    /// Takes in those that have ended.
    fn collect(&mut self, stopping: bool) -> Result<(), ExecutorError> {
        for position in (0..self.running.len()).rev() {
            if let Some(status) = self.running[position].process.ended() {
                // What it said last may still be on its way.
                while let Ok(Event::Progress(job, progress)) = self.listen.try_recv() {
                    self.progress(job, &progress)?;
                }
                let work = self.running.remove(position);
                let job = work.job;
                let ending = self.ending_of(work, status, stopping)?;
                self.errand.end(job, ending);
            }
        }
        Ok(())
    }

    fn ending_of(&self, mut work: Work, status: ExitStatus, stopping: bool) -> Result<Ending, ExecutorError> {
        let job = &self.errand.jobs[work.job];
        let tail = tail_of(&work.claim.folder().join("log.txt"));
        let several = work.crew.ranks > 1;
        let ended = if several {
            Ended::of_ranks(status, &tail)
        } else {
            Ended::of(status)
        };
        if ended.is_interruption() || (stopping && ended.code().is_none()) {
            return Ok(Ending::Interrupted(Some(work.claim.note(work.reached)?.clone())));
        }
        // The last that a solver writes. Ranks that end badly after it have nothing more to do, whatever mpirun says of them.
        let outcome = work.claim.outcome().filter(|_| status.success() || several);
        if let Some(outcome) = outcome {
            let Crew { ranks, threads } = work.crew;
            let slurm_job = self.settings.slurm_job.as_deref();
            let manifest = work
                .claim
                .publish(outcome, &job.name, &job.case, ranks, threads, slurm_job)?;
            self.errand.store.link(&job.name, &job.id)?;
            return Ok(Ending::Done(Box::new(manifest)));
        }
        let meaning = if status.success() {
            "the solver ended without a result; `cgaft` and `cgaft-solve` are perhaps of different versions: install \
             both again"
                .to_owned()
        } else {
            ended.meaning()
        };
        Ok(Ending::Failed(Box::new(work.claim.fail(
            ended.code(),
            meaning,
            tail,
        )?)))
    }

    fn interrupt(&mut self) {
        self.errand.watcher.stopping();
        self.running.iter_mut().for_each(|work| work.process.interrupt());
    }
}

/// Whether the checkpoints of the attempt before are of no use: they may hold the blow-up, or another version wrote them.
pub fn starts_over(state: &State) -> bool {
    let version = |program: &Program| {
        let current = Program::current();
        (&program.version, &program.commit) != (&current.version, &current.commit)
    };
    match state {
        State::Failed(failure) => {
            failure.exit_code == Some(i32::from(exit::PHYSICS_FAILED)) || version(&failure.program)
        }
        State::Partial(Some(attempt)) => version(&attempt.program),
        State::Missing | State::Partial(None) | State::Running(_) => false,
        State::Done(_) | State::Corrupt { .. } => true,
    }
}

fn open_log(folder: &Path, command: &launch::Launch) -> Result<File, ExecutorError> {
    use std::io::Write;
    let path = folder.join("log.txt");
    let open = || {
        let mut log = File::options().create(true).append(true).open(&path)?;
        writeln!(log, "{} {command}", Timestamp::now().strftime("%F %T UTC"))?;
        Ok(log)
    };
    let log = open().map_err(|source| StoreError::Write {
        path: path.clone(),
        source,
    })?;
    Ok(log)
}

/// The last lines of a log, of which only the end is shown.
pub fn tail_of(log: &Path) -> Vec<String> {
    let bytes = fs::read(log).unwrap_or_default();
    let end = &bytes[bytes.len().saturating_sub(1 << 16)..];
    let text = String::from_utf8_lossy(end);
    let lines: Vec<&str> = text.lines().collect();
    lines[lines.len().saturating_sub(LOG_TAIL)..]
        .iter()
        .map(|line| (*line).to_owned())
        .collect()
}
