//! Reports of a made-up study of three meshes, and of studies in which things went wrong.

mod beside;
mod chapter;
mod columns;
mod figures;
#[cfg(feature = "parquet")]
mod parquet;
mod precision;
mod repeats;
mod scaling;
mod side_by_side;
mod specimen;
mod sweep;
mod units;
mod verdict;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use cgaft::analysis::series::Setting;
use cgaft::record::frames::Frame;
use cgaft::report::{self, CaseResult, Failure, Film, Manifest, Phase, Study};
use tempfile::TempDir;

use columns::COLUMNS;

use super::synthetic::{crack_run, setting, torn};

fn finished(name: &str, element: u32, nodes: u64, start: f64, wall: f64) -> CaseResult {
    let setting = Setting {
        element_at_crack: element,
        nodes,
        elements: nodes / 3,
        ..setting()
    };
    let series = crack_run(&setting, start, f64::from(element));
    let seconds = |name: &str, share: f64| Phase {
        name: name.to_owned(),
        calls: 8_000,
        seconds: wall * share,
    };
    let choices = [
        ("material.potential.lennard-jones.at-cutoff", "truncated"),
        ("resolution.element", if name == "atoms" { "1" } else { "10" }),
        (
            "resolution.regions",
            if name == "mixed" {
                "[{element: 1, band: {half-width: 5 nm}}]"
            } else {
                "[]"
            },
        ),
        ("specimen.grips", "clamped"),
        ("specimen.length", "102.2 nm"),
    ];
    CaseResult {
        name: name.to_owned(),
        id: format!("{name}-0123456789abcdef"),
        resolved: "material:\n  mass: 802 u\n".to_owned(),
        choices: choices.map(|(key, value)| (key.to_owned(), value.to_owned())).to_vec(),
        origin: name.to_owned(),
        swept: Vec::new(),
        repeat_of: None,
        specimen: None,
        film: Some(film(&setting, if name == "coarse" { 10 } else { 1 })),
        setting: Some(setting),
        series,
        solid: None,
        manifest: Manifest {
            state: "done".to_owned(),
            version: "0.1.0".to_owned(),
            commit: Some("0123abc".to_owned()),
            host: Some("bench".to_owned()),
            ranks: Some(1),
            threads: Some(2),
            started: Some("2026-01-02T03:04:05Z".to_owned()),
            ended: Some("2026-01-02T03:05:05Z".to_owned()),
            wall_seconds: Some(wall),
            core_seconds: Some(2.0 * wall),
            end_reason: Some("strain reached".to_owned()),
            time_step: Some(0.0351 * f64::from(element).sqrt()),
            stability_limit: Some(0.0439 * f64::from(element).sqrt()),
            steps: Some(8_000),
            energy_error: Some(1.3e-4),
            closest_approach: Some(0.91),
            peak_memory: Some(3.0e7),
            cost: vec![seconds("force", 0.8), seconds("move", 0.15), seconds("output", 0.05)],
            messages: None,
        },
        digest: None,
        failure: None,
    }
}

fn film(setting: &Setting, element: u32) -> Film {
    let (mesh, last) = torn(setting, element, 76.0, 0.028);
    let first = Frame {
        time: 0.5 * last.time,
        strain: 0.5 * last.strain,
        displacement: vec![[0.0; 2]; last.displacement.len()],
        ..last.clone()
    };
    Film::held(mesh, vec![first, last])
}

fn failed(log: &str) -> CaseResult {
    CaseResult {
        name: "broken".to_owned(),
        manifest: Manifest {
            state: "failed".to_owned(),
            ..Manifest::default()
        },
        failure: Some(Failure {
            reason: "the energy error passed 5 % at step 120".to_owned(),
            log_tail: log.to_owned(),
        }),
        ..CaseResult::default()
    }
}

fn three_meshes() -> Study {
    Study {
        name: "quickstart".to_owned(),
        title: Some("Three meshes, one crack".to_owned()),
        question: Some("How much does a crack notice that the far field is coarse?".to_owned()),
        text: "study: quickstart\nquestion: How much does a crack notice that the far field is coarse?\n".to_owned(),
        figure_width: None,
        stages: None,
        scaling: None,
        comparisons: Vec::new(),
        others: Vec::new(),
        side_by_side: Vec::new(),
        cases: vec![
            finished("coarse", 10, 3_300, 0.0242, 1.9),
            finished("mixed", 1, 11_800, 0.0182, 7.4),
            finished("atoms", 1, 60_000, 0.0180, 41.0),
        ],
    }
}

fn written(study: &Study) -> TempDir {
    let folder = TempDir::new().unwrap();
    report::write(study, folder.path()).unwrap();
    if let Ok(keep) = std::env::var("CGAFT_TEST_KEEP") {
        report::write(study, Path::new(&keep)).unwrap();
    }
    folder
}

fn text(folder: &TempDir, file: &str) -> String {
    fs::read_to_string(folder.path().join(file)).unwrap()
}

/// The rows of a table as column name to cell.
fn rows(folder: &TempDir, table: &str) -> Vec<BTreeMap<String, String>> {
    let csv = text(folder, &format!("tables/{table}.csv"));
    let mut lines = csv
        .lines()
        .map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let head = lines.next().unwrap();
    lines.map(|cells| head.iter().cloned().zip(cells).collect()).collect()
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        if entry.path().is_dir() {
            found.extend(
                files(&entry.path())
                    .into_iter()
                    .map(|(file, bytes)| (format!("{name}/{file}"), bytes)),
            );
        } else {
            found.insert(name, fs::read(entry.path()).unwrap());
        }
    }
    found
}

#[test]
fn tables_have_exactly_the_promised_columns() {
    let folder = written(&three_meshes());
    for (table, columns) in COLUMNS {
        let csv = text(&folder, &format!("tables/{table}.csv"));
        assert_eq!(csv.lines().next(), Some(columns), "{table}");
        // What was asked for is told by the study alone, which made cases do not have.
        assert!(csv.lines().count() > 1 || table == "specimen", "{table} is empty");
    }
}

#[test]
fn absent_values_are_empty_and_never_zero() {
    let folder = written(&Study {
        cases: vec![failed(""), finished("atoms", 1, 60_000, 0.9, 1.0)],
        ..Study::default()
    });
    let summary = rows(&folder, "summary");
    assert!(
        summary[0]
            .iter()
            .all(|(column, cell)| column == "case" || cell.is_empty()),
        "{:?}",
        summary[0]
    );
    for column in [
        "initiation_strain",
        "initiation_time_ps",
        "k_ic_near_tip_mpa_sqrt_m",
        "peak_speed_over_c_r",
    ] {
        assert_eq!(summary[1][column], "", "{column}");
    }
    assert!(
        rows(&folder, "crack_speed")
            .iter()
            .all(|row| row["speed_over_c_r"].is_empty())
    );
    assert!(rows(&folder, "stress_profile").is_empty() && rows(&folder, "branches").is_empty());
    assert!(
        rows(&folder, "wave_arrival")
            .iter()
            .all(|row| row["measured_ps"].is_empty())
    );
}

#[test]
fn temperatures_of_meshes_without_atoms_are_absent() {
    let folder = written(&Study {
        cases: vec![finished("coarse", 10, 3_300, 0.02, 1.0)],
        ..Study::default()
    });
    assert!(
        rows(&folder, "stress_strain")
            .iter()
            .all(|row| row["temperature_k"].is_empty())
    );
}

#[test]
fn the_summary_holds_what_was_put_in() {
    let folder = written(&three_meshes());
    let summary = rows(&folder, "summary");
    let number = |row: usize, column: &str| summary[row][column].parse::<f64>().unwrap();
    assert_eq!(summary[2]["nodes"], "60000");
    // The crack starts when it is told to; the lasting advance shows a few probes later.
    assert!((number(2, "initiation_strain") - 0.0180).abs() < 1e-3);
    assert!((number(2, "peak_speed_over_c_r") - 0.36).abs() < 0.02);
    assert!((number(2, "k_griffith_mpa_sqrt_m") - 1.005).abs() < 1e-3);
    assert!((number(2, "atom_steps_per_s") - 60_000.0 * 8_000.0 / 41.0).abs() < 1.0);
    assert!(number(2, "first_branch_strain") > number(2, "initiation_strain"));
    assert_eq!(summary[0]["first_branch_strain"], "");
}

#[test]
fn the_page_asks_nothing_of_the_network() {
    let page = text(&written(&three_meshes()), "report.html");
    for forbidden in [
        "http:",
        "https:",
        "\"//",
        "<script",
        "<link",
        "@import",
        "url(",
        "javascript:",
        "<iframe",
    ] {
        assert!(!page.contains(forbidden), "the page contains {forbidden}");
    }
    assert!(page.contains("default-src 'none'"));
    for address in page.split("src=\"").skip(1) {
        assert!(address.starts_with("data:image/png;base64,"));
    }
}

#[test]
fn identifiers_in_the_page_are_unique() {
    let page = text(&written(&three_meshes()), "report.html");
    let mut seen = std::collections::BTreeSet::new();
    for id in page.split(" id=\"").skip(1).filter_map(|rest| rest.split('"').next()) {
        assert!(seen.insert(id), "{id} is given twice");
    }
    assert!(seen.len() > 10);
}

#[test]
fn foreign_text_cannot_become_markup() {
    let evil = "</pre><script>alert(1)</script>\n```\n<img src=x onerror=y> & \"quoted\"";
    let mut study = three_meshes();
    study.cases.truncate(1);
    study.cases[0].name = "<b>bold</b>|x".to_owned();
    study.cases[0].resolved = evil.to_owned();
    study.cases[0].choices.push((evil.to_owned(), evil.to_owned()));
    study.cases.push(failed(evil));
    let study = Study {
        title: Some(evil.to_owned()),
        question: Some(evil.to_owned()),
        text: evil.to_owned(),
        ..study
    };
    let folder = written(&study);
    let page = text(&folder, "report.html");
    for forbidden in ["<script", "<b>bold", "<img src=x", "</pre><"] {
        assert!(!page.contains(forbidden), "the page contains {forbidden}");
    }
    let markdown = text(&folder, "report.md");
    let code = |line: &&str| !line.starts_with("    ");
    assert!(
        markdown
            .lines()
            .filter(code)
            .all(|line| !line.contains("<script") && !line.contains("```"))
    );
    for (name, bytes) in files(folder.path())
        .into_iter()
        .filter(|(name, _)| name.ends_with(".svg"))
    {
        assert!(!String::from_utf8(bytes).unwrap().contains("<b>"), "{name}");
    }
}

#[test]
fn equal_studies_give_equal_bytes() {
    let (one, two) = (written(&three_meshes()), written(&three_meshes()));
    let (one, two) = (files(one.path()), files(two.path()));
    assert!(one.len() > 15);
    assert!(one == two);
}

#[test]
fn the_report_names_what_failed_with_the_end_of_its_log() {
    let mut study = three_meshes();
    study.cases.push(failed("step 119\nstep 120: energy error 7 %"));
    let folder = written(&study);
    for file in ["report.html", "report.md"] {
        let page = text(&folder, file);
        assert!(page.contains("the energy error passed 5 % at step 120"), "{file}");
        assert!(page.contains("step 120: energy error 7 %"), "{file}");
        assert!(page.contains("3 of 4 cases done, 1 failed."), "{file}");
    }
}

#[test]
fn the_comparison_shows_only_the_choices_that_differ() {
    // Where a narrow column may break a name is no part of it.
    let page = text(&written(&three_meshes()), "report.html").replace("<wbr>", "");
    let table = page
        .split("class=\"side\"")
        .nth(1)
        .unwrap()
        .split("</table>")
        .next()
        .unwrap();
    assert!(table.contains("resolution.element") && table.contains("resolution.regions"));
    assert!(!table.contains("specimen.length"));
}

#[test]
fn a_study_without_any_result_still_has_a_report() {
    let folder = written(&Study {
        name: "nothing".to_owned(),
        cases: vec![failed("")],
        ..Study::default()
    });
    assert!(text(&folder, "report.html").contains("0 of 1 case done, 1 failed."));
    assert!(files(&folder.path().join("figures")).is_empty());
}
