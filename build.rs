//! Tells the program its commit and features, for the provenance of every run. Outside git there is just no commit.

use std::path::Path;
use std::process::Command;

fn main() {
    let mut features: Vec<String> = std::env::vars()
        .filter_map(|(name, _)| {
            name.strip_prefix("CARGO_FEATURE_")
                .map(|feature| feature.to_lowercase().replace('_', "-"))
        })
        .filter(|feature| feature != "default")
        .collect();
    features.sort();
    println!("cargo::rustc-env=CGAFT_FEATURES={}", features.join(" "));
    println!("cargo::rustc-env=CGAFT_COMMIT={}", commit().unwrap_or_default());
    // What the program is made from: a change of it may make a commit dirty, or clean again.
    SOURCES
        .iter()
        .for_each(|source| println!("cargo::rerun-if-changed={source}"));
    // The log of HEAD grows with every commit and checkout. A path that does not exist would rebuild each time.
    if let Some(log) = git(&["rev-parse", "--git-path", "logs/HEAD"]).filter(|log| Path::new(log).exists()) {
        println!("cargo::rerun-if-changed={log}");
    }
}

const SOURCES: [&str; 5] = ["build.rs", "Cargo.toml", "Cargo.lock", "src", "studies"];

/// The commit, with `-dirty` behind it where the sources are not those of that commit.
fn commit() -> Option<String> {
    let commit = git(&["rev-parse", "--short=12", "HEAD"])?;
    let changes = git(&[&["status", "--porcelain", "--"], SOURCES.as_slice()].concat())?;
    let mark = if changes.is_empty() { "" } else { "-dirty" };
    Some(format!("{commit}{mark}"))
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    output
        .status
        .success()
        .then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}
