//! A study beside another one.

use std::fs;
use std::process::Command;

use super::{STUDY, Workspace, table};

#[test]
fn what_another_study_lacks_is_told_with_the_command_and_stands_there_once_it_is_done() {
    let place = Workspace::new();
    place.cgaft("run", &["--only", "coarse"]).succeeded();
    let other = STUDY
        .replace("study: slab", "study: other")
        .replace("length: 8 nm", "length: 9 nm");
    fs::write(place.path("other.yaml"), other).unwrap();
    place.write_study(&format!("{STUDY}report: {{beside: [other, nowhere]}}\n"));
    place.cgaft("run", &["--only", "coarse"]).succeeded();
    let page = || fs::read_to_string(place.results().join("report.md")).unwrap();
    let command = "study run other.yaml --only coarse --only mixed --only atoms --results results";
    assert!(page().contains(command), "{}", page());
    assert!(page().contains("cgaft study check nowhere.yaml"), "{}", page());

    let mut cgaft = Command::new(env!("CARGO_BIN_EXE_cgaft"));
    cgaft.args(["study", "run", "other.yaml", "--only", "coarse"]);
    cgaft.env("CGAFT_SOLVE", env!("CARGO_BIN_EXE_cgaft-solve"));
    assert!(cgaft.current_dir(place.path("")).output().unwrap().status.success());

    // Nothing is to be computed, and yet there is more to show.
    place.cgaft("run", &["--only", "coarse"]).succeeded();
    let rows = table(&place.results(), "side_by_side");
    let nodes = rows.iter().find(|row| row["quantity"] == "nodes").unwrap();
    assert_eq!([nodes["first_study"].as_str(), &nodes["study"]], ["slab", "other"]);
    assert_eq!(nodes["first"], nodes["value"]);
    assert!(page().contains("| crack.length | 8 nm | 9 nm |"), "{}", page());
    assert!(
        page().contains("study run other.yaml --only mixed --only atoms"),
        "{}",
        page()
    );
}
