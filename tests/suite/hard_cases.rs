//! The short ones of the hard cases; `make stability` computes all.

mod expected;

use std::path::Path;

use expected::studies;

/// Studies that take some seconds each.
const SHORT: [&str; 4] = ["caught", "refused", "scaled", "solids"];

#[test]
fn short_hard_cases_do_what_their_files_expect() {
    let results = tempfile::tempdir().unwrap();
    let short = studies()
        .into_iter()
        .filter(|study| SHORT.contains(&study.name.as_str()));
    let failures = short.flat_map(|study| {
        let found = study.run(Path::new(env!("CARGO_BIN_EXE_cgaft")), results.path());
        let failures = found.into_iter().filter_map(|found| found.failure());
        failures.map(move |failure| format!("{} {failure}", study.question))
    });
    let failures: Vec<String> = failures.collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
