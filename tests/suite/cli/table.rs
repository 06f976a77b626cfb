//! One table of many studies.

use super::{STUDY, Workspace};

/// Two studies that have been run: three lengths of the crack, and one of them again pulled faster.
fn two() -> Workspace {
    let place = Workspace::new();
    place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    let fast = STUDY
        .replace("study: slab", "study: fast")
        .replace("9.81e7 /s", "1.962e8 /s");
    let (head, _) = fast.split_once("  B:").unwrap();
    std::fs::write(place.path("fast.yaml"), head).unwrap();
    place.cgaft(&["study", "run", "fast.yaml"]).succeeded();
    place
}

/// The cells of a CSV text, its head first.
fn cells(text: &str) -> Vec<Vec<&str>> {
    text.lines().map(|line| line.split(',').collect()).collect()
}

#[test]
fn a_table_of_many_studies_has_what_differs_between_their_cases_as_columns() {
    let place = two();
    let folders = ["results/fast", "results/slab"];
    let said = place
        .cgaft(&[&["table", "summary", "--csv"][..], &folders].concat())
        .succeeded();
    let cells = cells(&said.stdout);
    assert_eq!(
        cells[0][..4],
        ["study", "case", "crack_length_nm", "loading_strain_rate_rate_per_s"]
    );
    let rows: Vec<&[&str]> = cells[1..].iter().map(|row| &row[..4]).collect();
    assert_eq!(
        rows,
        [
            ["fast", "A", "46", "196200000"],
            ["slab", "A", "46", "98100000"],
            ["slab", "B", "50", "98100000"],
            ["slab", "C", "55", "98100000"]
        ]
    );
    assert!(cells[0].contains(&"initiation_strain"), "{:?}", cells[0]);
    let screen = place
        .cgaft(&[&["table", "summary"][..], &folders].concat())
        .succeeded()
        .stdout;
    assert!(
        screen.starts_with("study  case  crack_length_nm  loading_strain_rate_rate_per_s"),
        "{screen}"
    );
    assert!(
        !screen.contains("initiation_strain"),
        "what says nothing is left out: {screen}"
    );
}

#[test]
fn folders_without_the_table_are_told_and_left_out() {
    let place = two();
    let said = place
        .cgaft(&["table", "summary", "results/slab", "results", "--csv"])
        .succeeded();
    assert_eq!(said.stdout.lines().count(), 4, "{}", said.stdout);
    assert!(said.stderr.contains("warning: results is left out"), "{}", said.stderr);
    let refused = place.cgaft(&["table", "sumary", "results/slab"]).ended_with(2);
    for told in ["no folder has a table `sumary`", "summary"] {
        assert!(refused.stderr.contains(told), "no `{told}` in {}", refused.stderr);
    }
}
