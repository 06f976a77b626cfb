//! Cases as jobs of Slurm: handed over in arrays, watched by one query, each published by its own job.
//!
//! A job is `cgaft slurm-job`, which computes one case on its node as `study run` would on this machine ([`job`]). So
//! nothing of a case depends on the terminal that submitted it, and whoever looks on needs the store and `squeue` only.

pub mod commands;
mod ending;
pub mod job;
mod script;
mod ticket;
mod watch;

pub use commands::{Sighting, SlurmError};
pub use script::{Script, Setting, scripts};
pub use ticket::Ticket;
pub use watch::{Settings, run};

use std::collections::HashMap;

use crate::store::Store;

/// What the queue tells of a case that was handed over.
#[derive(Clone, Debug)]
pub struct Whereabouts {
    /// Such as `123_4`.
    pub slurm_id: String,
    /// `None`: Slurm no longer knows it.
    pub sighting: Result<Option<Sighting>, String>,
}

impl Whereabouts {
    /// It waits or is at work.
    pub fn is_live(&self) -> bool {
        matches!(self.sighting, Ok(Some(Sighting::Queued { .. } | Sighting::Running)))
    }

    /// How the job ended, if it did, in words.
    pub fn ending(&self) -> Option<String> {
        match &self.sighting {
            Ok(Some(Sighting::Ended(state))) => Some(ending::meaning(&self.slurm_id, Some(state))),
            Ok(None) => Some(ending::meaning(&self.slurm_id, None)),
            _ => None,
        }
    }
}

/// Where the jobs of these cases are, by case id; asks Slurm once, and only if one of them was handed over.
pub fn whereabouts<'a>(
    store: &Store,
    study: &str,
    ids: impl IntoIterator<Item = &'a str>,
) -> HashMap<String, Whereabouts> {
    let posted: Vec<(&str, String)> = ids
        .into_iter()
        .filter_map(|id| Some((id, Ticket::read(store, id)?.slurm_id?)))
        .collect();
    if posted.is_empty() {
        return HashMap::new();
    }
    let seen = commands::sightings(&job_name(study)).map_err(|error| error.to_string());
    let of = |slurm_id: &str| {
        seen.as_ref()
            .map(|seen| seen.get(slurm_id).cloned())
            .map_err(String::clone)
    };
    posted
        .into_iter()
        .map(|(id, slurm_id)| {
            let sighting = of(&slurm_id);
            (id.to_owned(), Whereabouts { slurm_id, sighting })
        })
        .collect()
}

/// By which all jobs of a study are asked for at once.
pub fn job_name(study: &str) -> String {
    format!("cgaft-{study}")
}
