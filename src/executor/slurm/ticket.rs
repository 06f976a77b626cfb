use std::fs;
use std::path::PathBuf;

use jiff::Timestamp;
use serde::{Deserialize, Serialize};

use crate::durable;
use crate::executor::{ExecutorError, Job};
use crate::store::{self, Store, StoreError};

/// What a job is to compute, where it finds it and where others find the job: `.slurm/<id>.json` beside the runs.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Ticket {
    pub job: Job,
    pub threads: u32,
    pub submitted: Timestamp,
    /// Such as `123_4`; `None` until Slurm has taken it.
    pub slurm_id: Option<String>,
}

impl Ticket {
    /// The ticket of a case; `None` if it was never handed over.
    pub fn read(store: &Store, id: &str) -> Option<Ticket> {
        let text = durable::read_to_string(&path(store, id)).ok()?;
        serde_json::from_str(&text).ok()
    }

    pub fn write(&self, store: &Store) -> Result<(), ExecutorError> {
        let path = path(store, &self.job.id);
        let folder = folder(store);
        fs::create_dir_all(&folder).map_err(|source| StoreError::Write { path: folder, source })?;
        let text = serde_json::to_vec_pretty(self).expect("a ticket has a JSON form");
        Ok(store::write(&path, &text)?)
    }

    /// Takes it back: Slurm would not have it.
    pub fn withdraw(&self, store: &Store) -> Result<(), ExecutorError> {
        let path = path(store, &self.job.id);
        Ok(fs::remove_file(&path).map_err(|source| StoreError::Write { path, source })?)
    }
}

/// Where a job's own output goes: what its shell and its node say.
pub fn output(store: &Store, slurm_id: &str) -> PathBuf {
    folder(store).join(format!("{slurm_id}.out"))
}

pub fn folder(store: &Store) -> PathBuf {
    store.root().join(".slurm")
}

fn path(store: &Store, id: &str) -> PathBuf {
    folder(store).join(format!("{id}.json"))
}
