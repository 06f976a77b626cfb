//! Cases of two ranks, started by a real mpirun inside jobs of a real Slurm.

use std::fs;
use std::path::Path;
use std::process::Command;

use super::{Place, STUDY, Slurm, assert_same_results};
use crate::verify::mpi_solver::solver_with_mpi;

const CLUSTER: &str = "cluster: {nodes: 1, ranks: 2, threads: 1}\n";

/// The solver itself, or where it was built without MPI, what stands in for it and tells of its ranks.
pub fn a_job_starts_its_ranks_by_mpirun(slurm: &Slurm) {
    if !has("mpirun") {
        return;
    }
    let place = Place::new(slurm, &format!("{STUDY}{CLUSTER}"));
    let mut run = place.command("run", &["--on", "slurm"]);
    let with_mpi = solver_with_mpi();
    let speaks_mpi = with_mpi.is_some();
    let fake = || Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/suite/fake-solver.sh");
    run.env("CGAFT_SOLVE", with_mpi.clone().unwrap_or_else(fake));
    let output = run.output().unwrap();
    let said = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
    assert!(output.status.success() || !speaks_mpi, "{said}\n{}", place.outputs());
    for case in ["coarse", "mixed", "atoms"] {
        let manifest = fs::read_to_string(place.run_of(case).join("manifest.json")).unwrap();
        let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
        assert_eq!(manifest["ranks"], 2);
        assert!(
            manifest["slurm_job"].as_str().is_some_and(|job| job.contains('_')),
            "{manifest}"
        );
        let log = fs::read_to_string(place.run_of(case).join("log.txt")).unwrap();
        assert!(
            log.contains("--block-signal=TERM") && log.contains("mpirun -n 2 --bind-to none"),
            "{log}"
        );
    }
    if let Some(solver) = with_mpi {
        let alone = Place::new(slurm, STUDY);
        let mut run = alone.command("run", &[]);
        assert!(run.env("CGAFT_SOLVE", &solver).output().unwrap().status.success());
        for case in ["coarse", "mixed", "atoms"] {
            assert_same_results(&place.run_of(case), &alone.run_of(case));
        }
        a_cancelled_job_writes_the_checkpoint_of_all_its_ranks(slurm, &solver);
    } else {
        let starts = fs::read_to_string(place.folder.path().join("results/slab/starts.txt")).unwrap();
        assert!(
            starts.lines().count() == 3 && starts.lines().all(|start| start.ends_with(" ranks=2")),
            "{starts}"
        );
    }
}

/// Slurm tells every process of a job to end, `mpirun` too.
fn a_cancelled_job_writes_the_checkpoint_of_all_its_ranks(slurm: &Slurm, solver: &Path) {
    let study = STUDY.replace("1e9 /s", "1e7 /s");
    let place = Place::new(slurm, &format!("{study}{CLUSTER}"));
    let mut run = place.command("run", &["--on", "slurm", "--detach", "--only", "atoms"]);
    assert!(run.env("CGAFT_SOLVE", solver).output().unwrap().status.success());
    place.wait_for(" at step ");
    place.cgaft("cancel", &[], 0);
    // Its checkpoints are an hour apart: there is none but that of the request to stop.
    place.wait_for("goes on from its last checkpoint");
}

fn has(program: &str) -> bool {
    Command::new(program)
        .arg("--version")
        .output()
        .is_ok_and(|output| output.status.success())
}
