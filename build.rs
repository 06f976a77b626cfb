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
    println!(
        "cargo::rustc-env=CGAFT_COMMIT={}",
        git(&["rev-parse", "--short=12", "HEAD"]).unwrap_or_default()
    );
    println!("cargo::rerun-if-changed=build.rs");
    // The log of HEAD grows with every commit and checkout. A path that does not exist would rebuild each time.
    if let Some(log) = git(&["rev-parse", "--git-path", "logs/HEAD"]).filter(|log| Path::new(log).exists()) {
        println!("cargo::rerun-if-changed={log}");
    }
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    output
        .status
        .success()
        .then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}
