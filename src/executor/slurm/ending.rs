//! How a job ended that left no result, in words, and what to do about it.

/// `state` is Slurm's own word; `None`: Slurm no longer knows the job.
pub fn meaning(slurm_id: &str, state: Option<&str>) -> String {
    let words = match state {
        None => {
            "is gone from the queue and has left no result; `study run` starts the case again, from its checkpoint if \
             there is one"
        }
        Some("TIMEOUT" | "DEADLINE") => {
            "was out of time before it had written a checkpoint; give more with `cluster.time`, or write checkpoints \
             more often with `run.checkpoint-every`"
        }
        Some("OUT_OF_MEMORY") => {
            "was out of memory; `cgaft study check` tells what a case needs: ask for more with `cluster.options: \
             [--mem=8G]`"
        }
        Some("NODE_FAIL" | "BOOT_FAIL") => {
            "lost its node; `study run` goes on from the last checkpoint. If it happens again, exclude the node with \
             `cluster.options: [--exclude=NODE]`"
        }
        Some("PREEMPTED") => "had to make room for another job; `study run` goes on from the last checkpoint",
        Some("CANCELLED") => "was cancelled; `study run` goes on from the last checkpoint",
        Some("COMPLETED") => "ended without a result; what it said is shown",
        Some("FAILED") => {
            "failed before cgaft could say why; what it said is shown. Do `cluster.modules` and `cluster.preamble` \
             work on the node, and does it see this folder?"
        }
        Some(other) => return format!("Slurm job {slurm_id} ended as {other}, and has left no result"),
    };
    format!("Slurm job {slurm_id} {words}")
}
