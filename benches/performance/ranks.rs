//! Two ranks on one specimen, and two specimens with one rank each side by side.

use serde_json::Value;

use super::demand::{self, Demand};
use super::{clock, commands, model_a, page};

pub fn measure() {
    const TURNS: usize = 3;
    let ratio = clock::median_of(TURNS, || {
        run("2", &["--only", "one"]);
        let together = seconds_of("one");
        run("1", &["--jobs", "2"]);
        let beside = 0.5 * (seconds_of("one") + seconds_of("other"));
        // The two did twice the work.
        beside / (2.0 * together)
    });
    let demand = Demand::AtLeast { least: 0.95, aim: 0.99 };
    demand::record(demand::RANKS, ratio, "of their speed", demand);
}

fn run(ranks: &str, which: &[&str]) {
    let [study, flag, results] = commands::in_scratch("ranks");
    let mut arguments = vec![
        "study",
        "run",
        &study,
        "--fresh",
        "--quiet",
        "--ranks",
        ranks,
        "--threads",
        "1",
    ];
    arguments.extend([flag.as_str(), results.as_str()]);
    arguments.extend(which);
    commands::cgaft(&arguments);
}

/// How long a case took from its first step on, by the clock on the wall, output included but for its publishing. A specimen
/// that has been cut once was cut before.
fn seconds_of(case: &str) -> f64 {
    let outcome = model_a::outcome(&page::scratch().join("ranks/cases").join(case));
    let phases = outcome["cost"].as_array().expect("the phases are there").iter();
    let is_step = |phase: &&Value| match phase["name"].as_str().expect("a name") {
        "mesh" | "set-up" | "publishing" => false,
        "cut" => phase["calls"] != 1,
        _ => true,
    };
    let steps = phases.filter(is_step);
    steps.map(|phase| phase["seconds"].as_f64().expect("a number")).sum()
}
