//! Cases as jobs of Slurm: handed over in arrays, watched by one query, each published by its own job.
//!
//! A job is `cgaft slurm-job`, which computes one case on its node as `study run` would on this machine ([`job`]). So
//! nothing of a case depends on the terminal that submitted it, and whoever looks on needs the store and `squeue` only.

pub mod commands;
mod ending;
pub mod job;
mod script;
mod ticket;
mod waiting;
mod watch;

pub use commands::{Sighting, SlurmError};
pub use script::{Script, Setting, scripts};
pub use ticket::Ticket;
pub use waiting::reason;
pub use watch::{Settings, run};

use std::collections::{BTreeSet, HashMap};
use std::fs;

use jiff::Timestamp;

use super::ExecutorError;
use crate::store::{Store, StoreError};

/// What the queue tells of a case that was handed over.
#[derive(Clone, Debug)]
pub struct Whereabouts {
    /// Such as `123_4`.
    pub slurm_id: String,
    pub submitted: Timestamp,
    /// `None`: Slurm no longer knows it.
    pub sighting: Result<Option<Sighting>, String>,
}

impl Whereabouts {
    /// It waits or is at work.
    pub fn is_live(&self) -> bool {
        matches!(self.sighting, Ok(Some(Sighting::Queued { .. } | Sighting::Running)))
    }

    /// What became of a job that has ended.
    pub fn fact(&self) -> String {
        let word = match &self.sighting {
            Ok(Some(Sighting::Ended(state))) => Some(state.as_str()),
            _ => None,
        };
        ending::fact(&self.slurm_id, word)
    }
}

/// Where the jobs of these cases are, by case id; asks Slurm once, and only if one of them was handed over.
pub fn whereabouts<'a>(
    store: &Store,
    study: &str,
    ids: impl IntoIterator<Item = &'a str>,
) -> HashMap<String, Whereabouts> {
    let posted: Vec<(&str, String, Timestamp)> = ids
        .into_iter()
        .filter_map(|id| Ticket::read(store, id).and_then(|ticket| Some((id, ticket.slurm_id?, ticket.submitted))))
        .collect();
    if posted.is_empty() {
        return HashMap::new();
    }
    let seen = commands::sightings(&job_name(study)).map_err(|error| error.to_string());
    let whereabouts = |(id, slurm_id, submitted): (&str, String, Timestamp)| {
        let sighting = seen.as_ref().map(|seen| seen.get(&slurm_id).cloned());
        let whereabouts = Whereabouts {
            sighting: sighting.map_err(String::clone),
            slurm_id,
            submitted,
        };
        (id.to_owned(), whereabouts)
    };
    posted.into_iter().map(whereabouts).collect()
}

/// Forgets the jobs that are over, and what they said; those of these cases are kept.
pub fn forget(store: &Store, kept: &BTreeSet<String>) -> Result<(), ExecutorError> {
    let folder = ticket::folder(store);
    let kept: Vec<String> = kept
        .iter()
        .flat_map(|id| {
            [
                Some(id.clone()),
                Ticket::read(store, id).and_then(|ticket| ticket.slurm_id),
            ]
        })
        .flatten()
        .collect();
    for path in fs::read_dir(&folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path())
    {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        if !kept.iter().any(|kept| *kept == stem) {
            fs::remove_file(&path).map_err(|source| StoreError::Write { path, source })?;
        }
    }
    Ok(())
}

/// By which all jobs of a study are asked for at once.
pub fn job_name(study: &str) -> String {
    format!("cgaft-{study}")
}
