//! What a case costs is the time that processors work for it, whoever else uses the machine.

use std::fs;
use std::process::Command;

use serde_json::Value;

use super::ranks::{computed, ranks};
use super::{PATIENCE, Program, Workspace};

/// Between what the solver tells of itself and what the system counts for it and mpirun: starting them, and their end.
const BEYOND_THE_SOLVER: f64 = 0.5;

#[test]
fn core_seconds_are_the_processor_time_of_all_ranks_and_threads() {
    let place = Workspace::new();
    let (_, case) = computed(&place);
    for (count, threads) in [(1, "2"), (2, "1")] {
        let into = place.path(&format!("{count} ranks"));
        let job = ranks(count, &case, &into, &["--threads", threads]);
        let mut timed = Command::new("sh");
        timed.args(["-c", "\"$@\" >said && times", "sh"]).arg(job.get_program());
        timed.args(job.get_args()).current_dir(place.path(""));
        timed.envs(job.get_envs().filter_map(|(name, value)| Some((name, value?))));
        let said = Program::start(&mut timed, &place).wait(PATIENCE).succeeded();
        let counted: f64 = said
            .stdout
            .lines()
            .last()
            .unwrap()
            .split_whitespace()
            .map(seconds)
            .sum();
        let outcome: Value = serde_json::from_slice(&fs::read(into.join("outcome.json")).unwrap()).unwrap();
        let told = outcome["core_seconds"].as_f64().unwrap();
        assert!(
            told > 0.0 && told <= counted + 0.02 && counted - told < BEYOND_THE_SOLVER * counted,
            "{count} ranks: told {told} s, counted {counted} s"
        );
    }
}

/// Of a time such as `0m1.250s`.
fn seconds(text: &str) -> f64 {
    let (minutes, seconds) = text.trim_end_matches('s').split_once('m').unwrap();
    60.0 * minutes.parse::<f64>().unwrap() + seconds.parse::<f64>().unwrap()
}
