//! What goes wrong, and with which exit code.

use std::fs;
use std::path::PathBuf;

use super::{PATIENCE, Program, STUDY, Workspace, table};

/// The mixed case with another way of choosing the time step.
fn with_time_step(time_step: &str) -> String {
    let mixed = "mixed: {";
    assert!(STUDY.contains(mixed));
    STUDY.replace(mixed, &format!("{mixed}run: {{time-step: {time_step}}}, "))
}

#[test]
fn a_time_step_above_the_limit_is_refused_before_anything_starts() {
    // Twice the limit of atoms; the coarse case alone could take it.
    let place = Workspace::with(&with_time_step("220 fs"));
    for command in ["check", "run", "plan"] {
        let refused = place.cgaft(command, &[]).ended_with(2);
        // The place in the file, the line itself, what is wrong and what to do.
        for word in [
            "slab.yaml:17:",
            "time-step: 220 fs",
            "(case mixed)",
            "0.22000 ps",
            "stability limit",
            "`time-step: auto`",
            "nothing was started",
        ] {
            assert!(refused.stderr.contains(word), "no `{word}` in {}", refused.stderr);
        }
    }
    let mistake = &place.cgaft("run", &["--json"]).ended_with(2).json()["error"]["mistakes"][0];
    assert_eq!((&mistake["file"], &mistake["line"]), (&"slab.yaml".into(), &17.into()));
    assert!(!place.path("results").exists());
}

#[test]
fn a_solver_alone_refuses_its_case_at_the_place_in_its_file() {
    let place = Workspace::new();
    place.cgaft("run", &["--only", "coarse"]).succeeded();
    let text = fs::read_to_string(place.case("coarse").join("case.yaml")).unwrap();
    let case = place.path("case.yaml");
    fs::write(&case, text.replace("time-step: {fraction: 0.5}", "time-step: 1 ps")).unwrap();
    let solve = &mut place.solver(&case, &place.path("alone"), &[]);
    let refused = Program::start(solve, &place).wait(PATIENCE).ended_with(2);
    assert!(
        refused.stderr.contains("case.yaml:") && refused.stderr.contains("time-step: 1 ps"),
        "{}",
        refused.stderr
    );
}

#[test]
fn a_given_time_step_that_becomes_unstable_ends_its_case_with_advice() {
    // Just below the limit of the crystal at rest, which the breaking one undercuts.
    let place = Workspace::with(&with_time_step("110 fs"));
    let run = place.cgaft("run", &["--only", "mixed"]).ended_with(1);
    for told in ["the physics failed", "step ", "no longer stable", "`time-step: auto`"] {
        assert!(run.stderr.contains(told), "no `{told}` in {}", run.stderr);
    }
}

#[test]
fn a_blow_up_fails_its_case_keeps_what_there_is_and_lets_the_others_run() {
    // Just below the limit of the crystal at rest, which the breaking one undercuts.
    let place = Workspace::with(&with_time_step("108 fs"));
    let run = place.cgaft("run", &[]).ended_with(1);
    assert!(run.stdout.contains("1 of 3 cases failed"), "{}", run.stdout);
    assert_eq!(place.states(), ["done", "failed", "done"]);
    for told in ["mixed: failed: the physics failed", "step ", "no longer stable"] {
        assert!(run.stderr.contains(told), "no `{told}` in {}", run.stderr);
    }

    let kept = partial(&place);
    for name in ["case.yaml", "log.txt", "series.h5", "fields.vtkhdf", "failure.json"] {
        assert!(kept.join(name).exists(), "{name}");
    }
    let page = fs::read_to_string(place.results().join("report.html")).unwrap();
    assert!(page.contains("2 of 3 cases done, 1 failed") && page.contains("no longer stable"));
    let rows = table(&place.results(), "stress_strain");
    let of_mixed = rows.iter().filter(|row| row["case"] == "mixed").count();
    assert!(of_mixed > 100, "{of_mixed} rows up to the failure");

    // The solver alone says the same by its own exit code.
    let alone = place.path("alone");
    let case = kept.join("case.yaml");
    let solve = &mut place.solver(&case, &alone, &["--threads", "1"]);
    let failed = Program::start(solve, &place).wait(PATIENCE).ended_with(4);
    assert!(
        failed.stderr.contains("step ") && failed.stderr.contains("kept in"),
        "{}",
        failed.stderr
    );
    assert_eq!(
        fs::read(alone.join("series.h5")).unwrap(),
        fs::read(kept.join("series.h5")).unwrap()
    );

    let log = fs::read_to_string(kept.join("log.txt")).unwrap();
    assert!(
        log.contains(" %  strain ") || log.contains(" left  strain "),
        "it does not tell how far it came: {log}"
    );

    // Run again, it starts over and not from the beginning of the blow-up; the others are left alone.
    let again = place.cgaft("run", &[]).ended_with(1);
    assert!(
        again.stdout.contains("mixed: runs (failed before: the physics failed"),
        "{}",
        again.stdout
    );
    assert!(again.stdout.contains("starts over"), "{}", again.stdout);
    assert!(again.started("mixed") && !again.started("atoms") && !again.started("coarse"));
}

#[test]
fn a_pull_that_hardly_does_any_work_is_not_ended_by_rounding() {
    // All its work is less than the last digit of the energy.
    let slow = STUDY.replace("rate: 1e9 /s", "rate: 1e3 /s");
    let place = Workspace::with(&slow.replace("until: {strain: 6 %, crack-length: 15 nm}", "until: {time: 10 ps}"));
    let run = place.cgaft("run", &[]).succeeded();
    assert_eq!(run.stdout.matches("time ").count(), 3, "{}", run.stdout);
}

/// Folder of the one run that is not published.
fn partial(place: &Workspace) -> PathBuf {
    let runs = fs::read_dir(place.results().join("runs"))
        .unwrap()
        .flatten()
        .map(|run| run.path());
    let mut partial = runs.filter(|run| run.extension().is_some_and(|end| end == "partial"));
    partial.next().unwrap()
}

#[test]
fn a_place_that_cannot_be_written_is_told_before_anything_is_computed() {
    let place = Workspace::new();
    fs::write(place.path("results"), "in the way").unwrap();
    let refused = place.cgaft("run", &[]).ended_with(5);
    assert!(refused.stderr.contains("--results DIR"), "{}", refused.stderr);

    fs::remove_file(place.path("results")).unwrap();
    place.cgaft("run", &["--only", "coarse"]).succeeded();
    fs::write(place.path("wall"), "in the way").unwrap();
    let case = place.case("coarse").join("case.yaml");
    let solve = &mut place.solver(&case, &place.path("wall/coarse"), &[]);
    let refused = Program::start(solve, &place).wait(PATIENCE).ended_with(5);
    assert!(refused.stderr.contains("cannot write"), "{}", refused.stderr);
}
