//! A scheduler that takes no more than so many jobs, and jobs that would wait for ever.

use super::{Cluster, said};

#[test]
fn what_slurm_has_no_room_for_is_told_and_handed_over_when_there_is_some() {
    let cluster = Cluster::new();
    // All three do not fit, A does, the others do not, and B does not.
    let run = said(cluster.run().env("FAKE_FULL", "1 3 4")).succeeded();
    let told = "queued (not yet submitted, because Slurm takes no more jobs now; it is handed over when some have ended \
                (sbatch: error: QOSMaxSubmitJobPerUserLimit ";
    assert!(run.stdout.contains(told), "{}", run.stdout);
    assert_eq!(cluster.states(), ["done"; 3]);
    assert_eq!(cluster.place.starts().len(), 3, "each once");
    assert_eq!(
        cluster.asked("submissions").len(),
        5,
        "the last for both that were left"
    );
}

#[test]
fn who_does_not_wait_is_told_what_was_not_handed_over() {
    let cluster = Cluster::new();
    let mut run = cluster.command("run", &["--on", "slurm", "--detach"]);
    let run = said(run.env("FAKE_FULL", "1 3 4").env("FAKE_STATE", "PENDING|Resources"));
    assert_eq!(run.code, Some(1), "{}{}", run.stdout, run.stderr);
    let told = "Slurm has 1 of 3 cases and no room for the others now";
    assert!(run.stdout.contains(told), "{}", run.stdout);
    assert_eq!(cluster.states(), ["queued", "missing", "missing"]);
}

#[test]
fn a_refusal_after_some_were_submitted_says_that_those_run_on() {
    let cluster = Cluster::new();
    let run = said(cluster.run().env("FAKE_MAX_ARRAY", "2").env("FAKE_REFUSE_AFTER", "1"));
    assert_eq!(run.code, Some(3), "{}{}", run.stdout, run.stderr);
    for told in [
        "invalid account",
        "Before that these were submitted and run on, 2 in all",
        "`cgaft study cancel`",
    ] {
        assert!(run.stderr.contains(told), "no `{told}` in {}", run.stderr);
    }
}

#[test]
fn a_job_that_never_starts_is_told_with_what_to_do() {
    for (state, told) in [
        ("PENDING|JobHeldUser", "scontrol release"),
        ("PENDING|DependencyNeverSatisfied", "--dependency"),
        ("PENDING|PartitionTimeLimit", "less `cluster.time`"),
    ] {
        let cluster = Cluster::new();
        let mut run = cluster.command("run", &["--on", "slurm", "--detach"]);
        said(run.env("FAKE_STATE", state)).succeeded();
        let status = cluster.cgaft("status", &[]).succeeded().stdout;
        assert!(status.contains(told), "{state}: {status}");
    }
}
