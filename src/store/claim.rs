//! Working on a run: one process at a time, in a folder aside, published by one rename.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

use jiff::Timestamp;

use super::cost::COST;
use super::manifest::host;
use super::{Attempt, ExitState, Failure, Manifest, Outcome, Program, Reached, State, Store, StoreError, files, seal};

/// Locked by the solver as long as it writes into a folder, even when the one who started it is gone.
pub const SOLVER_LOCK: &str = ".solver-lock";

const CASE: &str = "case.yaml";
const OUTCOME: &str = "outcome.json";
const MANIFEST: &str = "manifest.json";

/// The right to work on a run; given back when dropped.
#[derive(Debug)]
pub struct Claim {
    store: Store,
    id: String,
    attempt: Attempt,
    /// Wall time of the attempts before this one, s.
    wall_seconds_before: f64,
    clock: Instant,
    _lock: File,
}

impl Store {
    /// Takes a run for this process; `None` while another one has it.
    pub fn claim(&self, id: &str) -> Result<Option<Claim>, StoreError> {
        let Some(lock) = files::try_lock(&self.lock_path(id))? else {
            return Ok(None);
        };
        if files::is_locked(&self.partial_folder(id).join(SOLVER_LOCK)) {
            return Ok(None);
        }
        let attempt = self.attempt(id).unwrap_or_else(|| Attempt {
            program: Program::current(),
            attempts: 0,
            started: Timestamp::now(),
            wall_seconds: 0.0,
            reached: None,
        });
        Ok(Some(Claim {
            store: self.clone(),
            id: id.to_owned(),
            wall_seconds_before: attempt.wall_seconds,
            attempt,
            clock: Instant::now(),
            _lock: lock,
        }))
    }
}

impl Claim {
    /// State of the run, now that nobody else can change it.
    pub fn state(&self) -> State {
        self.store.state_on_disk(&self.id)
    }

    /// Whether there was an attempt before this time.
    pub fn began_before(&self, time: Timestamp) -> bool {
        self.attempt.attempts > 0 && self.attempt.started < time
    }

    pub fn folder(&self) -> PathBuf {
        self.store.partial_folder(&self.id)
    }

    /// Makes the folder ready for the solver: with the checkpoints of the attempt before, or empty if `from_start`.
    pub fn begin(&mut self, case_text: &str, from_start: bool) -> Result<(), StoreError> {
        let folder = self.folder();
        if from_start {
            files::remove(&folder)?;
            self.attempt.started = Timestamp::now();
            self.attempt.wall_seconds = 0.0;
            self.attempt.reached = None;
        }
        fs::create_dir_all(&folder).map_err(StoreError::write(&folder))?;
        // A kill may have come when all was ready to be published.
        files::set_read_only(&folder, false)?;
        files::remove(&folder.join("failure.json"))?;
        files::remove(&folder.join(OUTCOME))?;
        files::write(&folder.join(CASE), case_text.as_bytes())?;
        self.attempt.program = Program::current();
        self.attempt.attempts += 1;
        self.wall_seconds_before = self.attempt.wall_seconds;
        self.clock = Instant::now();
        self.write_attempt()
    }

    /// Remembers how far the run is, for those who look on and for the time after an interruption.
    pub fn note(&mut self, reached: Option<Reached>) -> Result<&Attempt, StoreError> {
        self.attempt.reached = reached.or(self.attempt.reached);
        self.attempt.wall_seconds = self.wall_seconds_before + self.clock.elapsed().as_secs_f64();
        self.write_attempt()?;
        Ok(&self.attempt)
    }

    /// What the solver has left at its end; `None` if it has not come so far.
    pub fn outcome(&self) -> Option<Outcome> {
        files::read_json(&self.folder().join(OUTCOME)).ok()
    }

    /// Makes the finished run visible under its id, complete or not at all.
    pub fn publish(
        mut self,
        outcome: Outcome,
        case_name: &str,
        case: &serde_json::Value,
        ranks: u32,
        threads: u32,
        slurm_job: Option<&str>,
    ) -> Result<Manifest, StoreError> {
        self.note(None)?;
        let folder = self.folder();
        // A manifest is there when a kill came just before the rename.
        for name in [OUTCOME, COST, SOLVER_LOCK, "attempt.json", "failure.json", MANIFEST] {
            files::remove(&folder.join(name))?;
        }
        let (files, blake3) = settle_files(&folder)?;
        let manifest = Manifest {
            id: self.id.clone(),
            case_name: case_name.to_owned(),
            case: case.clone(),
            program: self.attempt.program.clone(),
            host: host(),
            ranks,
            threads,
            slurm_job: slurm_job.map(str::to_owned),
            started: self.attempt.started,
            ended: Timestamp::now(),
            attempts: self.attempt.attempts,
            wall_seconds: self.attempt.wall_seconds,
            cores_times_wall: None,
            exit_state: ExitState::Done,
            outcome,
            files,
            blake3,
            seal: seal::OPEN.to_owned(),
        };
        let text = serde_json::to_string_pretty(&manifest).expect("a manifest always has a JSON form") + "\n";
        files::write(&folder.join(MANIFEST), seal::sealed(&text).as_bytes())?;
        // Who opens a published file to write would damage it unawares.
        files::set_read_only(&folder, true)?;
        files::sync(&folder)?;
        self.rename_into_place(&folder)?;
        Ok(manifest)
    }

    /// Keeps everything the failed run has written, with the reason beside it.
    pub fn fail(
        mut self,
        exit_code: Option<i32>,
        meaning: String,
        log_tail: Vec<String>,
    ) -> Result<Failure, StoreError> {
        self.note(None)?;
        let failure = Failure {
            exit_code,
            meaning,
            log_tail,
            ended: Timestamp::now(),
            attempts: self.attempt.attempts,
            program: self.attempt.program.clone(),
        };
        files::write_json(&self.folder().join("failure.json"), &failure)?;
        Ok(failure)
    }

    /// A run computed afresh takes the place of the old one, which nobody finds half removed.
    fn rename_into_place(&self, folder: &Path) -> Result<(), StoreError> {
        let published = self.store.run_folder(&self.id);
        let replaced = self.store.replaced_folder(&self.id);
        files::remove(&replaced)?;
        if published.exists() {
            fs::rename(&published, &replaced).map_err(StoreError::write(&published))?;
        }
        fs::rename(folder, &published).map_err(StoreError::write(&published))?;
        files::sync(&self.store.root().join("runs"))?;
        files::remove(&replaced)
    }

    fn write_attempt(&self) -> Result<(), StoreError> {
        files::write_json(&self.folder().join("attempt.json"), &self.attempt)
    }
}

/// Sizes (bytes) and checksums of files by name.
type Settled = (BTreeMap<String, u64>, BTreeMap<String, String>);

/// Flushes every file of a run to the disk, but for what a killed process has left half written; sizes and checksums by
/// name. What has just been written is still in memory, so that a checksum costs no reading of the disk.
fn settle_files(folder: &Path) -> Result<Settled, StoreError> {
    let (mut sizes, mut checksums) = (BTreeMap::new(), BTreeMap::new());
    for entry in fs::read_dir(folder).map_err(StoreError::read(folder))? {
        let path = entry.map_err(StoreError::read(folder))?.path();
        let metadata = fs::metadata(&path).map_err(StoreError::read(&path))?;
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name.ends_with(files::ASIDE) {
            files::remove(&path)?;
        } else if metadata.is_file() {
            files::sync(&path)?;
            let checksum = files::checksum(&path).map_err(StoreError::read(&path))?;
            sizes.insert(name.clone(), metadata.len());
            checksums.insert(name, checksum);
        }
    }
    Ok((sizes, checksums))
}

/// Keeps a second solver out of a folder, from the solver's side.
#[derive(Debug)]
pub struct FolderLock {
    _lock: File,
}

impl FolderLock {
    /// Makes the folder if need be, and waits for a solver that is just stopping; `None` if it does not stop in time.
    pub fn take(folder: &Path, patience: Duration) -> Result<Option<FolderLock>, StoreError> {
        fs::create_dir_all(folder).map_err(StoreError::write(folder))?;
        let path = folder.join(SOLVER_LOCK);
        let start = Instant::now();
        loop {
            if let Some(lock) = files::try_lock(&path)? {
                // Only solvers write these while a solver has the folder.
                for name in [CASE, OUTCOME, COST] {
                    files::remove_asides(folder, name)?;
                }
                return Ok(Some(FolderLock { _lock: lock }));
            }
            if start.elapsed() >= patience {
                return Ok(None);
            }
            thread::sleep(Duration::from_millis(100));
        }
    }
}

impl Outcome {
    /// Leaves the outcome where [`Claim::publish`] looks for it.
    pub fn write(&self, folder: &Path) -> Result<(), StoreError> {
        files::write_json(&folder.join(OUTCOME), self)
    }
}
