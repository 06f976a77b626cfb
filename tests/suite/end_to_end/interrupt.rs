//! Ctrl-C.

use std::fs;

use super::{PATIENCE, Program, Workspace, assert_same_results, files, restless, send, table, wait_for};

/// The step that a text names behind these words.
fn step_after(text: &str, words: &str) -> u64 {
    let (_, rest) = text
        .split_once(words)
        .unwrap_or_else(|| panic!("no `{words}` in {text}"));
    let digits: String = rest.chars().take_while(char::is_ascii_digit).collect();
    digits.parse().unwrap()
}

#[test]
fn an_interrupted_run_goes_on_from_its_checkpoint_and_ends_with_the_same_bits() {
    let whole = Workspace::restless();
    whole.cgaft("run", &["--only", "atoms"]).succeeded();

    let place = Workspace::restless();
    let run = Program::start(&mut place.command("run", &["--only", "atoms"]), &place);
    let partial_files = || files(&place.results().join("runs"));
    let segments = || {
        partial_files()
            .iter()
            .filter(|path| path.to_string_lossy().contains("/series-"))
            .count()
    };
    wait_for("a few checkpoints", || segments() >= 5);
    send("-INT", run.child.id());
    let stopped = run.wait(PATIENCE).ended_with(130);
    assert!(
        stopped.stdout.contains("atoms: interrupted at step "),
        "{}",
        stopped.stdout
    );

    let there: Vec<_> = partial_files();
    assert!(there.iter().any(|path| path.ends_with("checkpoint.h5")), "{there:?}");
    let status = place.cgaft("status", &[]).succeeded().stdout;
    let told = step_after(&status, "interrupted at step ");
    assert!(told > 0, "{status}");

    let again = place.cgaft("run", &["--only", "atoms"]).succeeded();
    let reason = "atoms: runs (interrupted at step ";
    assert_eq!(step_after(&again.stdout, reason), told);
    let log = fs::read_to_string(place.case("atoms").join("log.txt")).unwrap();
    assert!(step_after(&log, "going on from step ") >= told, "{log}");
    assert_same_results(&place.case("atoms"), &whole.case("atoms"));

    // What it cost is that of both attempts: every step has its force.
    let rows = table(&place.results(), "cost");
    let forces = rows.iter().find(|row| row["phase"] == "forces").unwrap();
    let summary = table(&place.results(), "summary");
    let atoms = summary.iter().find(|row| row["case"] == "atoms").unwrap();
    let steps: u64 = atoms["steps"].parse().unwrap();
    // Interrupted at its end, an attempt repeats nothing; a checkpoint read again computes its forces once more.
    let calls: u64 = forces["calls"].parse().unwrap();
    assert!((steps..steps + 100).contains(&calls), "{calls} forces in {steps} steps");
    let seconds: f64 = rows.iter().map(|row| row["seconds"].parse::<f64>().unwrap()).sum();
    let wall: f64 = atoms["wall_s"].parse().unwrap();
    assert!(seconds <= wall, "{seconds} s in phases, {wall} s in all");
    assert!(!place.case("atoms").join("cost.json").exists(), "the manifest holds it");
}

#[test]
fn a_solver_stopped_by_hand_goes_on_by_the_same_command() {
    let place = Workspace::with(&restless(super::STUDY));
    place.cgaft("run", &["--only", "mixed"]).succeeded();
    let (study, alone) = (place.case("mixed"), place.path("alone"));
    let solve = || place.solver(&study.join("case.yaml"), &alone, &["--threads", "1"]);
    let run = Program::start(&mut solve(), &place);
    wait_for("a checkpoint", || alone.join("checkpoint.h5").exists());
    send("-TERM", run.child.id());
    let stopped = run.wait(PATIENCE).ended_with(130);
    assert!(
        stopped.stderr.contains("the same command goes on"),
        "{}",
        stopped.stderr
    );
    assert!(!alone.join("series.h5").exists());
    let again = Program::start(&mut solve(), &place).wait(PATIENCE).succeeded();
    assert!(step_after(&again.stderr, "going on from step ") > 0);
    assert_same_results(&alone, &study);
}
