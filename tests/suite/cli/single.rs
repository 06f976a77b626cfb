//! `cgaft-solve` as a person calls it.

use std::process::Command;

use super::{Workspace, said};

fn solve(place: &Workspace, arguments: &[&str]) -> super::Said {
    said(
        Command::new(env!("CARGO_BIN_EXE_cgaft-solve"))
            .args(arguments)
            .current_dir(place.folder.path()),
    )
}

#[test]
fn a_case_file_that_is_not_there_is_bad_input() {
    let place = Workspace::new();
    let refused = solve(&place, &["nowhere.yaml", "--into", "out"]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("nowhere.yaml"), "{}", refused.stderr);
    assert!(!place.path("out").exists());
}

#[test]
fn a_folder_with_another_case_is_refused() {
    let place = Workspace::new();
    place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    std::fs::create_dir(place.path("out")).unwrap();
    std::fs::copy(
        place.path("results/slab/cases/A/case.yaml"),
        place.path("out/case.yaml"),
    )
    .unwrap();
    let refused = solve(&place, &["results/slab/cases/B/case.yaml", "--into", "out"]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("another case"), "{}", refused.stderr);
}
