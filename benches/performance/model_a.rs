//! Model A from its study file to its report, on one core.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::demand::{self, Demand};
use super::steps::MILLIONS;
use super::{clock, commands, page, specimens};

pub fn measure() {
    let [study, flag, results] = commands::in_scratch("model-a");
    let before = clock::children_seconds();
    let run = [
        "study",
        "run",
        &study,
        "--fresh",
        "--quiet",
        "--jobs",
        "1",
        "--threads",
        "1",
        &flag,
        &results,
    ];
    commands::cgaft(&run);
    let core_seconds = clock::children_seconds() - before;
    let outcome = outcome(&page::scratch().join("model-a/cases/A"));
    let atoms = 7_048_800.0;
    let phases = outcome["cost"].as_array().expect("the phases are there");
    let seconds = |phase: &Value| phase["seconds"].as_f64().expect("a number");
    let total: f64 = phases.iter().map(seconds).sum();
    let rows: Vec<Vec<String>> = phases
        .iter()
        .map(|phase| {
            vec![
                phase["name"].as_str().expect("a name").to_owned(),
                phase["calls"].to_string(),
                page::number(seconds(phase)),
                page::number(100.0 * seconds(phase) / total),
            ]
        })
        .collect();
    page::write("model-a", &["phase", "calls", "s", "% of the time"], &rows);

    let steps = outcome["steps"].as_f64().expect("a number");
    let demand = Demand::AtLeast {
        least: 500.0,
        aim: 1500.0,
    };
    demand::record(demand::MODEL_A, 1e-6 * atoms * steps / core_seconds, MILLIONS, demand);
    let output = phases.iter().find(|phase| phase["name"] == "output").map(seconds);
    let demand = Demand::Below {
        most: 3.0,
        aim: Some(1.0),
    };
    demand::record(
        demand::OUTPUT,
        100.0 * output.expect("there is output") / total,
        "%",
        demand,
    );
    let memory = outcome["peak_memory_bytes"].as_f64().expect("Linux tells the memory");
    let demand = Demand::Below {
        most: 10.0,
        aim: Some(5.0),
    };
    demand::record(demand::MEMORY_REPRESENTED, memory / atoms, "bytes", demand);

    let report = commands::cgaft(&["study", "report", &five_of_them(), &flag, &results]);
    demand::record(demand::REPORT, report, "s", Demand::Below { most: 10.0, aim: None });
    measure_memory_of_atoms();
}

/// What a published run tells of itself.
fn outcome(run: &Path) -> Value {
    let text = fs::read_to_string(run.join("manifest.json")).expect("the run is published");
    let manifest: Value = serde_json::from_str(&text).expect("it is JSON");
    manifest["outcome"].clone()
}

/// A study of five cases with the run of model A, as many as there are models, in a file of its own.
fn five_of_them() -> String {
    let text = fs::read_to_string(specimens::study("model-a")).expect("the study is there");
    let five = text.replace("  A: {}\n", "  A: {}\n  B: {}\n  C: {}\n  D: {}\n  E: {}\n");
    assert_ne!(five, text, "the study ends with its only case");
    let path = page::scratch().join("five.yaml");
    fs::write(&path, five).expect("the scratch folder can be written");
    path.display().to_string()
}

/// A million atoms in a process of its own.
fn measure_memory_of_atoms() {
    let text = fs::read_to_string(specimens::study("specimens")).expect("the study is there");
    let (base, _) = text.split_once("cases:\n").expect("it has cases");
    let base = base
        .replace("study: specimens", "study: memory")
        .replace("strain: 1.2 %", "time: 1 ps");
    let base = base.replace("every: 1 ps", "every: 0.1 ps");
    let path = page::scratch().join("memory.yaml");
    fs::write(
        &path,
        format!("{base}cases:\n  atoms: {{resolution: {{element: 1}}}}\n"),
    )
    .expect("it can be written");
    let results = page::scratch().display().to_string();
    let study = path.display().to_string();
    commands::cgaft(&[
        "study",
        "run",
        &study,
        "--fresh",
        "--quiet",
        "--threads",
        "1",
        "--results",
        &results,
    ]);
    let outcome = outcome(&page::scratch().join("memory/cases/atoms"));
    let memory = outcome["peak_memory_bytes"].as_f64().expect("Linux tells the memory");
    let demand = Demand::Below {
        most: 150.0,
        aim: Some(75.0),
    };
    demand::record(demand::MEMORY_ATOM, memory / 999_900.0, "bytes", demand);
}
