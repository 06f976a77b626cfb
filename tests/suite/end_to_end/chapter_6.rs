//! The small studies of chapter 6 of the source: they run, tell of cracks and slip, are killed and go on, and run as jobs.

use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Command;

use super::ranks::ranks;
use super::{PATIENCE, Program, Workspace, assert_same_results, table, wait_for};

const FILM: &str = include_str!("../../../studies/film-3d-small.yaml");
const MIXED_MODE: &str = include_str!("../../../studies/mixed-mode-small.yaml");
const IMPACT: &str = include_str!("../../../studies/impact-small.yaml");
const CRACK_SURFACE: &str = include_str!("../../../studies/crack-surface-small.yaml");

/// A study in a folder, as the slab that these tests look for, with some of its text replaced.
fn place(study: &str, replaced: &[[&str; 2]]) -> Workspace {
    let name = study.lines().find_map(|line| line.strip_prefix("study: ")).unwrap();
    let mut text = study.replace(&format!("study: {name}"), "study: slab");
    for [from, to] in replaced {
        assert!(text.contains(from), "no `{from}` in {name}");
        text = text.replace(from, to);
    }
    Workspace::with(&text)
}

fn number(row: &BTreeMap<String, String>, name: &str) -> f64 {
    row[name].parse().unwrap_or(f64::NAN)
}

/// Of the work.
const ENERGY: f64 = 0.03;

/// The last row of the cracks and slip of a case, after its run.
fn at_end(place: &Workspace, case: &str) -> BTreeMap<String, String> {
    place.cgaft("run", &["--only", case]).succeeded();
    let summary = table(&place.results(), "summary");
    let row = summary.iter().find(|row| row["case"] == case).unwrap();
    assert!(number(row, "energy_error_relative") < ENERGY, "{row:?}");
    let surfaces = table(&place.results(), "surfaces");
    assert!(number(&surfaces[0], "crack_nm2") + number(&surfaces[0], "slip_nm2") == 0.0);
    for picture in ["solid", "aslant"] {
        assert!(place.results().join(format!("figures/{picture}-{case}.png")).exists());
    }
    surfaces.into_iter().rfind(|row| row["case"] == case).unwrap()
}

#[test]
fn the_small_film_slips_or_parts_before_four_percent_strain() {
    let end = at_end(&place(FILM, &[]), "elements");
    let parted = ["crack_nm2", "slip_nm2", "open_elsewhere_nm2"].map(|name| number(&end, name));
    assert!(parted.iter().sum::<f64>() > 0.0, "{end:?}");
}

#[test]
fn the_small_film_under_a_mixed_load_and_the_small_block_give_way_from_their_notch() {
    for study in [MIXED_MODE, CRACK_SURFACE] {
        let end = at_end(&place(study, &[]), "elements");
        assert!(number(&end, "crack_nm2") + number(&end, "slip_nm2") > 0.0, "{end:?}");
    }
}

#[test]
fn the_small_plate_opens_under_its_ball() {
    let place = place(IMPACT, &[["time: 60 ps", "time: 45 ps"]]);
    let end = at_end(&place, "coarse");
    assert!(number(&end, "crack_nm2") > 0.0, "{end:?}");
    assert!(!table(&place.results(), "directions").is_empty());
}

/// A shorter run with a checkpoint every few steps.
const HURRIED: [[&str; 2]; 2] = [
    [
        "until: {strain: 4 %}",
        "until: {strain: 2.4 %}, checkpoint-every: 20 ms",
    ],
    ["every: 0.5 % strain", "every: 0.4 % strain"],
];

#[test]
fn a_film_that_is_killed_goes_on_with_other_ranks_to_the_same_bytes() {
    let place = place(FILM, &HURRIED);
    place.cgaft("run", &["--only", "elements"]).succeeded();
    let run = place.case("elements");
    let case = place.path("case.yaml");
    fs::copy(run.join("case.yaml"), &case).unwrap();
    let into = place.path("killed");
    let mut job = Program::start(&mut place.solver(&case, &into, &[]), &place);
    wait_for("a checkpoint", || into.join("checkpoint.h5").exists());
    job.kill();
    let said = Program::start(&mut ranks(3, &case, &into, &[]), &place);
    said.wait(PATIENCE).succeeded();
    assert_same_results(&into, &run);
}

#[test]
fn a_film_runs_as_jobs_of_a_cluster_to_the_same_bytes() {
    let places = [(); 2].map(|()| place(FILM, &HURRIED));
    let [here, cluster] = &places;
    here.cgaft("run", &["--only", "elements"]).succeeded();
    let [bin, slurm] = ["bin", "slurm"].map(|name| cluster.path(name));
    for folder in [&bin, &slurm] {
        fs::create_dir(folder).unwrap();
    }
    let fake = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/suite/fake-slurm.sh");
    for name in ["sbatch", "squeue", "scancel", "scontrol", "sacct"] {
        symlink(&fake, bin.join(name)).unwrap();
    }
    let mut run: Command = cluster.command("run", &["--only", "elements", "--on", "slurm"]);
    run.env("PATH", format!("{}:{}", bin.display(), std::env::var("PATH").unwrap()));
    run.env("FAKE_SLURM", &slurm)
        .env("XDG_CONFIG_HOME", cluster.path("config"));
    Program::start(&mut run, cluster).wait(PATIENCE).succeeded();
    assert_same_results(&cluster.case("elements"), &here.case("elements"));
}
