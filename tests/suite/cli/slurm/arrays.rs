//! How cases are shared out between scripts: by what they need, and by how long an array may be.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;

use super::{Cluster, said};

#[test]
fn ranks_and_nodes_are_asked_for_and_each_job_starts_its_ranks_by_mpirun() {
    let narrow = "  D: {crack: {length: 60 nm}, run: {ranks: 1}}\n";
    let cluster = Cluster::with(&format!("{narrow}cluster: {{nodes: 2, ranks: 4, threads: 3}}\n"));
    let fake = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/suite/fake-mpirun.sh");
    symlink(fake, cluster.place.path("bin/mpirun")).unwrap();
    let plan = cluster.cgaft("plan", &["--on", "slurm"]).succeeded().stdout;
    for [nodes, tasks] in [["--nodes=1", "--ntasks=1"], ["--nodes=2", "--ntasks=4"]] {
        let asked = format!("#SBATCH {nodes}\n#SBATCH {tasks}\n#SBATCH --cpus-per-task=3\n");
        assert!(plan.contains(&asked), "no `{asked}` in {plan}");
    }
    said(&mut cluster.run()).succeeded();
    let starts = cluster.place.starts();
    let of_four = starts.iter().filter(|start| start.ends_with(" threads=3 ranks=4"));
    assert_eq!((of_four.count(), starts.len()), (3, 4), "{starts:?}");
    let manifest = fs::read_to_string(cluster.place.path("results/slab/cases/B/manifest.json")).unwrap();
    let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
    assert_eq!(manifest["ranks"], 4);
    assert_eq!(manifest["slurm_job"], "101_1", "{manifest}");
}

#[test]
fn a_solver_without_mpi_is_not_handed_over_with_ranks() {
    let cluster = Cluster::with("cluster: {ranks: 4}\n");
    let run = said(cluster.run().env("FAKE_FEATURES", "none"));
    assert_eq!(run.code, Some(3), "{}{}", run.stdout, run.stderr);
    assert!(run.stderr.contains("built without MPI"), "{}", run.stderr);
    assert!(cluster.asked("submissions").is_empty());
}

#[test]
fn cases_that_do_not_fit_into_one_array_go_into_several() {
    let cluster = Cluster::new();
    said(cluster.run().env("FAKE_MAX_ARRAY", "2")).succeeded();
    let array = |number: u32| fs::read_to_string(cluster.slurm().join(format!("{number}.sh"))).unwrap();
    assert!(array(100).contains("--array=0-1\n") && array(101).contains("--array=0-0\n"));
    assert_eq!(cluster.states(), ["done"; 3]);
}

#[test]
fn a_slurm_without_arrays_gets_one_job_a_case() {
    let cluster = Cluster::new();
    let run = said(cluster.run().env("FAKE_MAX_ARRAY", "0")).succeeded();
    assert_eq!(cluster.asked("submissions").len(), 3);
    assert!(run.stdout.contains("B: submitted as Slurm job 101\n"), "{}", run.stdout);
    assert!(
        !fs::read_to_string(cluster.slurm().join("101.sh"))
            .unwrap()
            .contains("--array")
    );
    let manifest = fs::read_to_string(cluster.place.path("results/slab/cases/C/manifest.json")).unwrap();
    assert!(manifest.contains(r#""slurm_job": "102""#), "{manifest}");
}
