//! Speed against error.

use cgaft::plan::{Comparison, Expected};
use cgaft::report::Study;

use super::{finished, rows, text, three_meshes, written};

pub const COLUMNS: (&str, &str) = (
    "speed_against_error",
    "number,case,reference,core_seconds_per_ps,nodes,peak_memory_mib,stress_error,initiation_strain_error,\
     crack_speed_error,wave_arrival_error,k_ic_error,unbeaten_in",
);

/// The three meshes, one as good as the band but dearer, and one cheaper than the coarse one but worse.
fn economies() -> Study {
    let mut study = three_meshes();
    study.cases.push(finished("dear", 1, 20_000, 0.0182, 12.0));
    study.cases.push(finished("coarser", 10, 1_700, 0.0250, 0.9));
    study.comparisons.push(Comparison {
        name: "LAMMPS".to_owned(),
        file: "lammps.csv".to_owned(),
        notes: String::new(),
        table: "speed_against_error",
        values: vec![Expected {
            case: "atoms".to_owned(),
            keys: vec![],
            column: "core_seconds_per_ps",
            value: 0.05,
        }],
    });
    study
}

#[test]
fn every_economy_stands_with_its_cost_its_errors_and_what_beats_it() {
    let folder = written(&economies());
    let csv = text(&folder, "tables/speed_against_error.csv");
    assert_eq!(csv.lines().next(), Some(COLUMNS.1));
    let table = rows(&folder, "speed_against_error");
    let row = |case: &str| table.iter().find(|row| row["case"] == case).unwrap();
    assert!(table.iter().all(|row| row["reference"] == "atoms"));
    assert_eq!(
        row("atoms")["initiation_strain_error"],
        "",
        "nothing is wrong against itself"
    );
    let summary = rows(&folder, "summary");
    let start = |case: &str| -> f64 {
        let row = summary.iter().find(|row| row["case"] == case).unwrap();
        row["initiation_strain"].parse().unwrap()
    };
    let error: f64 = row("coarse")["initiation_strain_error"].parse().unwrap();
    assert!((error - (start("coarse") / start("atoms") - 1.0)).abs() < 1e-8);
    let unbeaten = |case: &str| row(case)["unbeaten_in"].contains("initiation_strain_error");
    assert!(["mixed", "coarse", "coarser"].into_iter().all(unbeaten), "{csv}");
    assert!(!unbeaten("dear"), "mixed is as near and cheaper");
    // Two cores for 7.4 s.
    let series = rows(&folder, "stress_strain");
    let end: f64 = series.iter().rev().find(|row| row["case"] == "mixed").unwrap()["time_ps"]
        .parse()
        .unwrap();
    let cost: f64 = row("mixed")["core_seconds_per_ps"].parse().unwrap();
    assert!((cost * end / (2.0 * 7.4) - 1.0).abs() < 1e-6);
}

#[test]
fn the_figure_shows_references_and_other_programs_by_their_cost() {
    let folder = written(&economies());
    let figure = text(&folder, "figures/speed-against-error-initiation-strain.svg");
    assert!(figure.contains("LAMMPS") && figure.contains("atoms"));
    assert!(figure.contains("core-seconds"));
    assert!(text(&folder, "report.md").contains("Speed against error: strain at initiation"));
    let measured = &rows(&folder, "comparison")[0];
    assert_eq!(
        (measured["case"].as_str(), measured["reference"].as_str()),
        ("atoms", "0.05")
    );
    assert!(!measured["measured"].is_empty());
}

#[test]
fn the_page_recommends_the_cheapest_choice_that_is_near_enough() {
    let folder = written(&economies());
    let page = text(&folder, "report.md");
    assert!(page.contains("**Take "), "{page}");
    assert!(
        page.contains("| quantity | within 1 % | within 2 % | within 5 % | within 10 % |"),
        "{page}"
    );
    let table = rows(&folder, "cheapest_choice");
    let choice = |within: &str| {
        let is_it = |row: &&std::collections::BTreeMap<String, String>| {
            row["error"] == "initiation_strain_error" && row["within_percent"] == within
        };
        table.iter().find(is_it).unwrap()
    };
    // The band starts 1.1 % late at a fifth of the cost; the cheaper meshes start a third late or more.
    assert_eq!(choice("2.0")["case"], "mixed");
    assert_eq!(choice("10.0")["case"], "mixed");
    assert!(choice("2.0")["times_cheaper"].parse::<f64>().unwrap() > 4.0);
    assert_eq!(choice("1.0")["case"], "atoms", "nothing cheaper is that near");
    let figure = text(&folder, "figures/speed-against-error-initiation-strain.svg");
    assert!(figure.contains("\ncoarser\n"), "points have the names of their cases");
}

#[test]
fn the_constants_of_the_material_are_on_the_page() {
    let page = text(&written(&three_meshes()), "report.md");
    for constant in [
        "r0 = ",
        "E = ",
        "ν = ",
        "c\\_L = ",
        "c\\_R = ",
        "2γ = ",
        "K of Griffith = 1.0",
    ] {
        assert!(page.contains(constant), "no `{constant}` in {page}");
    }
}

#[test]
fn a_study_of_few_cases_is_compared_side_by_side_only() {
    let folder = written(&three_meshes());
    assert!(!folder.path().join("tables/speed_against_error.csv").exists());
    assert!(!text(&folder, "report.html").contains("Speed against error"));
}
