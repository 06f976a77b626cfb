//! The studies that come with the program.

use std::fs;

use cgaft::plan::plan;
use cgaft::{setup, study};

use super::{check, yaml_files};

#[test]
fn every_study_in_the_folder_is_shipped_and_names_its_schema() {
    let files = yaml_files("studies");
    let names: Vec<&str> = files
        .iter()
        .map(|path| path.file_name().unwrap().to_str().unwrap())
        .collect();
    let mut shipped = study::SHIPPED.each_ref().map(|shipped| shipped.name);
    shipped.sort();
    assert_eq!(names, shipped);
    for path in files {
        let text = fs::read_to_string(&path).unwrap();
        assert!(
            text.starts_with("# yaml-language-server: $schema=../schemas/study.schema.json\n"),
            "{}",
            path.display()
        );
        assert!(check(&path).unwrap().question.is_some());
    }
}

/// Nodes, elements and atoms of the cases of a shipped study.
fn counts(name: &str) -> Vec<(String, [u64; 3])> {
    let plan = plan(&study::read(name).unwrap()).unwrap();
    let mut estimator = setup::Estimator::default();
    let mut count = |case: &cgaft::plan::PlannedCase| {
        let estimate = estimator.estimate(&case.case).unwrap();
        (
            case.name.clone(),
            [estimate.nodes, estimate.elements, estimate.represented_atoms],
        )
    };
    plan.cases.iter().map(&mut count).collect()
}

#[test]
fn the_models_have_the_nodes_elements_and_atoms_of_table_5_1() {
    // [Deng2011] Table 5-1.
    let table = [
        ("A", [384_480, 128_160, 7_048_800]),
        ("B", [384_480, 128_160, 7_048_800]),
        ("C", [384_480, 128_160, 7_048_800]),
        ("D", [192_480, 64_160, 3_528_800]),
        ("E", [768_960, 256_320, 14_097_600]),
    ];
    let found = counts("models-A-E.yaml");
    assert_eq!(found, table.map(|(name, counts)| (name.to_owned(), counts)));
    for name in ["models-A-E-mixed.yaml", "models-A-E-atoms.yaml"] {
        let atoms = counts(name).into_iter().filter(|(case, _)| case != "D2");
        let atoms: Vec<u64> = atoms.map(|(_, [_, _, atoms])| atoms).collect();
        assert_eq!(atoms, table.map(|(_, [_, _, atoms])| atoms), "{name}");
    }
}

/// What cases took on a core of a quiet 2.6 GHz EPYC, s.
const MEASURED: [(&str, &str, f64); 8] = [
    ("models-A-E.yaml", "A", 346.0),
    ("speed-against-error.yaml", "n10", 1.20),
    ("speed-against-error.yaml", "n5", 5.37),
    ("speed-against-error.yaml", "band4", 4.64),
    ("speed-against-error.yaml", "atoms", 5.99),
    ("speed-against-error.yaml", "far-atoms", 14.5),
    ("speed-against-error.yaml", "far-n10", 2.78),
    ("speed-against-error.yaml", "smooth-n10", 2.44),
];

/// The largest memory that solvers took, bytes.
const PEAKS: [(&str, &str, f64); 7] = [
    ("models-A-E.yaml", "A", 2.57e8),
    ("models-A-E.yaml", "C", 1.93e8),
    ("models-A-E.yaml", "D", 0.99e8),
    ("models-A-E.yaml", "E", 2.33e8),
    ("models-A-E-mixed.yaml", "D", 1.60e8),
    ("case-2.yaml", "atoms", 3.97e8),
    ("speed-against-error.yaml", "n10", 2.3e7),
];

/// Times and peaks depend on how a crack runs and on what else a machine does: an estimate tells minutes from hours.
const NEAR: f64 = 1.55;

#[test]
fn estimates_come_near_to_what_shipped_cases_took() {
    let mut estimator = setup::Estimator::default();
    let mut estimate = |study: &str, name: &str| {
        let plan = plan(&study::read(study).unwrap()).unwrap();
        let case = plan.cases.iter().find(|case| case.name == name).unwrap();
        estimator.estimate(&case.case).unwrap()
    };
    let is_near = |ratio: f64| (1.0 / NEAR..NEAR).contains(&ratio);
    for (study, case, measured) in MEASURED {
        let seconds = estimate(study, case).seconds;
        assert!(
            is_near(seconds / measured),
            "{study} {case}: {seconds} s for {measured} s"
        );
    }
    for (study, case, measured) in PEAKS {
        let bytes = estimate(study, case).memory_bytes as f64;
        assert!(
            is_near(bytes / measured),
            "{study} {case}: {bytes} for {measured} bytes"
        );
    }
}

#[test]
fn cases_1_and_2_have_the_elements_of_the_source() {
    // [Deng2011] chapter 5: 32,060 elements and 96,180 nodes.
    for name in ["case-1.yaml", "case-2.yaml"] {
        let found = counts(name);
        assert_eq!(found[0], ("elements".to_owned(), [96_180, 32_060, 1_763_300]), "{name}");
        assert_eq!(found[1].1[2], 1_763_300, "{name}");
    }
}

#[test]
fn ranks_of_the_fixed_size_share_its_elements_and_those_of_the_scaled_size_have_as_many_each() {
    let elements = |name: &str| {
        counts(name)
            .into_iter()
            .map(|(_, [_, elements, _])| elements)
            .collect::<Vec<_>>()
    };
    assert_eq!(elements("scaling-fixed.yaml"), [128_160, 128_160]);
    assert_eq!(elements("scaling-scaled.yaml"), [64_080, 128_160]);
    // [Deng2011] Table 4-1: 5,120 blocks, and 640 a processor; a block is three elements.
    assert_eq!(elements("scaling-fixed-3d.yaml"), [3 * 5_120; 2]);
    assert_eq!(elements("scaling-scaled-3d.yaml"), [3 * 640, 3 * 1_280]);
}

#[test]
fn every_rank_of_the_scaled_size_has_the_work_of_one_and_two_neighbours_at_most() {
    // A rank is never farther from its share than a group of elements, of which it has 160, or in the solid 480.
    for (name, groups) in [("scaling-scaled.yaml", 160.0), ("scaling-scaled-3d.yaml", 480.0)] {
        let plan = plan(&study::read(name).unwrap()).unwrap();
        let counts = [1, 2, 3, 512];
        let found = setup::burdens(&plan.cases[0].case, 1, study::Growth::Scaled, &counts).unwrap();
        assert_eq!(found.iter().map(|burden| burden.ranks).collect::<Vec<_>>(), counts);
        let neighbours: Vec<u32> = found.iter().map(|burden| burden.messages).collect();
        assert_eq!(neighbours, [0, 1, 2, 2], "{name}");
        for burden in &found {
            let share = burden.work * f64::from(burden.ranks);
            assert!((share - 1.0).abs() < 1.0 / groups, "{name}: {burden:?}");
        }
        assert_eq!(found[3].bytes, found[2].bytes, "{name}");
    }
}

#[test]
fn what_the_scaling_studies_compare_with_is_tables_4_2_and_4_3() {
    // [Deng2011] Table 4-2 and [Deng2011] Table 4-3: the first step of their last rows.
    for (name, solution) in [
        ("scaling-fixed.yaml", 0.110),
        ("scaling-scaled.yaml", 1.076),
        ("scaling-fixed-3d.yaml", 0.110),
        ("scaling-scaled-3d.yaml", 1.076),
    ] {
        let plan = plan(&study::read(name).unwrap()).unwrap();
        let values = &plan.comparisons[0].values;
        assert_eq!(values.len(), 5 * 8, "{name}");
        let last = values
            .iter()
            .find(|value| value.case == "64" && value.column == "solv_s_per_step");
        assert_eq!(last.unwrap().value, solution);
    }
}

#[test]
fn a_shipped_study_is_found_by_its_name_alone() {
    let plan = plan(&study::read("quickstart.yaml").unwrap()).unwrap();
    assert_eq!(plan.study, "quickstart");
    assert_eq!(
        plan.cases.iter().map(|case| case.name.as_str()).collect::<Vec<_>>(),
        ["coarse", "mixed", "atoms"]
    );
    let message = study::read("elsewhere/quickstart.yaml").unwrap_err().to_string();
    assert!(message.contains("no such file"), "{message}");
}

#[test]
fn what_a_table_says_of_itself_comes_with_its_values() {
    let plan = plan(&study::read("models-A-E.yaml").unwrap()).unwrap();
    let arrivals = plan
        .comparisons
        .iter()
        .find(|comparison| comparison.name == "waves")
        .unwrap();
    assert!(
        arrivals
            .notes
            .starts_with("Deng (2011), Table 5-3: when reflected waves are back")
    );
    assert!(
        arrivals.notes.ends_with("none leads from the crack to the grips."),
        "{}",
        arrivals.notes
    );
}

#[test]
fn what_a_shipped_study_compares_with_is_shipped_too() {
    for shipped in &study::SHIPPED {
        let plan = plan(&study::read(shipped.name).unwrap()).unwrap();
        let files: Vec<&str> = plan
            .comparisons
            .iter()
            .map(|comparison| comparison.file.as_str())
            .collect();
        let tables: Vec<&str> = shipped.tables.iter().map(|(name, _)| *name).collect();
        assert_eq!(files, tables, "{}", shipped.name);
    }
}
