//! Elements that become atoms on the way: the same bytes whoever computes them, and whenever they are killed.

use std::fs;
use std::path::PathBuf;
use std::thread;
use std::time::Duration;

use super::ranks::ranks;
use super::{PATIENCE, Program, STUDY, Workspace, assert_same_results, restless, table, wait_for};

const COARSE: &str = "coarse: {resolution: {element: 10}}";
const REFINED: &str = "coarse: {resolution: {element: 10, refine: {error: 4 %, ahead: 1}}}";

/// A study of a slab that is refined, computed by one process, and its case file.
fn computed(study: &str) -> (Workspace, PathBuf, PathBuf) {
    assert!(study.contains(COARSE));
    let place = Workspace::with(&study.replace(COARSE, REFINED));
    place.cgaft("run", &["--only", "coarse"]).succeeded();
    let run = place.case("coarse");
    let case = place.path("case.yaml");
    fs::copy(run.join("case.yaml"), &case).unwrap();
    let rows = table(&place.results(), "stress_strain");
    let nodes: Vec<f64> = rows.iter().map(|row| row["nodes"].parse().unwrap()).collect();
    assert!(
        nodes.windows(2).filter(|pair| pair[0] < pair[1]).count() > 1,
        "{nodes:?}"
    );
    (place, run, case)
}

#[test]
fn any_number_of_ranks_and_threads_refines_to_the_same_bytes() {
    let (place, run, case) = computed(STUDY);
    for (count, threads) in [(1, "2"), (2, "1"), (3, "2"), (7, "1")] {
        let into = place.path(&format!("{count} ranks"));
        let job = &mut ranks(count, &case, &into, &["--threads", threads]);
        Program::start(job, &place).wait(PATIENCE).succeeded();
        assert_same_results(&into, &run);
    }
}

#[test]
fn a_refined_run_that_is_killed_again_and_again_goes_on_with_any_number_of_ranks_to_the_same_bytes() {
    let (place, run, case) = computed(&restless(STUDY));
    let into = place.path("killed");
    for (threads, delay) in [("1", 30), ("2", 60), ("3", 15), ("1", 90), ("2", 45)] {
        let mut job = Program::start(&mut place.solver(&case, &into, &["--threads", threads]), &place);
        wait_for("a checkpoint", || {
            into.join("checkpoint.h5").exists() || job.has_ended()
        });
        thread::sleep(Duration::from_millis(delay));
        job.kill();
    }
    let said = Program::start(&mut ranks(2, &case, &into, &[]), &place)
        .wait(PATIENCE)
        .succeeded();
    assert!(
        said.stderr.contains("going on from step ") || into.join("outcome.json").exists(),
        "{}",
        said.stderr
    );
    assert_same_results(&into, &run);
}

#[test]
fn what_becomes_atoms_is_told_before_anything_is_computed() {
    let place = Workspace::with(&STUDY.replace(COARSE, REFINED));
    let said = place.cgaft("check", &[]).succeeded();
    let both = said.stdout + &said.stderr;
    assert!(
        both.contains("elements become atoms along the way of the crack"),
        "{both}"
    );
}
