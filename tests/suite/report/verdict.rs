//! The first sentence of a report says no more than is known.

use cgaft::report::Study;

use super::super::synthetic::{breaks, straight};
use super::{finished, text, three_meshes, written};

#[test]
fn the_verdict_tells_that_no_crack_starts() {
    let study = |starts: [f64; 2]| Study {
        cases: vec![
            finished("coarse", 10, 3_300, starts[0], 1.9),
            finished("atoms", 1, 60_000, starts[1], 41.0),
        ],
        ..three_meshes()
    };
    let none = text(&written(&study([0.9, 0.9])), "report.html");
    assert!(
        none.contains(
            "In atoms the crack does not start up to 2.80 % strain; in coarse it does not start up to 2.80 %"
        ),
        "{none}"
    );
    let one = text(&written(&study([0.02, 0.9])), "report.html");
    assert!(
        one.contains("In atoms the crack does not start") && one.contains("in coarse it starts at"),
        "{one}"
    );
}

#[test]
fn what_the_elements_do_to_a_crack_is_told_where_there_are_such_elements() {
    let page = |cases: std::ops::Range<usize>| {
        let mut study = three_meshes();
        study.cases = study.cases.drain(cases).collect();
        text(&written(&study), "report.md")
    };
    let told =
        |page: &str| ["Cracks through large elements", "Cracks in a band of atoms"].map(|note| page.contains(note));
    assert_eq!(told(&page(0..1)), [true, false], "coarse");
    assert_eq!(told(&page(1..2)), [false, true], "mixed");
    let mut atoms = three_meshes();
    atoms.cases = vec![atoms.cases.remove(2)];
    let setting = atoms.cases[0].setting.as_mut().unwrap();
    setting.nodes = setting.represented_atoms;
    assert_eq!(told(&text(&written(&atoms), "report.md")), [false, false]);
}

#[test]
fn cases_of_different_specimens_are_answered_for_together() {
    let mut study = three_meshes();
    for (case, stretch) in study.cases.iter_mut().zip([1.0, 1.1, 1.2]) {
        case.setting.as_mut().unwrap().length *= stretch;
    }
    let page = text(&written(&study), "report.md");
    let answer = page.lines().find(|line| line.starts_with("**")).unwrap();
    assert!(answer.contains("The crack starts at "), "{answer}");
    for name in ["(coarse)", "(mixed)", "(atoms)", "one probe"] {
        assert!(answer.contains(name), "{name}: {answer}");
    }
    let cost = answer.find("They took").unwrap();
    assert!(answer.find("starts at").unwrap() < cost, "cost comes last: {answer}");
}

#[test]
fn starts_that_the_probes_cannot_tell_apart_are_not_told_apart() {
    let study = Study {
        cases: vec![
            finished("mixed", 1, 11_800, 0.0180, 7.4),
            finished("atoms", 1, 60_000, 0.0180, 41.0),
        ],
        ..three_meshes()
    };
    let page = text(&written(&study), "report.html");
    assert!(page.contains("in mixed at the same strain, within a probe"), "{page}");
    assert!(
        page.contains("none within a probe (0.") && !page.contains("+0.0 %"),
        "{page}"
    );
}

#[test]
fn an_energy_error_that_counts_is_told_first() {
    let study = |error: f64| {
        let mut study = three_meshes();
        study.cases[0].manifest.energy_error = Some(error);
        text(&written(&study), "report.html")
    };
    let told = "the energy error of coarse is 2.2 % of the work.";
    assert!(study(0.022).contains(told));
    assert!(!study(0.009).contains("Beware"));
}

#[test]
fn a_specimen_that_parts_away_from_its_crack_is_told_first() {
    let told = |rows_up: i32| {
        let mut study = three_meshes();
        let band = straight(0.0, 400.0);
        let lifted: Vec<[i32; 3]> = band
            .iter()
            .map(|&[column, row, direction]| [column - rows_up / 2, row + rows_up, direction])
            .collect();
        study.cases[0].series.bonds = breaks(&lifted, 30);
        text(&written(&study), "report.html")
    };
    // The grips are 65 spacings, 75 rows, from the crack plane.
    let expected = [
        (70, "coarse parted away from its crack, at the upper grip, at 0.21"),
        (-70, "at the lower grip"),
        (50, "in its upper half, 11.1 nm from the crack plane"),
    ];
    for (rows_up, words) in expected {
        let page = told(rows_up);
        assert!(page.contains(words), "no `{words}` in {page}");
    }
    let untouched = text(&written(&three_meshes()), "report.html");
    assert!(!untouched.contains("parted away"), "{untouched}");
}

#[test]
fn of_bonds_of_nodes_no_toughness_is_given_that_takes_the_moduli_of_the_lattice() {
    let mut study = three_meshes();
    let nodal = ("run.summation".to_owned(), "nodal".to_owned());
    study.cases[0].choices.push(nodal);
    let folder = written(&study);
    assert!(text(&folder, "report.html").contains("coarse sums the bonds of nodes only, which fails the patch test"));
    let table = text(&folder, "tables/k_ic.csv");
    let mut lines = table.lines();
    let head: Vec<&str> = lines.next().unwrap().split(',').collect();
    let coarse: Vec<&str> = lines
        .find(|line| line.starts_with("coarse"))
        .unwrap()
        .split(',')
        .collect();
    for column in [
        "k_griffith_mpa_sqrt_m",
        "k_energy_balance_mpa_sqrt_m",
        "k_between_grips_mpa_sqrt_m",
    ] {
        let at = head.iter().position(|name| *name == column).unwrap();
        assert_eq!(coarse[at], "", "{column}");
    }
}
