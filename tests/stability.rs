//! The hard cases of `studies/hard-cases`: each is computed and compared with what its file expects.
//!
//! `make stability` runs all and writes `docs/stability.md`; `make test` runs the short ones (see `suite/hard_cases.rs`).

#[path = "suite/hard_cases/expected.rs"]
mod expected;

use std::fmt::Write;
use std::path::Path;

use expected::studies;

const HEAD: &str =
    "| case | expected | found | energy | closest | steps | speed |\n| --- | --- | --- | --- | --- | --- | --- |";

#[test]
fn every_hard_case_does_what_its_file_expects() {
    let results = Path::new(env!("CARGO_TARGET_TMPDIR")).join("stability");
    let mut page = String::from(include_str!("suite/hard_cases/page.md"));
    let mut failures = Vec::new();
    for study in studies() {
        let found = study.run(Path::new(env!("CARGO_BIN_EXE_cgaft")), &results);
        let _ = writeln!(page, "\n## {}\n\n{}\n\n{}", study.name, study.question, HEAD);
        for found in &found {
            let _ = writeln!(page, "{found}");
        }
        failures.extend(found.into_iter().filter_map(|found| found.failure()));
    }
    if std::env::var_os("CGAFT_WRITE_DOCS").is_some() {
        std::fs::write("docs/stability.md", &page).expect("docs can be written");
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
