//! Why a job waits, in Slurm's word, and what to do where it would wait for ever.

/// `Resources`, or `JobHeldUser: it is held; …`.
pub fn reason(word: &str) -> String {
    match advice(word) {
        Some(advice) => format!("{word}: {advice}"),
        None => word.to_owned(),
    }
}

/// What to do about a job that will not start by itself; `None` where it only has to wait.
fn advice(word: &str) -> Option<&'static str> {
    Some(match word {
        "JobHeldUser" => "it is held, and starts after `scontrol release` with its number",
        "JobHeldAdmin" => "the people who run the cluster hold it: ask them",
        "JobHoldMaxRequeue" | "launch failed requeued held" => {
            "its node could not start it: ask the people who run the cluster, then `scontrol release` with its number"
        }
        "DependencyNeverSatisfied" => {
            "it waits for a job that has failed and never starts: `cgaft study cancel`, correct `--dependency` in \
             `cluster.options`, and run again"
        }
        "PartitionTimeLimit" => {
            "it asks for more time than the partition gives and never starts: `cgaft study cancel`, then less \
             `cluster.time` or another `cluster.partition`"
        }
        "PartitionNodeLimit" => {
            "it asks for more nodes than the partition gives and never starts: `cgaft study cancel`, then fewer \
             `cluster.nodes` or another `cluster.partition`"
        }
        "PartitionDown" | "PartitionInactive" => {
            "the partition takes no jobs now: `cgaft study cancel` and another `cluster.partition`, or wait"
        }
        "BadConstraints" => {
            "no node has what it asks for: `cgaft study cancel`, then correct `cluster.options` and the ranks and threads"
        }
        "InvalidAccount" | "InvalidQOS" => {
            "the account or its quality of service is not valid: `cgaft study cancel`, then correct `cluster.account` and \
             `cluster.options`"
        }
        word if word.contains("MaxWallDuration") => {
            "it asks for more time than its account may have and never starts: `cgaft study cancel`, then less `cluster.time`"
        }
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_job_that_never_starts_by_itself_gets_advice_and_one_that_waits_none() {
        for word in ["Resources", "Priority", "Dependency", "AssocMaxJobsLimit"] {
            assert_eq!(reason(word), word);
        }
        for (word, told) in [
            ("JobHeldUser", "scontrol release"),
            ("DependencyNeverSatisfied", "--dependency"),
            ("PartitionTimeLimit", "cluster.time"),
            ("QOSMaxWallDurationPerJobLimit", "cluster.time"),
            ("BadConstraints", "cluster.options"),
        ] {
            let reason = reason(word);
            assert!(reason.starts_with(word) && reason.contains(told), "{reason}");
        }
    }
}
