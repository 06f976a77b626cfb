//! What is said to Slurm, and what it answers.

use std::collections::HashMap;
use std::io::{self, Write};
use std::process::{Command, Stdio};

use jiff::Timestamp;

/// What Slurm refused or did not understand.
#[derive(Debug, thiserror::Error)]
pub enum SlurmError {
    #[error(
        "cannot start `{program}`: {source}; Slurm is not on this machine or not on the PATH: log in where `sbatch` \
         works, or leave out `--on slurm`"
    )]
    Missing { program: &'static str, source: io::Error },
    #[error(
        "`{program}` refused: {words}; correct `cluster:` in the study or in the profile, or ask the people who run \
         the cluster"
    )]
    Refused { program: &'static str, words: String },
    #[error(
        "{source}. Before that these were submitted and run on, {submitted} in all: `cgaft study status` tells how far they are, \
         `cgaft study cancel` ends them"
    )]
    Halfway { submitted: usize, source: Box<SlurmError> },
    #[error(
        "`{program}` answered `{answer}`, which is nothing that it should say; is another program of that name \
         first on the PATH? Jobs that were submitted run on"
    )]
    Garbage { program: &'static str, answer: String },
}

/// What the queue says of a job.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Sighting {
    /// With Slurm's word for why it waits, such as `Resources`.
    Queued {
        why: String,
    },
    Running,
    /// With Slurm's word for how, such as `TIMEOUT`.
    Ended(String),
}

impl SlurmError {
    /// Whether there are as many jobs as Slurm takes of this user or at all, so that there is room when some have ended.
    pub fn is_for_want_of_room(&self) -> bool {
        let Self::Refused { words, .. } = self else {
            return false;
        };
        // `AssocMaxSubmitJobLimit`, `QOSMaxSubmitJobPerUserLimit`, `AssocGrpSubmitJobsLimit`; or what older ones say of any.
        let by_name = words.contains("SubmitJob") && words.contains("Limit");
        by_name || words.contains("job submit limit") || words.contains("temporarily unable to accept job")
    }

    /// What Slurm itself said, in one line.
    pub fn words(&self) -> String {
        match self {
            Self::Refused { words, .. } => words.lines().map(str::trim).collect::<Vec<_>>().join(" "),
            other => other.to_string(),
        }
    }
}

/// Hands over a script; the number of its array.
pub fn submit(script: &str) -> Result<u64, SlurmError> {
    let answer = ask("sbatch", &["--parsable"], script)?;
    // `123`, or `123;cluster` where there are several.
    let number = answer.trim().split(';').next().unwrap_or_default();
    number.parse().map_err(|_| garbage("sbatch", &answer))
}

/// All jobs of this name that wait, run or ended lately, by their ids.
pub fn sightings(job_name: &str) -> Result<HashMap<String, Sighting>, SlurmError> {
    let name = format!("--name={job_name}");
    let arguments = ["--noheader", "--array", "--states=all", "--format=%i|%T|%r", &name];
    let answer = ask("squeue", &arguments, "")?;
    let lines = answer.lines().map(str::trim).filter(|line| !line.is_empty());
    lines
        .map(|line| sighting(line).ok_or_else(|| garbage("squeue", line)))
        .collect()
}

/// `123_4|PENDING|Resources`
fn sighting(line: &str) -> Option<(String, Sighting)> {
    let (id, rest) = line.split_once('|')?;
    let (state, why) = rest.split_once('|')?;
    let is_id = id.starts_with(|letter: char| letter.is_ascii_digit());
    let is_state = !state.is_empty() && state.chars().all(|letter| letter.is_ascii_uppercase() || letter == '_');
    if !is_id || !is_state {
        return None;
    }
    let sighting = match state {
        "PENDING" | "REQUEUED" | "REQUEUE_HOLD" | "REQUEUE_FED" | "SPECIAL_EXIT" | "RESV_DEL_HOLD" => {
            Sighting::Queued { why: why.to_owned() }
        }
        "RUNNING" | "CONFIGURING" | "COMPLETING" | "SUSPENDED" | "STOPPED" | "SIGNALING" | "STAGE_OUT" | "RESIZING" => {
            Sighting::Running
        }
        ended => Sighting::Ended(ended.to_owned()),
    };
    Some((id.to_owned(), sighting))
}

/// How jobs ended that the queue has forgotten, where accounting is kept and open to users; else nothing.
pub fn accounted(ids: &[&str], since: Timestamp) -> HashMap<String, String> {
    let jobs = format!("--jobs={}", ids.join(","));
    // Without a start it tells of today only.
    let start = format!("--starttime={}", since.strftime("%Y-%m-%d"));
    let arguments = [
        "--noheader",
        "--parsable2",
        "--allocations",
        "--format=JobID,State",
        &jobs,
        &start,
    ];
    let answer = ask("sacct", &arguments, "").unwrap_or_default();
    let state = |line: &str| {
        let (id, state) = line.split_once('|')?;
        // `CANCELLED by 1000`
        Some((id.to_owned(), state.split_whitespace().next()?.to_owned()))
    };
    answer.lines().filter_map(state).collect()
}

/// Ends jobs: those that wait at once, those at work with SIGTERM and time for a checkpoint.
pub fn cancel<'a>(ids: impl IntoIterator<Item = &'a str>) -> Result<(), SlurmError> {
    let ids: Vec<&str> = ids.into_iter().collect();
    for some in ids.chunks(500) {
        let arguments = [&["--quiet"], some].concat();
        ask("scancel", &arguments, "")?;
    }
    Ok(())
}

/// Slurm as it comes allows 1,001 tasks in an array; more cases than this do not read well in one.
const LONGEST_ARRAY: usize = 1000;

/// Tasks that one array may have here; 0 where there are no arrays.
pub fn longest_array() -> usize {
    let config = ask("scontrol", &["show", "config"], "").unwrap_or_default();
    let value = config.lines().find_map(|line| {
        let (key, value) = line.split_once('=')?;
        (key.trim() == "MaxArraySize").then(|| value.trim().parse::<usize>().ok())?
    });
    value.map_or(LONGEST_ARRAY, |most| most.min(LONGEST_ARRAY))
}

/// Puts the job that says this back into the queue.
pub fn requeue(id: &str) -> Result<(), SlurmError> {
    ask("scontrol", &["requeue", id], "").map(drop)
}

fn ask(program: &'static str, arguments: &[&str], input: &str) -> Result<String, SlurmError> {
    let missing = |source| SlurmError::Missing { program, source };
    let mut child = Command::new(program)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(missing)?;
    if let Some(mut pipe) = child.stdin.take() {
        // One that does not read what it is told says why at its end.
        let _ = pipe.write_all(input.as_bytes());
    }
    let output = child.wait_with_output().map_err(missing)?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim().to_owned();
    if output.status.success() {
        return Ok(text(&output.stdout));
    }
    let words = text(&output.stderr);
    let words = if words.is_empty() {
        output.status.to_string()
    } else {
        words
    };
    Err(SlurmError::Refused { program, words })
}

fn garbage(program: &'static str, answer: &str) -> SlurmError {
    SlurmError::Garbage {
        program,
        answer: answer.chars().take(200).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_of_the_queue_tells_a_job_and_its_state() {
        let why = "Resources".to_owned();
        let queued = Some(("12_3".to_owned(), Sighting::Queued { why }));
        assert_eq!(sighting("12_3|PENDING|Resources"), queued);
        assert_eq!(
            sighting("12_3|RUNNING|None").map(|seen| seen.1),
            Some(Sighting::Running)
        );
        let ended = sighting("12_3|OUT_OF_MEMORY|OutOfMemory").map(|seen| seen.1);
        assert_eq!(ended, Some(Sighting::Ended("OUT_OF_MEMORY".to_owned())));
    }

    #[test]
    fn a_limit_of_jobs_is_told_from_other_refusals() {
        let refused = |words: &str| SlurmError::Refused {
            program: "sbatch",
            words: words.to_owned(),
        };
        for words in [
            "sbatch: error: QOSMaxSubmitJobPerUserLimit",
            "sbatch: error: AssocGrpSubmitJobsLimit",
            "sbatch: error: Batch job submission failed: Job violates accounting/QOS policy (job submit limit, user's size \
             and/or time limits)",
        ] {
            assert!(refused(words).is_for_want_of_room(), "{words}");
        }
        assert!(!refused("sbatch: error: invalid partition specified: nowhere").is_for_want_of_room());
    }

    #[test]
    fn what_is_no_line_of_the_queue_is_not_taken_for_one() {
        for line in [
            "slurm_load_jobs error",
            "12_3",
            "12_3|running|None",
            "x|RUNNING|None",
            "12|",
        ] {
            assert_eq!(sighting(line), None, "{line}");
        }
    }
}
