//! What a person waits for at the command line.

use std::fs;
use std::process::{Command, Stdio};

use super::demand::{self, Demand};
use super::{clock, page, specimens};

/// Runs `cgaft` and lets nothing fail silently; seconds by the clock on the wall.
pub fn cgaft(arguments: &[&str]) -> f64 {
    clock::wall_seconds(|| {
        let status = Command::new(env!("CARGO_BIN_EXE_cgaft"))
            .args(arguments)
            .stdout(Stdio::null())
            .status();
        assert!(status.expect("cgaft starts").success(), "cgaft {arguments:?}");
    })
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
    demand::record(demand::CHECK, check, "s", second);
    let plan = clock::median_of(TIMES, || cgaft(&["study", "plan", &study, &flag, &results]));
    demand::record(demand::PLAN, plan, "s", second);

    // A study that is done: three small runs and a report.
    let folder = page::scratch();
    fs::create_dir_all(&folder).expect("the scratch folder can be written");
    let quickstart = concat!(env!("CARGO_MANIFEST_DIR"), "/studies/quickstart.yaml");
    let run = ["study", "run", quickstart, "--quiet", "--results", &results];
    cgaft(&run);
    let again = clock::median_of(TIMES, || cgaft(&run));
    demand::record(demand::NO_OP, again, "s", Demand::Below { most: 0.2, aim: None });
}
