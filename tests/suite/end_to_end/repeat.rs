//! A study that is run again computes what is missing, and nothing else.

use std::fs;

use super::{STUDY, Workspace, table, written};

#[test]
fn a_second_run_starts_nothing_and_touches_nothing() {
    let place = Workspace::new();
    place.cgaft("run", &[]).succeeded();
    let before = written(&place.results());
    let again = place.cgaft("run", &[]).succeeded();
    for case in ["coarse", "mixed", "atoms"] {
        assert!(
            again.stdout.contains(&format!("{case}: done (unchanged)")),
            "{}",
            again.stdout
        );
        assert!(!again.started(case), "{}", again.stdout);
    }
    assert_eq!(written(&place.results()), before);

    // One case changed: its run is a new one, the old ones stay as they are.
    let runs = written(&place.results().join("runs"));
    place.write_study(&STUDY.replace("coarse: {", "coarse: {crack: {length: 9 nm}, "));
    let changed = place.cgaft("run", &[]).succeeded();
    let reason = "coarse: runs (changed: crack.length: 8 nm -> 9 nm)";
    assert!(changed.stdout.contains(reason), "{}", changed.stdout);
    assert_eq!(
        ["coarse", "mixed", "atoms"].map(|case| changed.started(case)),
        [true, false, false]
    );
    let after = written(&place.results().join("runs"));
    assert!(runs.iter().all(|(path, time)| after.get(path) == Some(time)));
    assert!(after.len() > runs.len());
}

#[test]
fn the_report_comes_from_the_store_alone() {
    let place = Workspace::new();
    place.cgaft("run", &["--only", "coarse", "--only", "mixed"]).succeeded();
    let results = place.results();
    let runs = written(&results.join("runs"));
    let report = || {
        let pages = [
            "report.html",
            "report.md",
            "tables/stress_strain.csv",
            "figures/stress-strain.svg",
        ];
        pages.map(|name| fs::read(results.join(name)).unwrap())
    };
    let first = report();
    let rows = table(&results, "stress_strain");
    assert!(rows.iter().any(|row| row["case"] == "coarse") && rows.iter().any(|row| row["case"] == "mixed"));

    for folder in ["tables", "figures"] {
        fs::remove_dir_all(results.join(folder)).unwrap();
    }
    for page in ["report.html", "report.md", ".report-of"] {
        fs::remove_file(results.join(page)).unwrap();
    }
    place.cgaft("report", &[]).succeeded();
    assert!(report() == first, "the report is another one");

    fs::remove_file(results.join("report.html")).unwrap();
    let again = place.cgaft("run", &["--only", "coarse", "--only", "mixed"]).succeeded();
    assert!(!again.started("coarse") && !again.started("mixed"), "{}", again.stdout);
    assert!(report() == first, "the report is another one");
    assert_eq!(written(&results.join("runs")), runs);
}
