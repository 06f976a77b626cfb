//! What a report of waves and branching shows: stages, motion, definitions of K, the first branch beside the waves.

use cgaft::plan::{Comparison, Expected, Stages};
use cgaft::report::Study;

use super::{files, rows, text, three_meshes, written};
use crate::suite::synthetic::setting;

/// The cracks of `mixed` and `atoms` start at 1.82 % and 1.80 % and fork; their films have pictures at 1.4 % and 2.8 %.
fn with_stages() -> Study {
    let stages = Stages {
        cases: vec!["atoms".to_owned()],
        strains: vec![0.01, 0.03],
    };
    let value = |case: &str, column, value| Expected {
        case: case.to_owned(),
        keys: Vec::new(),
        column,
        value,
    };
    let comparison = |table: &'static str, values| Comparison {
        name: table.to_owned(),
        file: format!("reference/{table}.csv"),
        notes: String::new(),
        table,
        values,
    };
    Study {
        stages: Some(stages),
        comparisons: vec![
            comparison("k_ic", vec![value("atoms", "k_ic_reference_mpa_sqrt_m", 1.0)]),
            comparison(
                "first_branch",
                vec![
                    value("atoms", "reference_from_ps", 1.0),
                    value("atoms", "reference_to_ps", 2.0),
                    value("coarse", "reference_from_ps", 1.0),
                    value("coarse", "reference_to_ps", 2.0),
                ],
            ),
            comparison(
                "summary",
                vec![value("atoms", "nodes", 60_000.0), value("mixed", "nodes", 1.0)],
            ),
        ],
        ..three_meshes()
    }
}

#[test]
fn a_case_is_shown_at_its_stages_and_in_motion_and_all_that_branch_where_they_do() {
    let folder = written(&with_stages());
    let figures = files(&folder.path().join("figures"));
    let pictures: Vec<&str> = figures
        .keys()
        .map(String::as_str)
        .filter(|name| name.ends_with(".png"))
        .collect();
    assert_eq!(
        pictures,
        [
            "branch-atoms.png",
            "branch-mixed.png",
            "motion.png",
            "path-atoms.png",
            "path-coarse.png",
            "path-mixed.png",
            "slab-atoms.png",
            "slab-coarse.png",
            "slab-mixed.png",
            "stage-atoms-1.00percent.png",
            "stage-atoms-3.00percent.png"
        ]
    );
    // The chunk of an animated PNG that tells its number of pictures.
    let motion = &figures["motion.png"];
    let place = motion.windows(4).position(|word| word == b"acTL").unwrap();
    assert_eq!(motion[place + 4..place + 8], [0, 0, 0, 2]);
    assert_ne!(
        figures["stage-atoms-1.00percent.png"],
        figures["stage-atoms-3.00percent.png"]
    );
    let page = text(&folder, "report.html");
    assert!(page.contains("atoms through time") && page.contains("At the first branch"));
    assert!(
        figures.keys().any(|name| name == "arrivals-atoms.svg"),
        "{:?}",
        figures.keys()
    );
    let fresh = written(&three_meshes());
    cgaft::report::write(&three_meshes(), folder.path()).unwrap();
    assert!(files(folder.path()) == files(fresh.path()), "the old pictures are gone");
}

#[test]
fn every_definition_of_k_stands_beside_the_source_and_the_nearest_is_named() {
    let folder = written(&with_stages());
    let table = rows(&folder, "k_ic");
    let atoms = &table[2];
    let number = |column: &str| atoms[column].parse::<f64>().unwrap();
    // sqrt(E C H/2) strain over the thickness, C = E/(1 - nu^2), with the strain of the probe before the start.
    let setting = setting();
    let start: f64 = rows(&folder, "summary")[2]["initiation_strain"].parse().unwrap();
    let stiffness = setting.young_modulus * (0.5 * setting.height * 9.0 / 8.0).sqrt() / setting.thickness;
    let expected = stiffness * start * 160.217_663_4 * 1e-9_f64.sqrt();
    let share = number("k_energy_balance_mpa_sqrt_m") / expected;
    assert!((0.99..1.0).contains(&share), "{share}");
    assert_eq!(
        atoms["k_between_grips_mpa_sqrt_m"], "",
        "no factor is known near 0.325 high with a crack of a quarter"
    );
    assert!((number("k_griffith_mpa_sqrt_m") - 1.005).abs() < 1e-3);
    assert_eq!(atoms["k_ic_reference_mpa_sqrt_m"], "1.0");
    assert_eq!(table[0]["k_ic_reference_mpa_sqrt_m"], "");
    let page = text(&folder, "report.md");
    assert!(
        page.contains("Nearest to the source comes Griffith's balance"),
        "{page}"
    );
    assert!(page.contains("1 of 2 numbers of nodes, elements and atoms are those of the source."));
}

#[test]
fn the_first_branch_is_told_beside_the_source_and_the_waves_that_are_back() {
    let folder = written(&with_stages());
    let table = rows(&folder, "first_branch");
    let after: f64 = table[2]["after_start_ps"].parse().unwrap();
    let summary = &rows(&folder, "summary")[2];
    let [branch, start] =
        ["first_branch_time_ps", "initiation_time_ps"].map(|key| summary[key].parse::<f64>().unwrap());
    assert!((after - (branch - start)).abs() < 1e-6);
    assert_eq!(
        [&table[2]["reference_from_ps"], &table[2]["reference_to_ps"]],
        ["1.0", "2.0"]
    );
    assert_eq!(table[0]["after_start_ps"], "");
    let page = text(&folder, "report.md");
    assert!(page.contains("later than the source between 1 and 2 ps"), "{page}");
    assert!(page.contains("coarse: no branch up to the end of the run"), "{page}");
    assert!(page.contains("longitudinal from the top and bottom faces"), "{page}");
}

#[test]
fn one_factor_between_the_source_and_the_field_near_the_tip_is_told() {
    let mut study = three_meshes();
    let atoms = study.cases[2].clone();
    for case in &mut study.cases {
        *case = cgaft::report::CaseResult {
            name: case.name.clone(),
            ..atoms.clone()
        };
    }
    let near = |folder: &tempfile::TempDir| -> Vec<f64> {
        let table = rows(folder, "k_ic");
        table
            .iter()
            .map(|row| row["k_near_tip_mpa_sqrt_m"].parse().unwrap())
            .collect()
    };
    let found = near(&written(&study));
    let compared = |factors: [f64; 3]| {
        let values = ["coarse", "mixed", "atoms"].iter().zip(&found).zip(factors);
        let values = values.map(|((case, near), factor)| Expected {
            case: (*case).to_owned(),
            keys: Vec::new(),
            column: "k_ic_reference_mpa_sqrt_m",
            value: factor * near,
        });
        Comparison {
            name: "k".to_owned(),
            file: "k.csv".to_owned(),
            notes: String::new(),
            table: "k_ic",
            values: values.collect(),
        }
    };
    study.comparisons = vec![compared([1.34, 1.32, 1.33])];
    let page = text(&written(&study), "report.md");
    assert!(
        page.contains("The source's value is 1.33 times that of the field near the tip in all 3 cases"),
        "{page}"
    );
    study.comparisons = vec![compared([1.34, 1.2, 1.33])];
    assert!(!text(&written(&study), "report.md").contains("times that of the field near the tip"));
}
