//! What a run has cost over all its attempts: `cost.json`, replaced with every checkpoint.
//!
//! It stands beside the checkpoint and not in it, so that the checkpoint of an interrupted run is that of a whole one.
//! What a kill took away since the last checkpoint is in the wall time, and in no phase.

use std::path::{Path, PathBuf};

use super::{Phase, StoreError, files};

pub(super) const COST: &str = "cost.json";

/// The account of a run.
#[derive(Clone, Debug)]
pub struct Account {
    path: PathBuf,
    /// Of the attempts before this one.
    before: Vec<Phase>,
}

impl Account {
    /// Goes on with the account in a folder; one that is not there or cannot be read begins with nothing.
    pub fn open(folder: &Path) -> Account {
        let path = folder.join(COST);
        Account {
            before: files::read_json(&path).unwrap_or_default(),
            path,
        }
    }

    /// Replaces the account by what there was and what this attempt has cost so far.
    pub fn save(&self, attempt: &[Phase]) -> Result<(), StoreError> {
        files::write_json(&self.path, &self.total(attempt))
    }

    /// All attempts together, phase by phase.
    pub fn total(&self, attempt: &[Phase]) -> Vec<Phase> {
        let mut total = self.before.clone();
        for phase in attempt {
            match total.iter_mut().find(|known| known.name == phase.name) {
                Some(known) => {
                    known.calls += phase.calls;
                    known.seconds += phase.seconds;
                }
                None => total.push(phase.clone()),
            }
        }
        total
    }
}
