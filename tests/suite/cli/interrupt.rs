//! Ctrl-C, and the death of the runner.

use std::fs;
use std::process::{Child, Command};
use std::thread;
use std::time::{Duration, Instant};

use super::{Workspace, finished, of_cases};

/// Long enough for a loaded machine; nothing waits so long when all is well.
const PATIENCE: Duration = Duration::from_secs(20);

pub fn wait_for(what: &str, mut happened: impl FnMut() -> bool) {
    let start = Instant::now();
    while !happened() {
        assert!(start.elapsed() < PATIENCE, "waited too long for {what}");
        thread::sleep(Duration::from_millis(20));
    }
}

pub fn signal(child: &Child, name: &str) {
    assert!(
        Command::new("kill")
            .args([name, &child.id().to_string()])
            .status()
            .unwrap()
            .success()
    );
}

/// A study whose cases go on until they are stopped, with one at work.
fn at_work(place: &Workspace, behaviour: &str) -> Child {
    let arguments = ["study", "run", "slab.yaml", "--jobs", "1"];
    let child = place.command(&arguments).env(behaviour, "study:").spawn().unwrap();
    wait_for("the first case", || place.starts().len() == 1);
    // The first progress arrives after the start, and the note of it after that.
    wait_for("its progress", || {
        let status = place.cgaft(&["study", "status", "slab.yaml"]).stdout;
        status.contains("running in another process at step 40 of 100 (40 %)")
    });
    child
}

pub fn checkpoints(place: &Workspace) -> usize {
    let runs = fs::read_dir(place.path("results/slab/runs")).unwrap().flatten();
    runs.filter(|run| run.path().join("checkpoint.h5").exists()).count()
}

/// Cases that were interrupted.
fn partial(place: &Workspace) -> usize {
    let status = place.cgaft(&["study", "status", "slab.yaml", "--json"]).succeeded();
    let states = of_cases(&status.json(), "state");
    states.iter().filter(|state| *state == "partial").count()
}

#[test]
fn ctrl_c_leaves_checkpoints_and_says_how_to_go_on() {
    for name in ["-INT", "-TERM"] {
        let place = Workspace::new();
        let child = at_work(&place, "FAKE_SLOW");
        signal(&child, name);
        let words = finished(child).ended_with(130).stdout;
        assert!(
            words.contains("interrupted at step 40 of 100") && words.contains("the same command goes on"),
            "{words}"
        );
        assert_eq!((checkpoints(&place), place.starts().len()), (1, 1));
        assert_eq!(partial(&place), 1);

        let again = place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
        let reason = "runs (interrupted at step 40 of 100 (40 %); goes on from its last checkpoint)";
        assert!(again.stdout.contains(reason), "{}", again.stdout);
        assert_eq!(place.starts().len(), 4);
    }
}

#[test]
fn no_solver_outlives_a_killed_runner() {
    let place = Workspace::new();
    let mut child = at_work(&place, "FAKE_SLOW");
    child.kill().unwrap();
    child.wait().unwrap();
    wait_for("the checkpoint of the orphan", || checkpoints(&place) == 1);
    place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
}

#[test]
fn a_second_ctrl_c_ends_a_solver_that_does_not_listen() {
    let place = Workspace::new();
    let child = at_work(&place, "FAKE_STUBBORN");
    let start = Instant::now();
    signal(&child, "-INT");
    // Signals of one kind that arrive together count once.
    thread::sleep(Duration::from_millis(300));
    signal(&child, "-INT");
    finished(child).ended_with(130);
    assert!(start.elapsed() < PATIENCE);
    assert_eq!(partial(&place), 1);
}
