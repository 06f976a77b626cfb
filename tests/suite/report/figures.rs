//! The files of the figures.

use std::fs;

use cgaft::report::{self, CaseResult, Study};

use super::{files, text, three_meshes, written};

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
    assert_eq!(
        figures.keys().filter(|name| name.ends_with(".png")).count(),
        6,
        "a slab and a path of each case"
    );
}

#[test]
fn figures_for_a_paper_have_its_width() {
    let study = Study {
        figure_width: Some(8.6e7),
        ..three_meshes()
    };
    let folder = written(&study);
    let svg = text(&folder, "figures/stress-strain.svg");
    assert!(
        svg.contains(" width=\"86.00mm\" height=\"57.33mm\" viewBox=\"0 0 1920 1280\""),
        "{}",
        &svg[..300]
    );
    assert!(
        text(&folder, "report.html").contains("<svg width=\"480\" height=\"320\""),
        "the page keeps its own"
    );
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

/// Thirty meshes of one specimen.
fn many() -> Study {
    let mut study = three_meshes();
    let template = study.cases[2].clone();
    let cases = vec![template; 30];
    let named = cases.into_iter().enumerate().map(|(index, case)| CaseResult {
        name: format!("a-case-with-a-long-name-{index}"),
        film: None,
        ..case
    });
    study.cases = named.collect();
    study
}

#[test]
fn many_cases_stand_one_below_the_other_and_their_legend_takes_nothing_from_the_curves() {
    let folder = written(&many());
    let page = text(&folder, "report.md");
    assert!(page.contains("| case | nodes | atoms represented |"), "{page}");
    assert!(page.contains("| a-case-with-a-long-name-29 | 60"), "{page}");
    let few = written(&three_meshes());
    let [few, many] = [few, folder].map(|folder| {
        let svg = text(&folder, "figures/stress-strain.svg");
        let height = svg.split("height=\"").nth(1).and_then(|rest| rest.split('"').next());
        height.unwrap().parse::<u32>().unwrap()
    });
    assert_eq!(few, 320);
    // Rows of 24 units, of which nine are as high as the plot; the last tells how many more there are.
    assert_eq!(many, 320 + 8 * 24);
}
