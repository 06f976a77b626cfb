//! Solids from the study file to the report.

use std::collections::BTreeMap;
use std::fs;

use super::ranks::{computed, ranks};
use super::{PATIENCE, Program, Workspace, assert_same_results, files, table, wait_for};

const SOLID: &str = include_str!("../../studies/solid.yaml");

/// Of the work, in steps of half the limit through broken bonds.
const ENERGY: f64 = 0.02;

/// Of the modulus, which at this size is that of surfaces and of one row of elements.
const MODULUS: f64 = 0.25;

fn number(row: &BTreeMap<String, String>, name: &str) -> f64 {
    row[name].parse().unwrap_or(f64::NAN)
}

fn workspace(from: &str, to: &str) -> Workspace {
    assert!(SOLID.contains(from));
    Workspace::with(&SOLID.replace("study: solid", "study: slab").replace(from, to))
}

/// The same with a severed plane in place of the slot, whose faces are pushed together.
fn severed() -> String {
    let notch = "notch: {blocks: {from: [0, 1, 0], to: [1, 2, 1]}}";
    let plane = "notch: {plane: {normal: a2, at: 1.25 nm, from: a1-low, depth: 1.25 nm}}";
    let [pull, push] = [
        "direction: [0, 1, 0], ramp: initial-velocity",
        "direction: [0.3, -1, 0], ramp: at-rest",
    ];
    let until = "run: {until: {strain: 25 %}";
    for part in [notch, pull, until] {
        assert!(SOLID.contains(part), "{part}");
    }
    let text = SOLID
        .replace("study: solid", "study: slab")
        .replace(notch, plane)
        .replace(pull, push);
    text.replace(until, "run: {until: {time: 1.5 ps}")
        .replace("{snapshots: {every: 10 % strain}}", "{snapshots: {every: 0.5 ps}}")
}

#[test]
fn a_study_of_a_solid_becomes_a_report_that_answers() {
    let place = workspace("", "");
    let json = place.cgaft("check", &["--json"]).succeeded().json();
    let of_cases = |key: &str| -> Vec<u64> {
        let cases = json["cases"].as_array().unwrap().iter();
        cases.map(|case| case[key].as_u64().unwrap()).collect()
    };
    // Eight blocks of 216; of the two in the middle row atoms in one case, of all in another.
    assert_eq!(of_cases("represented_atoms"), [1728; 3]);
    assert_eq!(of_cases("nodes"), [8 * 14, 6 * 14 + 2 * 216, 1728]);
    place.cgaft("run", &[]).succeeded();
    let summary = table(&place.results(), "summary");
    assert_eq!(summary.len(), 3);
    let finest = number(&summary[2], "modulus_gpa");
    for row in &summary {
        assert!(number(row, "energy_error_relative") < ENERGY, "{row:?}");
        assert!((number(row, "modulus_gpa") / finest - 1.0).abs() < MODULUS, "{row:?}");
        assert!(number(row, "broken_bonds") > 10.0, "{row:?}");
        assert!(number(row, "first_break_strain") > 0.01, "{row:?}");
    }
    // Of six free layers the fourth from below: 3.5 of 6 of the velocity of the face that moves.
    let gauges = table(&place.results(), "gauges");
    let start = number(&gauges[0], "velocity_y_m_per_s");
    assert!((start / (100.0 * 3.5 / 6.0) - 1.0).abs() < 1e-6, "{start}");
    let page = fs::read_to_string(place.results().join("report.html")).unwrap();
    assert!(
        page.contains("Elements: ") && page.contains("bonds first change at"),
        "no answer"
    );
    assert!(page.contains("3 of 3 cases done."));
    assert!(place.results().join("figures/stress.svg").exists());
    for file in ["series.h5", "fields.vtkhdf", "checkpoint.h5", "case.yaml"] {
        assert!(place.case("mixed").join(file).exists(), "{file}");
    }
    let export = std::process::Command::new(env!("CARGO_BIN_EXE_cgaft"))
        .args(["export", "ovito", "slab.yaml", "--case", "mixed"])
        .current_dir(place.path(""))
        .output();
    assert!(export.unwrap().status.success());
    let pictures = fs::read_to_string(place.path("mixed.xyz")).unwrap();
    let mut lines = pictures.lines();
    assert_eq!(lines.next(), Some("1728"), "every site is there");
    assert!(lines.next().unwrap().contains("stress_yz_gpa:R:1"));
}

#[test]
fn a_solid_that_is_killed_goes_on_to_the_same_bytes() {
    let places = [(); 2].map(|()| workspace("threads: 1", "threads: 1, checkpoint-every: 1 ms"));
    goes_on_from_a_kill(&places);
}

#[test]
fn a_severed_solid_that_is_killed_goes_on_to_the_same_bytes() {
    let of_kill = |text: &str| text.replace("threads: 1", "threads: 1, checkpoint-every: 1 ms");
    goes_on_from_a_kill(&[(); 2].map(|()| Workspace::with(&of_kill(&severed()))));
}

fn goes_on_from_a_kill([whole, parted]: &[Workspace; 2]) {
    whole.cgaft("run", &["--only", "mixed"]).succeeded();
    let mut program = Program::start(&mut parted.command("run", &["--only", "mixed"]), parted);
    let is_there = || {
        files(&parted.results())
            .iter()
            .any(|path| path.ends_with("checkpoint.h5"))
    };
    wait_for("a checkpoint", is_there);
    program.kill();
    parted.cgaft("run", &["--only", "mixed"]).succeeded();
    assert_same_results(&parted.case("mixed"), &whole.case("mixed"));
}

#[test]
fn any_number_of_ranks_and_threads_computes_a_solid_to_the_same_bytes() {
    for place in [workspace("", ""), Workspace::with(&severed())] {
        let (run, case) = computed(&place);
        for (count, threads) in [(1, "2"), (2, "1"), (3, "2"), (8, "1")] {
            let into = place.path(&format!("{count} ranks"));
            let job = &mut ranks(count, &case, &into, &["--threads", threads]);
            Program::start(job, &place).wait(PATIENCE).succeeded();
            assert_same_results(&into, &run);
        }
    }
}

#[test]
fn the_bonds_of_nodes_make_a_solid_of_whole_blocks_to_the_same_bytes_and_no_other() {
    let text = SOLID.replace("study: solid", "study: slab");
    let text = text.replace("threads: 1", "threads: 1, summation: nodal");
    let mixed = text.find("  mixed:").expect("the study has this case");
    let place = Workspace::with(&text[..mixed]);
    let told = place.cgaft("check", &[]).succeeded().stdout;
    assert!(told.contains("`summation: nodal` fails the patch test"), "{told}");
    place.cgaft("run", &[]).succeeded();
    let run = place.case("elements");
    for (count, threads) in [(1, "2"), (3, "1")] {
        let into = place.path(&format!("{count} ranks"));
        let job = &mut ranks(count, &run.join("case.yaml"), &into, &["--threads", threads]);
        Program::start(job, &place).wait(PATIENCE).succeeded();
        assert_same_results(&into, &run);
    }
    let refused = Workspace::with(&text).cgaft("check", &[]).ended_with(2).stderr;
    assert!(
        refused.contains("mixed") && refused.contains("whole blocks of one size"),
        "{refused}"
    );
}
