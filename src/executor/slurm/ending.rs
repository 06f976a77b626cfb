//! How a job ended that left no result, in words, and what to do about it.

/// `state` is Slurm's own word; `None`: Slurm no longer knows the job.
pub fn meaning(slurm_id: &str, state: Option<&str>) -> String {
    let advice = match state {
        Some("TIMEOUT" | "DEADLINE") => {
            "give more with `cluster.time`, or write checkpoints more often with `run.checkpoint-every`"
        }
        Some("OUT_OF_MEMORY") => {
            "`cgaft study check` tells what a case needs: ask for more with `cluster.options: [--mem=8G]`"
        }
        Some("NODE_FAIL" | "BOOT_FAIL") => {
            "`study run` goes on from the last checkpoint; if it happens again, leave the node out with \
             `cluster.options: [--exclude=NODE]`"
        }
        Some("COMPLETED" | "FAILED") => {
            "what it said is shown; do `cluster.modules` and `cluster.preamble` work on the node, and does it see this \
             folder?"
        }
        _ => "`study run` goes on from the last checkpoint, if there is one",
    };
    format!("{}; {advice}", fact(slurm_id, state))
}

/// What became of it, without advice.
pub fn fact(slurm_id: &str, state: Option<&str>) -> String {
    let words = match state {
        None => "is gone from the queue without a result",
        Some("TIMEOUT" | "DEADLINE") => "was out of time before it came a step further and could write a checkpoint",
        Some("OUT_OF_MEMORY") => "was out of memory",
        Some("NODE_FAIL" | "BOOT_FAIL") => "lost its node",
        Some("PREEMPTED") => "had to make room for another job",
        Some("CANCELLED") => "was cancelled",
        Some("COMPLETED") => "ended without a result",
        Some("FAILED") => "failed before cgaft could say why",
        Some(other) => return format!("Slurm job {slurm_id} ended as {other} without a result"),
    };
    format!("Slurm job {slurm_id} {words}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_ending_of_a_job_tells_what_to_do() {
        for (state, advice) in [
            (Some("TIMEOUT"), "cluster.time"),
            (Some("OUT_OF_MEMORY"), "--mem"),
            (Some("NODE_FAIL"), "--exclude"),
            (Some("FAILED"), "cluster.preamble"),
            (Some("REVOKED"), "ended as REVOKED"),
            (None, "gone from the queue"),
        ] {
            let words = meaning("12_3", state);
            assert!(
                words.starts_with("Slurm job 12_3 ") && words.contains(advice),
                "{words}"
            );
        }
    }
}
