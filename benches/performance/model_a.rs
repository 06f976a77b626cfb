//! Model A from its study file to its report, on one core; all of it, or as much as takes two minutes.

use std::fs;
use std::path::Path;

use cgaft::setup::Estimator;
use serde_json::Value;

use super::demand::{self, Demand};
use super::steps::MILLIONS;
use super::{commands, page, specimens};

/// Seconds of a core that the run may take; what takes longer is cut short, and its row says where.
const LONGEST: f64 = 330.0;

/// Where model A ends, and the strain from picture to picture, as the study has them.
const WHOLE: f64 = 1.2;
const PICTURES: f64 = 20.0;

pub fn measure() {
    let [_, flag, results] = commands::in_scratch("model-a");
    let end = reachable_strain();
    let study = study_to(end, &["A"]);
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
    let core_seconds = commands::cgaft(&run);
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
    let unit = if end < WHOLE {
        format!("{MILLIONS}, to {end:.3} %")
    } else {
        MILLIONS.to_owned()
    };
    demand::record(demand::MODEL_A, 1e-6 * atoms * steps / core_seconds, &unit, demand);
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

    // Five names of one run: as much to read, to analyse and to draw as five models.
    let five = study_to(end, &["A", "B", "C", "D", "E"]);
    let report = commands::cgaft(&["study", "report", &five, &flag, &results]);
    demand::record(
        demand::REPORT,
        report,
        commands::SECONDS,
        Demand::Below { most: 10.0, aim: None },
    );
}

/// The strain, in percent, that a run reaches in the time it may take.
fn reachable_strain() -> f64 {
    let case = specimens::case("model-a", "A");
    let estimate = Estimator::default().estimate(&case).expect("the case is sound");
    let step = specimens::measure("elements-7M", 0.0).step;
    let share = LONGEST / (step * estimate.steps as f64);
    (WHOLE * share).min(WHOLE)
}

/// What a published run tells of itself.
pub fn outcome(run: &Path) -> Value {
    let text = fs::read_to_string(run.join("manifest.json")).expect("the run is published");
    let manifest: Value = serde_json::from_str(&text).expect("it is JSON");
    manifest["outcome"].clone()
}

/// The study to this strain, in percent, with these names for its case, in a file of its own.
fn study_to(end: f64, cases: &[&str]) -> String {
    let text = fs::read_to_string(specimens::study("model-a")).expect("the study is there");
    let (base, _) = text.split_once("cases:\n").expect("it has cases");
    let base = base.replace(&format!("strain: {WHOLE} %"), &format!("strain: {end:.5} %"));
    let base = base.replace(
        "every: 0.06 % strain",
        &format!("every: {:.5} % strain", end / PICTURES),
    );
    let cases: String = cases.iter().map(|case| format!("  {case}: {{}}\n")).collect();
    let path = page::scratch().join("model-a.yaml");
    fs::write(&path, format!("{base}cases:\n{cases}")).expect("the scratch folder can be written");
    path.display().to_string()
}

/// The memory of a million atoms in a process of its own.
pub fn measure_memory_of_atoms() {
    let text = fs::read_to_string(specimens::study("specimens")).expect("the study is there");
    let (base, _) = text.split_once("cases:\n").expect("it has cases");
    let base = base
        .replace("study: specimens", "study: memory")
        .replace("strain: 1.2 %", "time: 2 ps");
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
