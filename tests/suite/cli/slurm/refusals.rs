//! A scheduler that is not there, refuses, babbles or loses jobs.

use std::fs;

use super::{Cluster, said};

#[test]
fn a_machine_without_slurm_is_told_what_is_missing() {
    let cluster = Cluster::new();
    let run = said(cluster.run().env("PATH", cluster.slurm()));
    assert_eq!(run.code, Some(3), "{}{}", run.stdout, run.stderr);
    assert!(run.stderr.contains("Slurm is not on this machine"), "{}", run.stderr);
    assert!(cluster.place.starts().is_empty());
}

#[test]
fn a_refusal_is_told_in_the_words_of_slurm() {
    let cluster = Cluster::new();
    let run = said(cluster.run().env("FAKE_REFUSE", "1"));
    assert_eq!(run.code, Some(3));
    for told in ["invalid partition specified: nowhere", "`cluster:`"] {
        assert!(run.stderr.contains(told), "no `{told}` in {}", run.stderr);
    }
    assert_eq!(cluster.states(), ["missing"; 3], "nothing is thought to wait");
}

#[test]
fn a_queue_that_babbles_is_no_queue() {
    let cluster = Cluster::new();
    let run = said(cluster.run().env("FAKE_GARBAGE", "1"));
    assert_eq!(run.code, Some(3));
    assert!(run.stderr.contains("`is anybody there?`"), "{}", run.stderr);
    assert!(
        cluster.asked("submissions").is_empty(),
        "it is asked before anything is submitted"
    );
}

#[test]
fn a_job_that_ends_without_a_result_is_a_failure_that_says_why() {
    for (state, meaning) in [
        ("TIMEOUT|TimeLimit", "out of time"),
        ("OUT_OF_MEMORY|OutOfMemory", "--mem=8G"),
        ("NODE_FAIL|NodeDown", "lost its node"),
        ("vanish", "is gone from the queue"),
    ] {
        let cluster = Cluster::new();
        let run = said(
            cluster
                .command("run", &["--on", "slurm", "--only", "A"])
                .env("FAKE_STATE", state),
        );
        assert_eq!(run.code, Some(1), "{}{}", run.stdout, run.stderr);
        let told = "A: failed: Slurm job 100_0 ";
        assert!(
            run.stderr.contains(told) && run.stderr.contains(meaning),
            "{state}: {}",
            run.stderr
        );
        assert_eq!(cluster.states(), ["failed", "missing", "missing"]);
        assert!(cluster.place.path("results/slab/report.html").exists());

        said(&mut cluster.run()).succeeded();
        assert_eq!(cluster.states(), ["done"; 3], "the next run starts it again");
    }
}

#[test]
fn a_node_on_which_cgaft_cannot_start_shows_what_its_shell_said() {
    let cluster = Cluster::with("cluster:\n  preamble: |\n    echo 'no module named hdf5' >&2\n    exit 7\n");
    let run = said(&mut cluster.command("run", &["--on", "slurm", "--only", "A"]));
    assert_eq!(run.code, Some(1));
    for told in ["`cluster.preamble`", "    | no module named hdf5\n"] {
        assert!(run.stderr.contains(told), "no `{told}` in {}", run.stderr);
    }
}

#[test]
fn a_status_that_slurm_does_not_answer_tells_what_it_knows() {
    let cluster = Cluster::new();
    said(
        cluster
            .command("run", &["--on", "slurm", "--detach"])
            .env("FAKE_STATE", "PENDING|Priority"),
    )
    .succeeded();
    fs::remove_file(cluster.place.path("bin/squeue")).unwrap();
    let status = said(cluster.command("status", &[]).env("PATH", cluster.place.path("bin")))
        .succeeded()
        .stdout;
    assert!(
        status.contains("submitted as Slurm job 100_0, of which nothing can be learned"),
        "{status}"
    );
}

#[test]
fn what_only_slurm_can_do_is_not_asked_of_this_machine() {
    let cluster = Cluster::new();
    let refused = cluster.cgaft("run", &["--detach"]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("--on slurm"), "{}", refused.stderr);
}

#[test]
fn accounting_tells_of_jobs_that_the_queue_has_forgotten() {
    let cluster = Cluster::new();
    fs::write(cluster.slurm().join("accounting"), "100_0|OUT_OF_MEMORY\n").unwrap();
    let mut run = cluster.command("run", &["--on", "slurm", "--only", "A"]);
    let run = said(run.env("FAKE_STATE", "vanish"));
    assert_eq!(run.code, Some(1));
    assert!(run.stderr.contains("100_0 was out of memory"), "{}", run.stderr);
}

#[test]
fn results_that_no_script_can_name_are_refused_before_anything_is_submitted() {
    let cluster = Cluster::new();
    let results = cluster.place.path("results\nscancel --all");
    let refused = cluster.cgaft("run", &["--on", "slurm", "--results", results.to_str().unwrap()]);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    assert!(refused.stderr.contains("no job script can hold"), "{}", refused.stderr);
    assert!(!results.exists());
}
