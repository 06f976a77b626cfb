use std::fs;

use super::claim::SOLVER_LOCK;
use super::{Attempt, Failure, Manifest, Store, files, seal};
use crate::durable;

/// What there is of a case.
#[derive(Clone, Debug, PartialEq)]
pub enum State {
    Missing,
    /// Interrupted; goes on from its last checkpoint. `None`: it was stopped before it could tell anything.
    Partial(Option<Attempt>),
    /// Another process works on it.
    Running(Option<Attempt>),
    Done(Box<Manifest>),
    Failed(Box<Failure>),
    /// It was published, and something has damaged it since.
    Corrupt {
        why: String,
    },
}

impl State {
    /// One word for tables and JSON.
    pub fn word(&self) -> &'static str {
        match self {
            State::Missing => "missing",
            State::Partial(_) => "partial",
            State::Running(_) => "running",
            State::Done(_) => "done",
            State::Failed(_) => "failed",
            State::Corrupt { .. } => "corrupt",
        }
    }
}

impl Store {
    /// State of a run as anybody sees it.
    pub fn state(&self, id: &str) -> State {
        let on_disk = self.state_on_disk(id);
        let unpublished = !matches!(on_disk, State::Done(_));
        if unpublished && files::is_locked(&self.lock_path(id)) {
            State::Running(self.attempt(id))
        } else {
            on_disk
        }
    }

    /// Opens the folders of a run anew: on a network that shows what another machine has written, where it otherwise
    /// may not be seen for a minute.
    pub fn look_anew(&self, id: &str) {
        for folder in [self.root.join("runs"), self.partial_folder(id), self.run_folder(id)] {
            // What is not there has nothing new to show.
            let _ = fs::read_dir(folder).map(Iterator::count);
        }
    }

    /// State of a run for the one who holds its lock.
    pub(super) fn state_on_disk(&self, id: &str) -> State {
        let partial = self.partial_folder(id);
        if self.run_folder(id).exists() {
            return match (self.known_damage(id), self.manifest(id)) {
                (None, Ok(manifest)) => State::Done(Box::new(manifest)),
                (Some(why), _) | (None, Err(why)) => State::Corrupt { why },
            };
        }
        if !partial.exists() {
            return State::Missing;
        }
        if files::is_locked(&partial.join(SOLVER_LOCK)) {
            return State::Running(self.attempt(id));
        }
        match files::read_json::<Failure>(&partial.join("failure.json")) {
            Ok(failure) => State::Failed(Box::new(failure)),
            Err(_) => State::Partial(self.attempt(id)),
        }
    }

    /// The manifest of a published run whose files are there in the sizes they were published with; otherwise what is wrong.
    pub(super) fn manifest(&self, id: &str) -> Result<Manifest, String> {
        let folder = self.run_folder(id);
        let text = durable::read_to_string(&folder.join("manifest.json"))
            .map_err(|error| format!("manifest.json cannot be read ({error})"))?;
        let manifest: Manifest =
            serde_json::from_str(&text).map_err(|error| format!("manifest.json is damaged ({error})"))?;
        if !manifest.seal.is_empty() && !seal::is_whole(&text, &manifest.seal) {
            return Err("manifest.json no longer holds what was published".to_owned());
        }
        if manifest.id != id {
            return Err(format!("manifest.json is of run {}", manifest.id));
        }
        for (name, &size) in &manifest.files {
            match fs::metadata(folder.join(name)) {
                Ok(metadata) if metadata.len() == size => {}
                Ok(metadata) => return Err(format!("{name} has {} bytes instead of {size}", metadata.len())),
                Err(error) => return Err(format!("{name} cannot be read ({error})")),
            }
        }
        Ok(manifest)
    }

    /// How far an unpublished run is; `None` where nothing was begun.
    pub fn attempt(&self, id: &str) -> Option<Attempt> {
        files::read_json(&self.partial_folder(id).join("attempt.json")).ok()
    }
}
