//! Slabs under a pulse, from the study file to the report.

use std::fs;

use super::ranks::{computed, ranks};
use super::{PATIENCE, Program, Workspace, assert_same_results, files, table, wait_for};

const PULSE: &str = include_str!("../../studies/pulse.yaml");

/// Of the speed of long waves: a strip of 40 rows is slower by 0.14 %, and elements of ten slow a pulse of 118 spacings by a
/// quarter of a percent.
const SPEED: f64 = 0.005;

/// Of the work, in steps of half the limit.
const ENERGY: f64 = 1e-3;

fn workspace(changes: &[(&str, &str)]) -> Workspace {
    let mut text = PULSE.replace("study: pulse", "study: slab");
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    Workspace::with(&text)
}

#[test]
fn a_pulse_goes_from_gauge_to_gauge_at_the_speed_of_long_waves() {
    let place = workspace(&[]);
    place.cgaft("run", &[]).succeeded();
    let number = |cell: &str| cell.parse::<f64>().unwrap();
    for row in table(&place.results(), "summary") {
        assert!(number(&row["energy_error_relative"]) < ENERGY, "{row:?}");
        assert_eq!(number(&row["broken_bonds"]), 0.0);
    }
    let arrivals = table(&place.results(), "arrivals");
    assert_eq!(arrivals.len(), 6);
    for legs in arrivals.chunks(2) {
        assert_eq!(
            [&legs[0]["at_nm"], &legs[1]["at_nm"]].map(|at| number(at)),
            [40.0, 90.0]
        );
        assert_eq!(legs[0]["speed_m_per_s"], "");
        let off = number(&legs[1]["speed_m_per_s"]) / number(&legs[1]["speed_of_long_waves_m_per_s"]) - 1.0;
        assert!(off.abs() < SPEED, "{legs:?}");
        assert!((number(&legs[1]["difference_percent"]) - 100.0 * off).abs() < 1e-6);
    }
    let page = fs::read_to_string(place.results().join("report.html")).unwrap();
    assert!(page.contains("against long waves in the crystal") && page.contains("3 of 3 cases done."));
    assert!(!page.contains("{111}"), "what solids alone have is not told of a slab");
    for case in ["coarse", "mixed", "atoms"] {
        assert!(
            place
                .results()
                .join(format!("figures/gauges-velocity-{case}.svg"))
                .exists()
        );
        assert!(place.case(case).join("fields.vtkhdf").exists());
    }
}

#[test]
fn a_pulse_into_the_right_face_is_the_mirror_of_one_into_the_left() {
    // With an even number of rows of blocks the slab comes over itself by half a turn, left edge on right edge.
    let places = [workspace(&[]), workspace(&[("face: x-low", "face: x-high")])];
    let legs = places.map(|place| {
        place.cgaft("run", &["--only", "coarse"]).succeeded();
        let legs = table(&place.results(), "arrivals").into_iter();
        let speeds = legs.filter_map(|leg| leg["speed_m_per_s"].parse::<f64>().ok());
        speeds.collect::<Vec<f64>>()
    });
    let [low, high] = legs;
    assert_eq!([low.len(), high.len()], [1, 1]);
    assert!((low[0] / high[0] - 1.0).abs() < SPEED, "{low:?} {high:?}");
}

#[test]
fn a_slab_under_a_pulse_that_is_killed_goes_on_to_the_same_bytes() {
    let often = [("threads: 1", "threads: 1, checkpoint-every: 1 ms")];
    let [whole, parted] = [(); 2].map(|()| workspace(&often));
    whole.cgaft("run", &["--only", "mixed"]).succeeded();
    let mut program = Program::start(&mut parted.command("run", &["--only", "mixed"]), &parted);
    let is_there = || {
        files(&parted.results())
            .iter()
            .any(|path| path.ends_with("checkpoint.h5"))
    };
    wait_for("a checkpoint", is_there);
    program.kill();
    parted.cgaft("run", &["--only", "mixed"]).succeeded();
    assert_same_results(&parted.case("mixed"), &whole.case("mixed"));
}

#[test]
fn any_number_of_ranks_and_threads_computes_a_pulse_to_the_same_bytes() {
    let place = workspace(&[]);
    let (run, case) = computed(&place);
    for (count, threads) in [(1, "2"), (2, "1"), (3, "2")] {
        let into = place.path(&format!("{count} ranks"));
        let job = &mut ranks(count, &case, &into, &["--threads", threads]);
        Program::start(job, &place).wait(PATIENCE).succeeded();
        assert_same_results(&into, &run);
    }
}

#[test]
fn no_pulse_on_a_slab_is_written_for_lammps() {
    let place = workspace(&[]);
    let export = std::process::Command::new(env!("CARGO_BIN_EXE_cgaft"))
        .args(["export", "lammps", "slab.yaml", "--case", "atoms"])
        .current_dir(place.path(""))
        .output()
        .unwrap();
    assert_eq!(export.status.code(), Some(2));
    let said = String::from_utf8_lossy(&export.stderr);
    assert!(said.contains("a pulse on a slab is not written for LAMMPS"), "{said}");
}
