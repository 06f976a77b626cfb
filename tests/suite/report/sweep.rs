//! The report of a sweep answers its question over the swept keys.

use cgaft::analysis::series::{Series, Setting};
use cgaft::plan::{Comparison, Expected, Swept, SweptValue};
use cgaft::report::{CaseResult, Study};

use super::super::synthetic::setting;
use super::{files, finished, rows, text, three_meshes, written};

const LENGTHS: [f64; 3] = [10.0, 20.0, 30.0];
const RATES: [f64; 3] = [4.6e7, 9.2e7, 1.8e8];

fn swept(path: &str, axis: usize, value: f64, unit: &'static str) -> Swept {
    Swept {
        path: path.to_owned(),
        axis,
        value: SweptValue::Number { value, unit },
    }
}

/// Nine cases: the longer the crack, the earlier it starts, and a little later when pulled faster.
fn nine() -> Study {
    let mut cases = Vec::new();
    for length in LENGTHS {
        for (step, rate) in (0..).zip(RATES) {
            let start = 0.026 - 0.0006 * length + 0.0004 * f64::from(step);
            let name = format!("slab-length-{length}nm-rate-{rate:e}-per-s");
            cases.push(CaseResult {
                origin: "slab".to_owned(),
                swept: vec![
                    swept("crack.length", 0, length, "nm"),
                    swept("loading.strain-rate.rate", 1, rate, "/s"),
                ],
                ..finished(&name, 1, 60_000, start, 41.0)
            });
        }
    }
    Study {
        cases,
        ..three_meshes()
    }
}

#[test]
fn every_table_has_a_column_for_each_swept_key_with_its_unit_in_the_name() {
    let folder = written(&nine());
    let mut seen = 0;
    for (name, bytes) in files(&folder.path().join("tables")) {
        let head = String::from_utf8(bytes).unwrap().lines().next().unwrap().to_owned();
        if head.starts_with("case,") {
            assert!(
                head.starts_with("case,crack_length_nm,loading_strain_rate_rate_per_s,"),
                "{name}: {head}"
            );
            seen += 1;
        }
    }
    assert!(seen >= 10, "{seen} tables of cases");
    let summary = rows(&folder, "summary");
    let columns = ["crack_length_nm", "loading_strain_rate_rate_per_s"];
    let numbers = columns.map(|column| summary[5][column].parse::<f64>().unwrap());
    assert_eq!(numbers, [20.0, 1.8e8]);
    let page = text(&folder, "report.md");
    assert!(
        page.contains("| case | crack.length (nm) | loading.strain-rate.rate (/s) | nodes |"),
        "{page}"
    );
    assert!(
        !page.contains("| crack.length |"),
        "the key stands there once, as a number"
    );
}

#[test]
fn each_headline_quantity_has_a_figure_over_the_first_key_with_a_series_for_the_second() {
    let folder = written(&nine());
    for id in ["start", "speed", "cost"] {
        let svg = text(&folder, &format!("figures/sweep-{id}.svg"));
        assert!(svg.contains("crack.length (nm)"), "{id}");
        for rate in ["4.6e7", "9.2e7", "1.8e8"] {
            let label = format!("rate {rate} /s");
            assert!(svg.contains(&label), "{id}: no `{label}`");
        }
    }
    let svg = text(&folder, "figures/sweep-start.svg");
    assert!(svg.contains("strain at the start of the crack (%)"));
    let page = text(&folder, "report.md");
    assert!(page.contains("Bars: one probe."), "{page}");
    assert!(
        files(&written(&three_meshes()).path().join("figures"))
            .keys()
            .all(|name| !name.starts_with("sweep-"))
    );
}

#[test]
fn colours_stand_for_the_first_key_and_dashes_for_the_second() {
    let folder = written(&nine());
    let svg = text(&folder, "figures/stress-strain.svg");
    for length in LENGTHS {
        assert!(svg.contains(&format!("length {length} nm\n")), "{length}");
    }
    let words = svg.split("<g aria-hidden").nth(1).unwrap();
    assert!(
        !words.contains("slab-length-10nm"),
        "the legend names keys, not nine cases"
    );
    let height: u32 = svg
        .split("height=\"")
        .nth(1)
        .unwrap()
        .split('"')
        .next()
        .unwrap()
        .parse()
        .unwrap();
    assert!(height < 700, "{height}");
}

#[test]
fn the_first_sentence_answers_with_the_results_and_how_sure_they_are() {
    let page = text(&written(&nine()), "report.md");
    let verdict = page.lines().find(|line| line.starts_with("**")).unwrap();
    let at = |words: &str| {
        verdict
            .find(words)
            .unwrap_or_else(|| panic!("no `{words}` in {verdict}"))
    };
    assert_eq!(
        at("**Strain at the start of the crack falls with crack.length: from 2."),
        0
    );
    assert!(
        verdict.contains(" ± 0.0") && verdict.contains("(±: one probe)"),
        "{verdict}"
    );
    assert!(at("to 0.8") < at("9 of 9 cases done"));
    assert!(at("9 of 9 cases done") < at("of a core in all"));
}

#[test]
fn a_quantity_that_goes_both_ways_is_not_said_to_go_one() {
    let mut study = nine();
    study.cases.retain(|case| case.swept[1].number() == Some(RATES[0]));
    study.cases[1] = CaseResult {
        origin: "slab".to_owned(),
        swept: study.cases[1].swept.clone(),
        ..finished("slab-between", 1, 60_000, 0.0230, 41.0)
    };
    let page = text(&written(&study), "report.md");
    assert!(page.contains(", and does not go one way with crack.length."), "{page}");
}

#[test]
fn reference_values_stand_in_the_figure() {
    let study = Study {
        comparisons: vec![Comparison {
            name: "handbook".to_owned(),
            file: "starts.csv".to_owned(),
            notes: String::new(),
            table: "summary",
            values: nine()
                .cases
                .iter()
                .map(|case| Expected {
                    case: case.name.clone(),
                    keys: Vec::new(),
                    column: "initiation_strain",
                    value: 0.015,
                })
                .collect(),
        }],
        ..nine()
    };
    let folder = written(&study);
    assert!(text(&folder, "figures/sweep-start.svg").contains("handbook: from 1.50 at 10.0"));
    assert!(!text(&folder, "figures/sweep-speed.svg").contains("handbook"));
}

#[test]
fn nine_slabs_are_a_grid_of_small_pictures_and_three_are_not() {
    assert!(text(&written(&nine()), "report.html").contains("class=\"slabs small\""));
    assert!(!text(&written(&three_meshes()), "report.html").contains("class=\"slabs small\""));
}

/// As after a run without a notch: nothing is followed, and nothing breaks.
fn uncracked() -> Study {
    let mut study = three_meshes();
    for case in &mut study.cases {
        let setting = Setting {
            crack_row: None,
            ..setting()
        };
        case.series = Series {
            bonds: Vec::new(),
            ..std::mem::take(&mut case.series)
        };
        case.setting = Some(setting);
    }
    study.title = None;
    study.question = None;
    study.text = "study: slab\n".to_owned();
    study
}

#[test]
fn a_study_without_a_crack_never_speaks_of_cracks() {
    let page = text(&written(&uncracked()), "report.md");
    // The names of tables and of the keys of a study are what they are.
    let said = page.replace("crack_speed", "").replace("crack\\_speed", "");
    let lines: Vec<&str> = said
        .lines()
        .filter(|line| !line.starts_with("- ["))
        .filter(|line| {
            ["crack", "broken", "tip", "branch"]
                .iter()
                .any(|word| line.contains(word))
        })
        .collect();
    assert!(lines.is_empty(), "{lines:#?}");
    assert!(page.contains("the mean stress reaches"), "{page}");
}
