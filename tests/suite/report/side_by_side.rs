//! Cases beside those of other studies, and beside each other.

use cgaft::plan::SideBySide;
use cgaft::report::{self, CaseResult, OtherStudy, Study};

use super::{finished, rows, text, three_meshes, written};

/// The cracks of `atoms` and `mixed` start at 1.80 % and 1.82 % and fork; that of `coarse` starts at 2.42 % and does not.
fn beside() -> Study {
    let set = |name: &str, cases: [&str; 3]| SideBySide {
        name: name.to_owned(),
        cases: cases.map(str::to_owned).to_vec(),
        initiation_strain: Some(0.02),
        first_branch: Some(40.0),
    };
    Study {
        others: vec![
            OtherStudy {
                name: "plain".to_owned(),
                cases: vec![finished("atoms", 10, 3_300, 0.0242, 1.9)],
                missing: Some("plain: no result of mixed yet".to_owned()),
            },
            OtherStudy {
                missing: Some("gone.yaml: cannot be read".to_owned()),
                ..OtherStudy::default()
            },
        ],
        side_by_side: vec![set("width of the band", ["atoms", "mixed", "coarse"])],
        ..three_meshes()
    }
}

#[test]
fn a_case_stands_beside_that_of_its_name_in_another_study() {
    let folder = written(&beside());
    let table = rows(&folder, "side_by_side");
    let row = |set: &str, quantity: &str| {
        let found = table
            .iter()
            .find(|row| row["set"] == set && row["quantity"] == quantity);
        found.unwrap_or_else(|| panic!("no {quantity} of {set}"))
    };
    let nodes = row("atoms", "nodes");
    assert_eq!([&nodes["first_study"], &nodes["study"]], ["quickstart", "plain"]);
    assert_eq!([&nodes["first"], &nodes["value"]], ["60000.0", "3300.0"]);
    let start = row("atoms", "initiation_strain");
    let summary = rows(&folder, "summary");
    let [coarse, atoms] = [0, 2].map(|row: usize| summary[row]["initiation_strain"].parse::<f64>().unwrap());
    assert_eq!(start["first"].parse::<f64>().unwrap(), atoms);
    let apart: f64 = start["relative_difference"].parse().unwrap();
    assert!((apart - (coarse / atoms - 1.0)).abs() < 1e-8, "{apart}");
    assert_eq!(row("atoms", "core_seconds")["value"], "3.8");
    assert!(table.iter().all(|row| row["set"] != "coarse" && row["set"] != "mixed"));
    let mut without = beside();
    without.cases[2] = CaseResult {
        name: "atoms".to_owned(),
        ..CaseResult::default()
    };
    assert!(!text(&written(&without), "report.md").contains("### atoms"));
    for file in ["report.html", "report.md"] {
        let page = text(&folder, file);
        for part in [
            "Beside other studies",
            "plain: no result of mixed yet",
            "gone.yaml: cannot be read",
            "(−94.5 %)",
        ] {
            assert!(page.contains(part), "{file}: {part}");
        }
    }
    report::write(&three_meshes(), folder.path()).unwrap();
    assert!(!folder.path().join("tables/side_by_side.csv").exists());
    assert!(!text(&folder, "report.html").contains("Beside other studies"));
}

#[test]
fn single_runs_differ_by_so_much_and_neither_pass_nor_fail() {
    let folder = written(&beside());
    let table = rows(&folder, "side_by_side");
    assert!(table.iter().all(|row| !row.contains_key("agrees")));
    let asked = table
        .iter()
        .filter(|row| row["case"] == "mixed" && !row["asked"].is_empty());
    assert_eq!(
        asked.map(|row| row["asked"].as_str()).collect::<Vec<_>>(),
        ["0.02", "40.0"]
    );
    for file in ["report.md", "report.html"] {
        let page = text(&folder, file);
        assert!(
            page.contains("mixed beside atoms, strain at initiation: differs by +1."),
            "{page}"
        );
        assert!(page.contains("within 2 % was asked for."));
        assert!(page.contains("coarse beside atoms, first branch: in atoms alone; within 40 ps was asked for."));
        for verdict in [": passes", ": fails", "allowed"] {
            assert!(!page.contains(verdict), "{file}: {verdict}");
        }
    }
}

#[test]
fn a_choice_that_is_a_word_here_and_has_parts_there_has_one_row() {
    let mut study = three_meshes();
    let choose = |key: &str, value: &str| (key.to_owned(), value.to_owned());
    study.cases[0].choices.push(choose("run.summation.gauss", "2"));
    study.cases[1].choices.push(choose("run.summation", "exact"));
    study.cases[2].choices.push(choose("run.summation", "exact"));
    let page = text(&written(&study), "report.md");
    assert!(page.contains("| run.summation | gauss 2 | exact | exact |"), "{page}");
    assert!(!page.contains("run.summation.gauss |"));
}
