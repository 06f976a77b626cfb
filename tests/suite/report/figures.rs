//! The files of the figures.

use std::fs;

use cgaft::report;

use super::{files, three_meshes, written};

#[test]
fn every_figure_has_a_name_a_description_and_units() {
    let folder = written(&three_meshes());
    let figures = files(&folder.path().join("figures"));
    let drawings: Vec<_> = figures.iter().filter(|(name, _)| name.ends_with(".svg")).collect();
    assert!(drawings.len() >= 6, "{}", drawings.len());
    for (name, bytes) in drawings {
        let svg = std::str::from_utf8(bytes).unwrap();
        assert!(
            svg.contains("role=\"img\"") && svg.contains("<title") && svg.contains("<desc"),
            "{name}"
        );
        assert!(
            svg.contains("strain (%)") || svg.contains("(ps)") || svg.contains("(nm)"),
            "{name}"
        );
    }
    assert_eq!(figures.keys().filter(|name| name.ends_with(".png")).count(), 3);
}

#[test]
fn figures_of_cases_that_are_gone_go_too() {
    let folder = written(&three_meshes());
    let own = folder.path().join("figures/of-mine.svg");
    fs::write(&own, "drawn by hand").unwrap();
    let mut study = three_meshes();
    study.cases.truncate(1);
    report::write(&study, folder.path()).unwrap();
    assert!(own.exists());
    fs::remove_file(own).unwrap();
    let fresh = written(&study);
    assert!(files(folder.path()) == files(fresh.path()));
}
