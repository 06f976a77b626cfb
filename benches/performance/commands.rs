//! What a person waits for at the command line.

use std::fs;
use std::process::{Command, Stdio};

use super::demand::{self, Demand};
use super::{clock, page, specimens};

pub const SECONDS: &str = "s of a core";

/// Runs `cgaft` and lets nothing fail silently. Seconds of a core, its solvers' too: what a person waits for on a machine
/// that does nothing else, because nothing here waits for anything but the processor.
pub fn cgaft(arguments: &[&str]) -> f64 {
    let before = clock::children_seconds();
    let status = Command::new(env!("CARGO_BIN_EXE_cgaft"))
        .args(arguments)
        .env(
            "CGAFT_SOLVE",
            concat!(env!("CARGO_MANIFEST_DIR"), "/target/mpi/cgaft-solve"),
        )
        .stdout(Stdio::null())
        .status();
    assert!(status.expect("cgaft starts").success(), "cgaft {arguments:?}");
    clock::children_seconds() - before
}

/// A study and the folder of its results as arguments.
pub fn in_scratch(study: &str) -> [String; 3] {
    let results = page::scratch().display().to_string();
    [
        specimens::study(study).display().to_string(),
        "--results".to_owned(),
        results,
    ]
}

pub fn measure() {
    const TIMES: usize = 5;
    let [study, flag, results] = in_scratch("thousand");
    let second = Demand::Below { most: 1.0, aim: None };
    let check = clock::median_of(TIMES, || cgaft(&["study", "check", &study]));
    demand::record(demand::CHECK, check, SECONDS, second);
    let plan = clock::median_of(TIMES, || cgaft(&["study", "plan", &study, &flag, &results]));
    demand::record(demand::PLAN, plan, SECONDS, second);

    // A study that is done: three small runs and a report.
    let folder = page::scratch();
    fs::create_dir_all(&folder).expect("the scratch folder can be written");
    let quickstart = concat!(env!("CARGO_MANIFEST_DIR"), "/studies/quickstart.yaml");
    let run = ["study", "run", quickstart, "--quiet", "--results", &results];
    cgaft(&run);
    let again = clock::median_of(TIMES, || cgaft(&run));
    demand::record(demand::NO_OP, again, SECONDS, Demand::Below { most: 0.2, aim: None });
}
