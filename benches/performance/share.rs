//! What of a specimen the fullest of some ranks holds.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use cgaft::plan::{self, PlannedCase};
use cgaft::setup::Estimator;
use cgaft::study;
use serde_json::Value;

use super::demand::{self, Demand};
use super::{page, specimens};

const HEAD: [&str; 5] = [
    "specimen",
    "represented atoms",
    "ranks",
    "MB of the fullest rank",
    "of one rank",
];

/// The 5,120 blocks of Table 4-1 of Deng (2011).
const BAR: &str = "bar";

/// Studies and their cases, each computed by one, two and four ranks.
const CASES: [(&str, &str); 4] = [
    ("memory", "slab"),
    ("memory", "large-slab"),
    ("memory-3d", BAR),
    ("memory-3d", "large-bar"),
];

pub fn measure() {
    let mut rows = Vec::new();
    for (study, case) in CASES {
        let planned = planned(study, case);
        let one = peak(&planned, 1);
        if case == BAR {
            let demand = Demand::Below {
                most: 60.0,
                aim: Some(20.0),
            };
            demand::record(demand::BAR_MEMORY, 1e-6 * one, "MB", demand);
        }
        rows.push(row(&planned, 1, one, Some(one)));
        for ranks in [2, 4] {
            rows.push(row(&planned, ranks, peak(&planned, ranks), Some(one)));
        }
    }
    // One rank alone would take as much as all of them, and twice as long.
    let billion = planned("memory", "billion");
    rows.push(row(&billion, 8, peak(&billion, 8), None));
    page::write("share", &HEAD, &rows);
}

fn planned(study: &str, case: &str) -> PlannedCase {
    let path = specimens::study(study);
    let read = study::read(path.to_str().expect("the path is text")).expect("the study is read");
    let plan = plan::plan(&read).expect("the study is sound");
    let found = plan.cases.into_iter().find(|planned| planned.name == case);
    found.expect("the study has the case")
}

/// Bytes of the fullest of so many ranks, more than there are cores if need be.
fn peak(planned: &PlannedCase, ranks: u32) -> f64 {
    let folder = page::scratch().join("share");
    fs::create_dir_all(&folder).expect("the scratch folder can be written");
    let case = folder.join(format!("{}.yaml", planned.name));
    fs::write(&case, plan::write_case(planned)).expect("it can be written");
    let into = folder.join(format!("{}-{ranks}", planned.name));
    if into.exists() {
        fs::remove_dir_all(&into).expect("what was computed before can be removed");
    }
    let solver = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/mpi/cgaft-solve");
    let status = Command::new("mpirun")
        .args(["-q", "--oversubscribe", "--bind-to", "none", "-n", &ranks.to_string()])
        .arg(solver)
        .arg(&case)
        .arg("--into")
        .arg(&into)
        .args(["--threads", "1", "--progress", "json"])
        .envs([
            ("OMPI_ALLOW_RUN_AS_ROOT", "1"),
            ("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"),
            ("OMPI_MCA_mpi_yield_when_idle", "1"),
        ])
        .stdout(Stdio::null())
        .status();
    assert!(
        status.expect("mpirun starts").success(),
        "{} with {ranks} ranks",
        planned.name
    );
    let outcome = fs::read_to_string(into.join("outcome.json")).expect("the run is done");
    let outcome: Value = serde_json::from_str(&outcome).expect("it is JSON");
    outcome["peak_memory_bytes"].as_f64().expect("Linux tells the memory")
}

fn row(planned: &PlannedCase, ranks: u32, bytes: f64, one: Option<f64>) -> Vec<String> {
    let estimate = Estimator::default().estimate(&planned.case).expect("the case is sound");
    let row = [
        planned.name.clone(),
        page::number(estimate.represented_atoms as f64),
        ranks.to_string(),
        page::number(1e-6 * bytes),
        one.map_or_else(String::new, |one| page::number(bytes / one)),
    ];
    eprintln!("  {}", row.join(" | "));
    row.to_vec()
}
