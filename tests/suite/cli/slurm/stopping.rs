//! Leaving, coming back, cancelling, and jobs whose time is up.

use std::fs;
use std::process::{Child, Command};
use std::thread;
use std::time::{Duration, Instant};

use super::{Cluster, finished, said};

/// Long enough for a loaded machine; nothing waits so long when all is well.
const PATIENCE: Duration = Duration::from_secs(30);

fn wait_for(what: &str, mut happened: impl FnMut() -> bool) {
    let start = Instant::now();
    while !happened() {
        assert!(start.elapsed() < PATIENCE, "waited too long for {what}");
        thread::sleep(Duration::from_millis(20));
    }
}

fn signal(process: &str, name: &str) {
    assert!(Command::new("kill").args([name, process]).status().unwrap().success());
}

impl Cluster {
    /// Hands over one case, and waits until its solver is at work.
    fn at_work(&self, behaviour: &str) {
        let detached = ["--on", "slurm", "--detach", "--only", "A"];
        said(self.command("run", &detached).env(behaviour, "study: A")).succeeded();
        wait_for("its progress", || {
            let status = self.cgaft("status", &[]).stdout;
            status.contains("running as Slurm job 100_0 at step 40 of 100 (40 %)")
        });
    }

    fn warn(&self) {
        let process = fs::read_to_string(self.slurm().join("100_0.pid")).unwrap();
        signal(process.trim(), "-USR1");
    }

    fn watching(&self, behaviour: &str) -> Child {
        let mut run = self.command("run", &["--on", "slurm", "--only", "A"]);
        let run = run.env(behaviour, "study: A").spawn().unwrap();
        wait_for("its progress", || {
            self.cgaft("status", &[]).stdout.contains("100_0 at step 40")
        });
        run
    }
}

#[test]
fn jobs_outlive_the_terminal_and_are_found_again() {
    let cluster = Cluster::new();
    let mut run = cluster.watching("FAKE_LONG");
    run.kill().unwrap();
    run.wait().unwrap();
    assert_eq!(cluster.states(), ["running", "missing", "missing"]);
    let again = cluster
        .command("run", &["--on", "slurm", "--only", "A"])
        .spawn()
        .unwrap();
    cluster.warn();
    let words = finished(again).succeeded().stdout;
    assert!(words.contains("A: running as Slurm job 100_0"), "{words}");
    assert_eq!(cluster.asked("submissions").len(), 1, "it was not handed over twice");
}

#[test]
fn a_slurm_that_is_silent_for_a_moment_ends_nothing() {
    let cluster = Cluster::new();
    let run = cluster.watching("FAKE_LONG");
    let silent = cluster.slurm().join("silent");
    fs::write(&silent, "").unwrap();
    // Long enough for a question to go unanswered.
    thread::sleep(Duration::from_secs(1));
    cluster.warn();
    fs::remove_file(silent).unwrap();
    finished(run).succeeded();
}

#[test]
fn two_who_hand_over_one_study_at_once_submit_it_once() {
    let cluster = Cluster::new();
    let start = || cluster.run().env("FAKE_PAUSE", "study:").spawn().unwrap();
    for run in [start(), start()] {
        finished(run).succeeded();
    }
    assert_eq!(cluster.asked("submissions").len(), 1);
    assert_eq!(cluster.place.starts().len(), 3);
}

#[test]
fn jobs_that_wait_are_shown_and_can_be_cancelled() {
    let cluster = Cluster::new();
    let held = said(
        cluster
            .command("run", &["--on", "slurm", "--detach"])
            .env("FAKE_STATE", "PENDING|Priority"),
    );
    assert!(held.succeeded().stdout.contains("Slurm has them"));
    assert_eq!(cluster.states(), ["queued"; 3]);
    assert_eq!(cluster.status()["cases"][1]["slurm_job"], "100_1");
    let status = cluster.cgaft("status", &[]).stdout;
    assert!(status.contains("queued as Slurm job 100_2 (Priority)"), "{status}");
    let plan = cluster.cgaft("plan", &["--on", "slurm"]).stdout;
    for told in ["A: wait (queued as", "nothing to hand over, 3 cases on Slurm already"] {
        assert!(
            plan.contains(told) && !plan.contains("#SBATCH"),
            "no `{told}` in {plan}"
        );
    }

    let cancelled = cluster.cgaft("cancel", &[]).succeeded().stdout;
    assert!(cancelled.starts_with("cancelled 3 jobs"), "{cancelled}");
    assert_eq!(cluster.asked("cancellations"), ["100_0", "100_1", "100_2"]);
    assert_eq!(cluster.states(), ["missing"; 3]);
    assert!(
        cluster
            .cgaft("status", &[])
            .stdout
            .contains("new; Slurm job 100_0 was cancelled")
    );
    let nothing = cluster.cgaft("cancel", &[]).succeeded().stdout;
    assert!(nothing.starts_with("no case"), "{nothing}");
}

#[test]
fn ctrl_c_cancels_with_a_checkpoint_and_the_next_run_goes_on() {
    let cluster = Cluster::new();
    let run = cluster.watching("FAKE_SLOW");
    signal(&run.id().to_string(), "-INT");
    let words = finished(run).ended_with(130).stdout;
    assert!(words.contains("A: interrupted at step 40 of 100"), "{words}");
    let again = said(&mut cluster.command("run", &["--on", "slurm", "--only", "A"])).succeeded();
    let reason = "A: runs (interrupted at step 40 of 100 (40 %); goes on from its last checkpoint";
    assert!(again.stdout.contains(reason), "{}", again.stdout);
    assert!(again.stdout.contains("A: done"), "{}", again.stdout);
}

#[test]
fn a_job_whose_time_is_up_goes_back_into_the_queue_and_on_from_its_checkpoint() {
    let cluster = Cluster::new();
    cluster.at_work("FAKE_LONG");
    cluster.warn();
    said(&mut cluster.command("run", &["--on", "slurm", "--only", "A"])).succeeded();
    assert_eq!(cluster.asked("requeues"), ["100_0"]);
    assert_eq!(cluster.asked("submissions").len(), 1);
    assert_eq!(cluster.place.starts().len(), 2);
    let manifest = fs::read_to_string(cluster.place.path("results/slab/cases/A/manifest.json")).unwrap();
    assert!(manifest.contains("\"attempts\": 2"), "{manifest}");
}

#[test]
fn a_case_started_afresh_goes_on_when_it_comes_back_to_the_queue() {
    let cluster = Cluster::new();
    let only = ["--on", "slurm", "--only", "A"];
    said(&mut cluster.command("run", &only)).succeeded();
    let fresh = [&only[..], &["--fresh"]].concat();
    let run = cluster
        .command("run", &fresh)
        .env("FAKE_LONG", "study: A")
        .spawn()
        .unwrap();
    let process = cluster.slurm().join("101_0.pid");
    let partial = || fs::read_dir(cluster.place.path("results/slab/runs")).unwrap().count() == 2;
    wait_for("the second run", || {
        process.exists() && partial() && cluster.place.starts().len() == 2
    });
    thread::sleep(Duration::from_millis(300));
    signal(fs::read_to_string(process).unwrap().trim(), "-USR1");
    finished(run).succeeded();
    assert_eq!(cluster.place.starts().len(), 3);
}

#[test]
fn a_job_that_does_not_come_a_step_further_is_not_queued_for_ever() {
    let cluster = Cluster::new();
    cluster.at_work("FAKE_SLOW");
    cluster.warn();
    wait_for("the second attempt", || cluster.place.starts().len() == 2);
    // It speaks its progress right after its start.
    thread::sleep(Duration::from_millis(500));
    cluster.warn();
    wait_for("the failure", || cluster.states()[0] == "failed");
    assert_eq!(cluster.asked("requeues").len(), 1);
    let status = cluster.cgaft("status", &[]).stdout;
    assert!(status.contains("`cluster.time`"), "{status}");
}

#[test]
fn clean_leaves_a_case_that_waits_and_forgets_the_jobs_that_are_over() {
    let cluster = Cluster::new();
    cluster.at_work("FAKE_SLOW");
    assert!(cluster.cgaft("cancel", &[]).succeeded().stdout.contains("1 job"));
    wait_for("the checkpoint", || cluster.states()[0] == "partial");
    let held = ["--on", "slurm", "--detach", "--only", "A"];
    said(cluster.command("run", &held).env("FAKE_STATE", "PENDING|Priority")).succeeded();
    let status = cluster.cgaft("status", &[]).stdout;
    assert!(
        status.contains("queued as Slurm job 101_0 (Priority), goes on at step 40"),
        "{status}"
    );
    let cleaned = cluster.cgaft("clean", &[]).succeeded().stdout;
    assert!(cleaned.contains("left, in use: unpublished"), "{cleaned}");
    assert_eq!(cluster.states()[0], "queued");
    cluster.cgaft("cancel", &[]).succeeded();
    let cleaned = cluster.cgaft("clean", &[]).succeeded().stdout;
    assert!(cleaned.contains("removed unpublished"), "{cleaned}");
    assert_eq!(
        fs::read_dir(cluster.place.path("results/slab/.slurm")).unwrap().count(),
        0
    );
}
