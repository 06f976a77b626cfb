//! What the program says, and with which exit code.

use std::fs;
use std::io::Read;
use std::process::Stdio;

use super::{STUDY, Workspace, of_cases, said};

#[test]
fn a_bad_study_is_refused_and_nothing_is_started() {
    let place = Workspace::new();
    place.write_study(&STUDY.replace("width: 35.4 nm", "widht: 35.4"));
    for command in ["run", "check", "plan", "status", "report", "clean"] {
        let refused = place.cgaft(&["study", command, "slab.yaml"]);
        assert_eq!(refused.code, Some(2), "{command}");
        assert!(
            refused.stderr.contains("widht") && refused.stderr.contains("width"),
            "{}",
            refused.stderr
        );
    }
    let json = place.cgaft(&["study", "run", "slab.yaml", "--json"]).json();
    assert_eq!(json["error"]["exit_code"], 2);
    assert!(json["error"]["mistakes"][0]["line"].is_u64(), "{json}");
    assert!(!place.path("results").exists());
}

#[test]
fn all_refusals_of_mesh_and_material_are_told_at_once_with_their_places() {
    let place = Workspace::new();
    place.write_study(&STUDY.replace(
        "  A: {}\n",
        "  A: {loading: {strain-rate: {rate: 9.81e11 /s}}}\n  D: {resolution: {element: 1}, specimen: {length: 20 mm}}\n",
    ));
    for command in ["run", "check", "plan"] {
        let refused = place.cgaft(&["study", command, "slab.yaml"]);
        assert_eq!(refused.code, Some(2), "{command}");
        for told in [
            "faster than sound",
            "slab.yaml:17:",
            "GB free",
            "slab.yaml:18:",
            "2 mistakes",
        ] {
            assert!(refused.stderr.contains(told), "no `{told}` in {}", refused.stderr);
        }
    }
    let json = place.cgaft(&["study", "check", "slab.yaml", "--json"]).json();
    let mistakes = json["error"]["mistakes"].as_array().unwrap();
    let lines: Vec<_> = mistakes.iter().map(|mistake| mistake["line"].as_u64()).collect();
    assert_eq!(lines, [Some(17), Some(18)]);
    assert!(!place.path("results").exists());
    let export = place.cgaft(&["export", "lammps", "slab.yaml", "--case", "D"]);
    assert_eq!(export.code, Some(2));
    assert!(export.stderr.contains("slab.yaml:18:"), "{}", export.stderr);
}

#[test]
fn results_that_this_version_cannot_read_are_an_error_of_the_input() {
    let place = Workspace::new();
    place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    let mark = place.path("results/slab/store.json");
    let current = fs::read(&mark).unwrap();
    for (text, format) in [
        (r#"{"format": 0}"#, "format 0"),
        (r#"{"format": 99}"#, "format 99"),
        ("", "format unknown"),
    ] {
        fs::write(&mark, text).unwrap();
        for command in ["run", "status", "report", "clean"] {
            let refused = place.cgaft(&["study", command, "slab.yaml"]);
            assert_eq!(refused.code, Some(2), "{}", refused.stderr);
            for told in [format, "use the version that wrote them", "--results DIR"] {
                assert!(refused.stderr.contains(told), "no `{told}` in {}", refused.stderr);
            }
        }
    }
    fs::write(&mark, current).unwrap();
    let again = place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    assert_eq!(
        again.stdout.matches(": done (unchanged)").count(),
        3,
        "nothing was lost"
    );
}

#[test]
fn what_a_study_compares_with_is_read_from_its_own_folder_and_makes_a_new_report() {
    let place = Workspace::new();
    fs::create_dir_all(place.path("studies/reference")).unwrap();
    fs::write(
        place.path("studies/slab.yaml"),
        format!("{STUDY}compare: {{start: reference/start.csv}}\n"),
    )
    .unwrap();
    let refused = place.cgaft(&["study", "run", "studies/slab.yaml"]);
    assert_eq!(refused.code, Some(2));
    for told in ["reference/start.csv cannot be read", "studies/slab.yaml:20:"] {
        assert!(refused.stderr.contains(told), "no `{told}` in {}", refused.stderr);
    }
    assert!(!place.path("results").exists());

    let table = place.path("studies/reference/start.csv");
    let shown = || {
        place.cgaft(&["study", "run", "studies/slab.yaml"]).succeeded();
        fs::read_to_string(place.path("results/slab/tables/comparison.csv")).unwrap()
    };
    for value in ["0.0321", "0.0456"] {
        fs::write(
            &table,
            format!("# measured by hand\ncase,initiation_strain\nB,{value}\n"),
        )
        .unwrap();
        let shown = shown();
        assert!(
            shown.contains(&format!("B,initiation_strain,,,{value},,reference/start.csv")),
            "{shown}"
        );
    }
    assert_eq!(place.starts().len(), 3, "a reference is no part of a case");
}

#[test]
fn an_unknown_case_is_refused_with_the_nearest_name() {
    let place = Workspace::new();
    place.write_study(&STUDY.replace("  B:", "  branching:"));
    let refused = place.cgaft(&["study", "run", "slab.yaml", "--only", "brnching"]);
    assert_eq!(refused.code, Some(2));
    assert!(
        refused.stderr.contains("Did you mean `branching`?"),
        "{}",
        refused.stderr
    );
}

#[test]
fn who_leaves_out_the_word_study_is_told() {
    let place = Workspace::new();
    let refused = place.cgaft(&["run", "slab.yaml"]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("'study run'"), "{}", refused.stderr);
}

#[test]
fn what_is_missing_on_the_machine_has_its_own_exit_code() {
    let place = Workspace::new();
    let lost = said(
        place
            .command(&["study", "run", "slab.yaml"])
            .env("CGAFT_SOLVE", "nowhere"),
    );
    assert_eq!(lost.code, Some(3));
    assert!(lost.stderr.contains("make install"), "{}", lost.stderr);
    assert!(!place.path("results").exists(), "nothing was started");
}

#[test]
fn an_output_that_cannot_be_written_has_its_own_exit_code() {
    let place = Workspace::new();
    fs::write(place.path("results"), "in the way").unwrap();
    let refused = place.cgaft(&["study", "run", "slab.yaml"]);
    assert_eq!(refused.code, Some(5));
    assert!(refused.stderr.contains("--results DIR"), "{}", refused.stderr);
    let elsewhere = place
        .cgaft(&["study", "run", "slab.yaml", "--results", "elsewhere", "--only", "A"])
        .succeeded();
    assert!(
        elsewhere.stdout.contains("elsewhere/slab/report.html"),
        "{}",
        elsewhere.stdout
    );
}

#[test]
fn json_is_on_standard_output_and_words_are_not() {
    let place = Workspace::new();
    let run = place.cgaft(&["study", "run", "slab.yaml", "--json"]).succeeded();
    let json = run.json();
    assert_eq!(of_cases(&json, "case"), ["A", "B", "C"]);
    assert_eq!(of_cases(&json, "state"), ["done"; 3]);
    assert_eq!(of_cases(&json, "reason"), ["new"; 3]);
    assert_eq!(json["report"], "results/slab/report.html");
    assert!(run.stderr.contains("A: runs (new)"), "{}", run.stderr);
}

#[test]
fn quiet_says_nothing_but_failures() {
    let place = Workspace::new();
    let run = said(
        place
            .command(&["study", "run", "slab.yaml", "--quiet"])
            .env("FAKE_FAIL", "study: B"),
    );
    assert_eq!((run.code, run.stdout.as_str()), (Some(1), ""));
    assert!(run.stderr.starts_with("B: failed:"), "{}", run.stderr);
    let run = place.cgaft(&["study", "run", "slab.yaml", "--quiet"]).succeeded();
    assert_eq!((run.stdout.as_str(), run.stderr.as_str()), ("", ""));
}

#[test]
fn there_are_no_colours_and_bars_where_there_is_no_terminal() {
    let place = Workspace::new();
    place.write_study(&STUDY.replace("802 u", "802"));
    let refused = place.cgaft(&["study", "run", "slab.yaml"]);
    place.write_study(STUDY);
    let run = place.cgaft(&["study", "run", "slab.yaml"]).succeeded();
    for text in [refused.stderr, refused.stdout, run.stderr, run.stdout] {
        assert!(!text.contains('\u{1b}') && !text.contains('\r'), "{text:?}");
    }
}

#[test]
fn check_tells_size_and_cost_and_computes_nothing() {
    let place = Workspace::new();
    let check = place.cgaft(&["study", "check", "slab.yaml"]).succeeded();
    for column in [
        "nodes",
        "elements",
        "atoms",
        "steps",
        "time step",
        "memory",
        "disk",
        "left over: share",
    ] {
        assert!(check.stdout.contains(column), "{}", check.stdout);
    }
    let json = place
        .cgaft(&["study", "check", "slab.yaml", "--json"])
        .succeeded()
        .json();
    assert_eq!(json["cases"].as_array().unwrap().len(), 3);
    assert!(json["cases"][0]["nodes"].as_u64().unwrap() > 0);
    assert!(!place.path("results").exists());
}

#[test]
fn plan_shows_the_exact_command_of_each_case() {
    let place = Workspace::new();
    let plan = place.cgaft(&["study", "plan", "slab.yaml"]).succeeded();
    assert_eq!(
        plan.stdout.matches("fake-solver.sh results/slab/runs/").count(),
        3,
        "{}",
        plan.stdout
    );
    assert!(plan.stdout.contains("A: run (new)"), "{}", plan.stdout);
    assert!(!place.path("results").exists());
}

#[test]
fn a_reader_that_leaves_early_is_no_panic() {
    let place = Workspace::new();
    let mut child = place.command(&["schema"]).spawn().unwrap();
    drop(child.stdout.take());
    let mut errors = String::new();
    child.stderr.take().unwrap().read_to_string(&mut errors).unwrap();
    assert_eq!((child.wait().unwrap().code(), errors.as_str()), (Some(0), ""));
    let full = fs::File::options().write(true).open("/dev/full").unwrap();
    let status = place
        .command(&["schema"])
        .stdout(full)
        .stderr(Stdio::null())
        .status()
        .unwrap();
    assert_eq!(status.code(), Some(5), "a full disk is an error");
}

#[test]
fn the_small_commands_answer() {
    let place = Workspace::new();
    let schema = place.cgaft(&["schema"]).succeeded().json();
    assert!(schema["$schema"].as_str().unwrap().contains("draft-07"));
    assert!(
        place
            .cgaft(&["completions", "bash"])
            .succeeded()
            .stdout
            .contains("_cgaft")
    );
    let doctor = place.cgaft(&["doctor"]).succeeded();
    for line in ["cgaft-solve", "cores", "memory", "HDF5", "MPI", "Slurm", "python"] {
        assert!(doctor.stdout.contains(line), "{}", doctor.stdout);
    }
    assert_eq!(place.cgaft(&["study", "rnu", "slab.yaml"]).code, Some(2));
}

#[test]
fn a_mistyped_name_of_a_study_is_answered_with_the_nearest() {
    let place = Workspace::new();
    for (typed, meant) in [("slap.yaml", "`slab.yaml`"), ("quikstart.yaml", "`quickstart.yaml`")] {
        let refused = place.cgaft(&["study", "check", typed]);
        assert_eq!(refused.code, Some(2));
        assert!(
            refused.stderr.contains(&format!("did you mean {meant}?")),
            "{}",
            refused.stderr
        );
    }
}

#[test]
fn check_warns_of_a_time_step_near_the_limit() {
    let place = Workspace::new();
    let check = |time_step: &str| {
        place.write_study(&STUDY.replace("run: {", &format!("run: {{time-step: {{fraction: {time_step}}}, ")));
        place.cgaft(&["study", "check", "slab.yaml"]).succeeded().stdout
    };
    let risky = check("0.99");
    assert!(
        risky.contains("warning: A, B, C: the time step is 99 % of the limit"),
        "{risky}"
    );
    assert!(!check("0.8").contains("warning"));
}

#[test]
fn check_warns_of_rules_that_look_at_some_bonds_only() {
    let place = Workspace::new();
    let check = |summation: &str| {
        place.write_study(&STUDY.replace("run: {", &format!("run: {{summation: {summation}, ")));
        place.cgaft(&["study", "check", "slab.yaml"]).succeeded().stdout
    };
    let nodal = check("nodal");
    assert!(
        nodal.contains("warning: A, B, C: `summation: nodal` fails the patch test: uncracked it is 43 % too soft"),
        "{nodal}"
    );
    let gauss = check("{gauss: 2}");
    assert!(
        gauss.contains("warning: A, B, C: `summation: {gauss: 2}` looks at some bonds"),
        "{gauss}"
    );
    for silent in ["exact", "{gauss: {points: 2, strict: true}}"] {
        assert!(!check(silent).contains("warning"), "{silent}");
    }
}

#[test]
fn check_warns_of_regions_that_change_nothing_or_all_and_of_an_unlikely_thickness() {
    let place = Workspace::new();
    let check = |old: &str, new: &str| {
        assert!(STUDY.contains(old), "{old}");
        place.write_study(&STUDY.replace(old, new));
        place.cgaft(&["study", "check", "slab.yaml"]).succeeded().stdout
    };
    let band =
        |half_width: &str| format!("{{element: 10, regions: [{{band: {{half-width: {half_width}, element: 1}}}}]}}");
    let wide = check("resolution: {element: 10}", &format!("resolution: {}", band("1 mm")));
    assert!(
        wide.contains("no element of 10 atoms per edge is left beside the regions, which take the whole specimen"),
        "{wide}"
    );
    let thin = check("resolution: {element: 10}", &format!("resolution: {}", band("1e-5 nm")));
    assert!(
        thin.contains("no single atom has room in the region that asks for it"),
        "{thin}"
    );
    let thick = check("thickness: 0.2087 nm", "thickness: 1e30 nm");
    assert!(
        thick.contains("a thickness of 1e30 nm is 3.9e30 times the distance of the atoms"),
        "{thick}"
    );
}

#[test]
fn doctor_speaks_to_programs_too() {
    let json = Workspace::new().cgaft(&["doctor", "--json"]).succeeded().json();
    assert_eq!(json["ok"], true);
    let whats: Vec<_> = json["findings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|finding| &finding["what"])
        .collect();
    assert!(whats.contains(&&"MPI".into()), "{json}");
    assert_eq!(json["findings"][0]["state"], "ok");
}
