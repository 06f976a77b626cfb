//! What a run has cost over all its attempts: `cost.json`, replaced with every checkpoint.
//!
//! It stands beside the checkpoint and not in it, so that the checkpoint of an interrupted run is that of a whole one.
//! What a kill took away since the last checkpoint is in the wall time, and nowhere here.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{Phase, StoreError, files};

pub(super) const COST: &str = "cost.json";

/// What attempts have spent.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spent {
    /// Time that processors worked for all ranks and threads, s.
    pub core_seconds: f64,
    /// Where the wall time went.
    pub phases: Vec<Phase>,
}

/// The account of a run.
#[derive(Clone, Debug)]
pub struct Account {
    path: PathBuf,
    /// Of the attempts before this one.
    before: Spent,
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
    pub fn save(&self, attempt: &Spent) -> Result<(), StoreError> {
        files::write_json(&self.path, &self.total(attempt))
    }

    /// All attempts together, phase by phase.
    pub fn total(&self, attempt: &Spent) -> Spent {
        let mut total = self.before.clone();
        total.core_seconds += attempt.core_seconds;
        for phase in &attempt.phases {
            match total.phases.iter_mut().find(|known| known.name == phase.name) {
                Some(known) => {
                    known.calls += phase.calls;
                    known.seconds += phase.seconds;
                }
                None => total.phases.push(phase.clone()),
            }
        }
        total
    }
}
