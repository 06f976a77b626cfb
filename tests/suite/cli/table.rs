//! One table of many studies.

use super::{STUDY, Workspace};

/// Two studies that have been run: three lengths of the crack, and one of them again with smaller elements.
fn two() -> Workspace {
    let place = Workspace::new();
    place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    let fine = STUDY
        .replace("study: slab", "study: fine")
        .replace("element: 10", "element: 5");
    let (head, _) = fine.split_once("  B:").unwrap();
    std::fs::write(place.path("fine.yaml"), head).unwrap();
    place.cgaft(&["study", "run", "fine.yaml"]).succeeded();
    place
}

/// The cells of a CSV text, its head first.
fn cells(text: &str) -> Vec<Vec<&str>> {
    text.lines().map(|line| line.split(',').collect()).collect()
}

#[test]
fn a_table_of_many_studies_has_what_differs_between_their_cases_as_columns() {
    let place = two();
    let folders = ["results/fine", "results/slab"];
    let said = place
        .cgaft(&[&["table", "summary", "--csv"][..], &folders].concat())
        .succeeded();
    let cells = cells(&said.stdout);
    assert_eq!(
        cells[0][..4],
        ["study", "case", "resolution_element", "crack_length_nm"]
    );
    let rows: Vec<&[&str]> = cells[1..].iter().map(|row| &row[..4]).collect();
    assert_eq!(
        rows,
        [
            ["fine", "A", "5", "46"],
            ["slab", "A", "10", "46"],
            ["slab", "B", "10", "50"],
            ["slab", "C", "10", "55"]
        ]
    );
    assert!(cells[0].contains(&"initiation_strain"), "{:?}", cells[0]);
    let screen = place
        .cgaft(&[&["table", "summary"][..], &folders].concat())
        .succeeded()
        .stdout;
    assert!(
        screen.starts_with("study  case  resolution_element  crack_length_nm"),
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
