//! Sees a list of cases through: several at once, the longest first, none twice, none stopped by another's failure. Towards
//! the end cores that nobody waits for go to the case that has the longest way to go.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::ExitStatus;
use std::sync::mpsc::{self, Receiver, Sender};
use std::time::{Duration, Instant};

use jiff::Timestamp;

use super::exit::{self, Ended};
use super::local::{self, Event, Running};
use super::share::{Crew, Share};
use super::{Ending, Errand, ExecutorError, Launch, Progress, Stop, launch, mpi};
use crate::durable;
use crate::store::{Claim, Program, Reached, State, StoreError};

#[derive(Clone, Debug)]
pub struct Settings {
    pub solver: PathBuf,
    pub share: Share,
    /// What a case must have before it so that more threads are worth a start from its checkpoint.
    pub worth_a_restart: Duration,
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
            queue.lend_idle_cores();
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
/// What a case must have before it to be started again with more threads: a checkpoint and a set-up take some seconds.
pub const WORTH_A_RESTART: Duration = Duration::from_secs(20);
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
    /// Who is to go on with it from the checkpoint that it has been asked for.
    successor: Option<Crew>,
    /// When this attempt was first heard of, and how far it was then, percent.
    first_heard: Option<(Instant, f64)>,
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
        self.start(number, claim, self.crew(number))?;
        self.errand.watcher.started(&self.errand.jobs[number]);
        Ok(())
    }

    fn start(&mut self, number: usize, claim: Claim, crew: Crew) -> Result<(), ExecutorError> {
        let folder = claim.folder();
        let mut command = launch::launch(&self.settings.solver, &folder, crew);
        if crew.ranks > 1 && self.settings.slurm_job.is_some() {
            command = mpi::shielded(command);
        }
        let log = open_log(&folder, &command)?;
        let process = local::start(number, &command, log, self.speak.clone())?;
        self.running.push(Work {
            job: number,
            process,
            claim,
            crew,
            successor: None,
            first_heard: None,
            reached: None,
            noted: Instant::now() - NOTE_EVERY,
        });
        Ok(())
    }

    /// Asks the case that has the longest way to go for a checkpoint, from which it goes on with the cores that are idle.
    fn lend_idle_cores(&mut self) {
        if !self.waiting.is_empty() || self.running.iter().any(|work| work.successor.is_some()) {
            return;
        }
        let at_work: Vec<Crew> = self.running.iter().map(|work| work.crew).collect();
        let (share, jobs) = (&self.settings.share, self.errand.jobs);
        let widened = |work: &Work| share.widened(work.crew, &jobs[work.job].demand(), &at_work);
        let candidates = self.running.iter_mut().filter(|work| widened(work) != work.crew);
        let longest = candidates.max_by_key(|work| work.left());
        if let Some(work) = longest.filter(|work| work.left() > self.settings.worth_a_restart) {
            work.successor = Some(widened(work));
            work.process.interrupt();
        }
    }

    fn progress(&mut self, job: usize, progress: &Progress) -> Result<(), ExecutorError> {
        let Some(work) = self.running.iter_mut().find(|work| work.job == job) else {
            return Ok(());
        };
        work.first_heard.get_or_insert((Instant::now(), progress.percent));
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
                while let Ok(event) = self.listen.try_recv() {
                    if let Event::Progress(job, progress) = event {
                        self.progress(job, &progress)?;
                    }
                }
                let mut work = self.running.remove(position);
                let job = work.job;
                let successor = work.successor.take().filter(|_| !stopping);
                if let Some(crew) = successor.filter(|_| ended_of(&work, status).is_interruption()) {
                    self.hand_over(work, crew)?;
                    continue;
                }
                let ending = self.ending_of(work, status, stopping)?;
                self.errand.end(job, ending);
            }
        }
        Ok(())
    }

    /// Goes on with a case from its checkpoint.
    fn hand_over(&mut self, work: Work, crew: Crew) -> Result<(), ExecutorError> {
        let Work {
            job,
            mut claim,
            reached,
            ..
        } = work;
        claim.note(reached)?;
        claim.begin(&self.errand.jobs[job].case_text, false)?;
        self.start(job, claim, crew)?;
        self.errand.watcher.widened(&self.errand.jobs[job], crew.cores());
        Ok(())
    }

    fn ending_of(&self, mut work: Work, status: ExitStatus, stopping: bool) -> Result<Ending, ExecutorError> {
        let job = &self.errand.jobs[work.job];
        let several = work.crew.ranks > 1;
        let ended = ended_of(&work, status);
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
        let tail = log_tail(&work);
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

impl Work {
    /// How long it will go on at the pace of this attempt; zero as long as that is not known.
    fn left(&self) -> Duration {
        let (Some((since, from)), Some(reached)) = (self.first_heard, self.reached) else {
            return Duration::ZERO;
        };
        let pace = since.elapsed().as_secs_f64() / (reached.percent - from);
        Duration::try_from_secs_f64((100.0 - reached.percent) * pace).unwrap_or_default()
    }
}

fn ended_of(work: &Work, status: ExitStatus) -> Ended {
    match work.crew.ranks {
        1 => Ended::of(status),
        _ => Ended::of_ranks(status, &log_tail(work)),
    }
}

fn log_tail(work: &Work) -> Vec<String> {
    tail_of(&work.claim.folder().join("log.txt"))
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

fn open_log(folder: &Path, command: &Launch) -> Result<File, ExecutorError> {
    use std::io::Write;
    let path = folder.join("log.txt");
    let open = || {
        let mut log = durable::append(&path)?;
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
    let bytes = durable::read(log).unwrap_or_default();
    let end = &bytes[bytes.len().saturating_sub(1 << 16)..];
    let text = String::from_utf8_lossy(end);
    let lines: Vec<&str> = text.lines().collect();
    lines[lines.len().saturating_sub(LOG_TAIL)..]
        .iter()
        .map(|line| (*line).to_owned())
        .collect()
}
