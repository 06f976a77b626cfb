//! The small JSON files that tell what became of a case.

use std::collections::BTreeMap;
use std::path::Path;

use jiff::Timestamp;
use serde::{Deserialize, Serialize};

use crate::durable;

/// Provenance of a published run: `manifest.json`, written last, never edited.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    pub id: String,
    /// Name of the case when it was run; another study may know the same run by another name.
    pub case_name: String,
    /// The resolved case with the keys and units of a study file.
    pub case: serde_json::Value,
    pub program: Program,
    /// `None` where the machine does not tell its name.
    pub host: Option<String>,
    pub ranks: u32,
    /// Threads per rank, at the end.
    pub threads: u32,
    /// The job of Slurm that published it, such as `123_4`; `None` outside Slurm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slurm_job: Option<String>,
    /// Of the first attempt.
    pub started: Timestamp,
    pub ended: Timestamp,
    /// How often the case was started or resumed until it was done.
    pub attempts: u32,
    /// Wall time of all attempts together, s.
    pub wall_seconds: f64,
    /// Wall time times cores, in manifests from before processor time was measured; nobody asks for it any more.
    #[serde(default, skip_serializing, rename = "core_seconds")]
    pub cores_times_wall: Option<f64>,
    /// Always `done` here: other endings are never published.
    pub exit_state: ExitState,
    pub outcome: Outcome,
    /// Size of every file of the run, bytes; a run that no longer matches is corrupt.
    pub files: BTreeMap<String, u64>,
    /// BLAKE3 of every file of the run, hexadecimal; empty in manifests from before there were any.
    #[serde(default)]
    pub blake3: BTreeMap<String, String>,
    /// Of the manifest itself; empty in manifests from before there was one.
    #[serde(default)]
    pub seal: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ExitState {
    Done,
}

/// What the solver tells at its end: `outcome.json`, moved into the manifest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// Why the run stopped, such as `strain 0.035 reached`.
    pub end_reason: String,
    pub steps: u64,
    /// Time step used, and the largest stable one, ps.
    pub time_step_ps: f64,
    pub stability_limit_ps: f64,
    /// Largest energy imbalance over the largest work; `None` where nothing has done work.
    pub energy_error_relative: Option<f64>,
    /// The closest that sites have come, as a share of the lattice spacing; `None` where none were closer than in a regular
    /// lattice, and from before it was told.
    #[serde(default)]
    pub closest_approach_spacings: Option<f64>,
    /// Largest memory of any rank in the last attempt; `None` where the system does not tell.
    pub peak_memory_bytes: Option<u64>,
    /// Time that processors worked for all ranks and threads of all attempts, s; `None` from before it was measured.
    #[serde(default)]
    pub core_seconds: Option<f64>,
    /// Where the wall time of all attempts went.
    pub cost: Vec<Phase>,
    /// What messages between its ranks cost; `None` for one rank.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub messages: Option<MessageCost>,
}

/// Measured at the end of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MessageCost {
    /// Of the shortest message between two ranks, s.
    pub latency_s: f64,
    pub seconds_a_byte: f64,
    /// Of a reduction between all ranks, a doubling of their number, s.
    pub reduction_s: f64,
}

/// Time spent in one part of the computation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Phase {
    pub name: String,
    pub calls: u64,
    pub seconds: f64,
}

/// The program that computed a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Program {
    pub version: String,
    /// `None` when it was not built inside a git repository.
    pub commit: Option<String>,
    pub features: Vec<String>,
}

impl Program {
    /// This program.
    pub fn current() -> Program {
        Program {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            commit: option_env!("CGAFT_COMMIT")
                .filter(|text| !text.is_empty())
                .map(str::to_owned),
            features: env!("CGAFT_FEATURES").split_whitespace().map(str::to_owned).collect(),
        }
    }
}

/// How far an unpublished run is: `attempt.json`, replaced every few seconds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Attempt {
    pub program: Program,
    pub attempts: u32,
    pub started: Timestamp,
    /// Wall time of all attempts so far, s.
    pub wall_seconds: f64,
    /// `None` until the solver has told it.
    pub reached: Option<Reached>,
}

/// Steps taken out of how many.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reached {
    pub step: u64,
    pub of: u64,
    pub percent: f64,
}

/// Why an unpublished run ended: `failure.json`, beside its log and all that it had written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Failure {
    /// `None` when a signal ended it.
    pub exit_code: Option<i32>,
    /// In words, such as `physics failed`.
    pub meaning: String,
    /// The end of its log.
    pub log_tail: Vec<String>,
    pub ended: Timestamp,
    pub attempts: u32,
    pub program: Program,
}

/// Name of this machine.
pub fn host() -> Option<String> {
    let name = durable::read_to_string(Path::new("/proc/sys/kernel/hostname"))
        .ok()
        .or_else(|| std::env::var("HOSTNAME").ok())?;
    Some(name.trim().to_owned()).filter(|name| !name.is_empty())
}
