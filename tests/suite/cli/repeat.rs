//! Running a study again and again.

use std::fs;
use std::time::Instant;

use super::{STUDY, Workspace, finished, of_cases, said};

#[test]
fn a_study_runs_to_its_report_and_a_second_run_does_nothing() {
    let place = Workspace::new();
    let first = place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    assert!(first.stdout.contains("A: runs (new)"), "{}", first.stdout);
    assert!(
        first.stdout.contains("report: results/slab/report.html"),
        "{}",
        first.stdout
    );
    assert_eq!(place.starts().len(), 3);
    assert!(place.path("results/slab/cases/B/manifest.json").exists());

    let report = place.path("results/slab/report.html");
    let written = fs::metadata(&report).unwrap().modified().unwrap();
    let start = Instant::now();
    let second = place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    let seconds = start.elapsed().as_secs_f64();
    assert!(second.stdout.contains("A: done (unchanged)"), "{}", second.stdout);
    assert_eq!(place.starts().len(), 3);
    assert_eq!(
        fs::metadata(&report).unwrap().modified().unwrap(),
        written,
        "the report is left alone"
    );
    // 0.2 s is the aim; a loaded machine gets some slack.
    assert!(seconds < 1.0, "{seconds} s");

    fs::remove_file(&report).unwrap();
    place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    assert!(report.exists(), "a missing report is built again");
    assert_eq!(place.starts().len(), 3);
}

#[test]
fn only_the_case_that_changed_runs_again_and_is_told_why() {
    let place = Workspace::new();
    place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    place.write_study(&STUDY.replace("50 nm", "51 nm"));
    let plan = place
        .cgaft(&["study", "run", "slab.yaml", "--dry-run", "--json"])
        .succeeded()
        .json();
    assert_eq!(of_cases(&plan, "runs"), ["false", "true", "false"]);
    assert_eq!(place.starts().len(), 3, "a dry run starts nothing");
    let again = place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    assert!(
        again.stdout.contains("B: runs (changed: crack.length: 50 nm -> 51 nm)"),
        "{}",
        again.stdout
    );
    assert_eq!(place.starts().len(), 4);
}

#[test]
fn comments_order_and_units_do_not_make_a_case_run_again() {
    let place = Workspace::new();
    place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    let swapped = STUDY
        .replace("  A: {}\n", "")
        .replace("55 nm}}", "0.055 um}}\n  A: {} # last");
    place.write_study(&swapped);
    place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    assert_eq!(place.starts().len(), 3);
}

#[test]
fn a_case_that_got_another_name_keeps_its_run() {
    let place = Workspace::new();
    place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    place.write_study(&STUDY.replace("  B:", "  long:"));
    place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    assert_eq!(place.starts().len(), 3);
    assert!(place.path("results/slab/cases/long/manifest.json").exists());
}

#[test]
fn one_case_can_be_run_alone() {
    let place = Workspace::new();
    let result = place
        .cgaft(&["study", "run", "slab.yaml", "--only", "B", "--json"])
        .succeeded()
        .json();
    assert_eq!(of_cases(&result, "case"), ["B"]);
    assert_eq!(place.starts().len(), 1);
    let status = place
        .cgaft(&["study", "status", "slab.yaml", "--json"])
        .succeeded()
        .json();
    assert_eq!(of_cases(&status, "state"), ["missing", "done", "missing"]);
}

#[test]
fn fresh_computes_again_what_is_done() {
    let place = Workspace::new();
    place.cgaft(&["study", "run", "slab.yaml", "--only", "A"]).succeeded();
    let again = place
        .cgaft(&["study", "run", "slab.yaml", "--only", "A", "--fresh"])
        .succeeded();
    assert!(
        again.stdout.contains("A: runs (asked for by --fresh)"),
        "{}",
        again.stdout
    );
    assert_eq!(place.starts().len(), 2);
    let run = fs::read_dir(place.path("results/slab/runs")).unwrap().count();
    assert_eq!(run, 1, "the new run has taken the place of the old one");
}

#[test]
fn a_failed_case_is_told_with_its_log_and_the_others_still_run() {
    let place = Workspace::new();
    let run = said(
        place
            .command(&["study", "run", "slab.yaml"])
            .env("FAKE_FAIL", "study: B"),
    );
    assert_eq!(run.code, Some(1));
    assert!(run.stdout.contains("1 of 3 cases failed"), "{}", run.stdout);
    assert!(run.stderr.contains("B: failed: the physics failed"), "{}", run.stderr);
    assert!(
        run.stderr.contains("    | log line 30\n") && !run.stderr.contains("log line 10\n"),
        "{}",
        run.stderr
    );
    assert!(run.stderr.contains("log.txt"), "{}", run.stderr);
    let status = place
        .cgaft(&["study", "status", "slab.yaml", "--json"])
        .succeeded()
        .json();
    assert_eq!(of_cases(&status, "state"), ["done", "failed", "done"]);

    let again = place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    assert!(
        again.stdout.contains("B: runs (failed before: the physics failed"),
        "{}",
        again.stdout
    );
    assert_eq!(place.starts().len(), 4);
}

#[test]
fn two_runs_of_one_study_at_once_do_not_harm_each_other() {
    let place = Workspace::new();
    let start = || {
        place
            .command(&["study", "run", "slab.yaml", "--jobs", "1"])
            .env("FAKE_PAUSE", "study:")
            .spawn()
    };
    let both = [start().unwrap(), start().unwrap()];
    for child in both {
        finished(child).succeeded();
    }
    assert_eq!(place.starts().len(), 3, "each case is computed once");
    let status = place
        .cgaft(&["study", "status", "slab.yaml", "--json"])
        .succeeded()
        .json();
    assert_eq!(of_cases(&status, "state"), ["done"; 3]);
}

#[test]
fn the_threads_of_a_case_are_what_was_asked_for() {
    let place = Workspace::new();
    place
        .cgaft(&["study", "run", "slab.yaml", "--jobs", "3", "--threads", "5"])
        .succeeded();
    assert!(
        place.starts().iter().all(|start| start.ends_with("threads=5")),
        "{:?}",
        place.starts()
    );
}

#[test]
fn clean_says_what_it_removes_and_keeps_what_is_current() {
    let place = Workspace::new();
    place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    place.write_study(&STUDY.replace("50 nm", "51 nm"));
    let runs = || fs::read_dir(place.path("results/slab/runs")).unwrap().count();
    let told = place.cgaft(&["study", "clean", "slab.yaml", "--dry-run"]).succeeded();
    assert_eq!(
        told.stdout.matches("would remove superseded").count(),
        1,
        "{}",
        told.stdout
    );
    assert_eq!(runs(), 3, "a dry run removes nothing");
    let cleaned = place.cgaft(&["study", "clean", "slab.yaml"]).succeeded();
    assert_eq!(
        cleaned.stdout.matches("removed superseded").count(),
        1,
        "{}",
        cleaned.stdout
    );
    let status = place
        .cgaft(&["study", "status", "slab.yaml", "--json"])
        .succeeded()
        .json();
    assert_eq!(of_cases(&status, "state"), ["done", "missing", "done"]);
    let cleaned = place.cgaft(&["study", "clean", "slab.yaml"]).succeeded();
    assert_eq!(cleaned.stdout, "nothing to remove\n");
}
