//! Sweeps on the command line: which cases are meant, and what programs read of them.

use super::{STUDY, Said, Workspace, of_cases};

/// Six cases, `A-element-5` to `C-element-10`.
fn swept() -> Workspace {
    let place = Workspace::new();
    place.write_study(&format!("{STUDY}sweep:\n  resolution.element: [5, 10]\n"));
    place
}

fn planned(said: &Said) -> Vec<String> {
    of_cases(&said.json(), "case")
}

#[test]
fn only_takes_several_names_and_patterns_in_plan_and_run() {
    let place = swept();
    let plan = |only: &[&str]| {
        let arguments = [&["study", "plan", "slab.yaml", "--json"], only].concat();
        planned(&place.cgaft(&arguments).succeeded())
    };
    assert_eq!(
        plan(&["--only", "*-element-5"]),
        ["A-element-5", "B-element-5", "C-element-5"]
    );
    assert_eq!(
        plan(&["--only", "C-element-10,A-*"]),
        ["A-element-5", "A-element-10", "C-element-10"]
    );
    assert_eq!(
        plan(&["--only", "A-element-5", "--only", "B-element-?"]),
        ["A-element-5", "B-element-5"]
    );
    assert_eq!(plan(&[]).len(), 6);
    place
        .cgaft(&["study", "run", "slab.yaml", "--only", "B-*,C-element-5"])
        .succeeded();
    assert_eq!(place.starts().len(), 3);
}

#[test]
fn a_pattern_that_means_no_case_is_told_with_the_nearest_name() {
    let place = swept();
    for command in ["plan", "run"] {
        let refused = place
            .cgaft(&["study", command, "slab.yaml", "--only", "A-element-5,B-elemnt-*"])
            .ended_with(2);
        assert!(
            refused.stderr.contains("has no case `B-elemnt-*`"),
            "{}",
            refused.stderr
        );
        let refused = place
            .cgaft(&["study", command, "slab.yaml", "--only", "[A"])
            .ended_with(2);
        assert!(
            refused.stderr.contains("`[A` is no pattern of names"),
            "{}",
            refused.stderr
        );
    }
    assert!(!place.path("results").exists());
}

#[test]
fn programs_read_what_the_sweep_has_set_as_numbers() {
    let place = swept();
    for command in ["plan", "check", "status", "run"] {
        let json = place
            .cgaft(&["study", command, "slab.yaml", "--json"])
            .succeeded()
            .json();
        let values = json["cases"]
            .as_array()
            .unwrap()
            .iter()
            .map(|case| case["swept"]["resolution_element"].as_f64());
        assert_eq!(
            values.collect::<Vec<_>>(),
            [5.0, 10.0].repeat(3).into_iter().map(Some).collect::<Vec<_>>(),
            "{command}"
        );
    }
}

#[test]
fn each_case_is_told_as_one_of_how_many() {
    let place = swept();
    let run = place.cgaft(&["study", "run", "slab.yaml", "--jobs", "1"]).succeeded();
    for number in 1..=6 {
        assert!(
            run.stdout.contains(&format!("started (case {number} of 6)")),
            "{}",
            run.stdout
        );
    }
}
