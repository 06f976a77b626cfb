//! What ranks gain, from the study to the report.

use std::fs;

use serde_json::Value;

use super::ranks::solver_with_mpi;
use super::{Program, STUDY, Said, Workspace, assert_same_results, table};

/// The small slab with one and two ranks.
fn workspace() -> Workspace {
    let (head, _) = STUDY.split_once("cases:").unwrap();
    let head = head
        .replace("run: {", "run: {threads: 1, ")
        .replace("  crack:", "  resolution: {element: 10}\n  crack:");
    Workspace::with(&format!(
        "{head}report: {{scaling: fixed}}\nsweep:\n  run.ranks: [1, 2]\n"
    ))
}

fn cgaft(place: &Workspace, arguments: &[&str]) -> Said {
    let mut run = place.command("run", arguments);
    run.env("CGAFT_SOLVE", solver_with_mpi());
    Program::start(&mut run, place).wait(super::PATIENCE)
}

#[test]
fn every_number_of_ranks_is_a_run_of_its_own_with_the_same_bits_and_a_row_of_the_report() {
    let place = workspace();
    let said = cgaft(&place, &[]).succeeded();
    assert!(said.stdout.contains("1 at once"), "{}", said.stdout);
    let [one, two] = ["ranks-1", "ranks-2"].map(|case| place.case(case));
    assert_same_results(&two, &one);
    let name = |run: &std::path::Path| run.file_name().unwrap().to_str().unwrap().to_owned();
    assert_eq!(
        name(&one).trim_end_matches("-r1-t1"),
        name(&two).trim_end_matches("-r2-t1")
    );
    let manifest = |run: &std::path::Path| -> Value {
        serde_json::from_str(&fs::read_to_string(run.join("manifest.json")).unwrap()).unwrap()
    };
    let messages = &manifest(&two)["outcome"]["messages"];
    assert!(messages["latency_s"].as_f64().unwrap() > 0.0 && messages["reduction_s"].as_f64().unwrap() > 0.0);
    assert!(manifest(&one)["outcome"]["messages"].is_null());

    let rows = table(&place.results(), "scaling");
    let measured: Vec<&str> = rows
        .iter()
        .filter(|row| row["of"] == "measured")
        .map(|row| row["ranks"].as_str())
        .collect();
    assert_eq!(measured, ["1", "2"]);
    assert_eq!(rows.last().unwrap()["ranks"], "512");
    let page = fs::read_to_string(place.results().join("report.html")).unwrap();
    assert!(page.contains("are the same in every byte"));

    let again = cgaft(&place, &[]).succeeded();
    assert!(
        !again.started("ranks-1") && !again.started("ranks-2"),
        "{}",
        again.stdout
    );
    let refused = cgaft(&place, &["--ranks", "2"]).ended_with(2);
    assert!(refused.stderr.contains("leave out `--ranks`"), "{}", refused.stderr);
}
