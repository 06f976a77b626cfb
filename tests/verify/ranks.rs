//! Every number of ranks and threads, and every rule that a run may follow, to the same bytes.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use cgaft::analysis::series::Setting;
use cgaft::domain::Domain;
use cgaft::mesh::Mesh;
use cgaft::record::read_series;
use cgaft::study::case::Case;
use cgaft::{plan, setup, study};
use tempfile::tempdir;

/// Three sizes of triangles and atoms, a crack along a border between ranks, bonds to the second shell; the specimen comes to
/// rest first and then breaks.
const STUDY: &str = "
study: ranks
base:
  material:
    potential: {lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, cutoff: 0.57 nm, at-cutoff: shifted}}
    mass: 802 u
    thickness: 0.2087 nm
  specimen: {length: 22 nm, width: 13.5 nm, grips: sliding}
  crack: {edge: left, length: 8 nm}
  loading: {strain-rate: {mode: I, rate: 1e9 /s, ramp: initial-velocity}}
  resolution:
    element: 7
    regions:
      - band: {half-width: 1.5 nm, element: 1}
      - disc: {center: [14 nm, 3 nm], radius: 1.5 nm, element: 4}
  run: {until: {strain: 6 %}, relax: {strain: 0.4 %}}
  probes: {every: 0.4 ps}
  observe: [crack, stress-profile, average-stress, {snapshots: {every: 1 % strain}}]
cases:
  exact: {}
  economical: {run: {mass: {blend: 0.65}, summation: {gauss: 2}}}
  nearest: {material: {potential: {lennard-jones: {cutoff: 0.34 nm, at-cutoff: truncated}}}, resolution: {element: 10}}
";

/// What a computation is: its end state, its time series and its pictures.
const RESULTS: [&str; 3] = ["checkpoint.h5", "series.h5", "fields.vtkhdf"];

/// Runs so many ranks of the solver with MPI, and returns the folder.
fn solve(case: &Path, ranks: u32, threads: u32) -> PathBuf {
    let solver = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/mpi/cgaft-solve");
    assert!(
        solver.exists(),
        "{} is needed; type `make test-setup`",
        solver.display()
    );
    let into = case.with_extension(format!("{ranks}x{threads}"));
    let status = Command::new("timeout")
        .args(["--kill-after=5", "600", "mpirun", "-q", "-n", &ranks.to_string()])
        .arg(solver)
        .arg(case)
        .arg("--into")
        .arg(&into)
        .args(["--threads", &threads.to_string(), "--progress", "json"])
        .envs([
            ("OMPI_ALLOW_RUN_AS_ROOT", "1"),
            ("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"),
            ("OMPI_MCA_rmaps_base_oversubscribe", "1"),
            ("OMPI_MCA_hwloc_base_binding_policy", "none"),
            ("OMPI_MCA_mpi_yield_when_idle", "1"),
        ])
        .stdout(Stdio::null())
        .status()
        .unwrap();
    assert!(status.success(), "{ranks} ranks of {}: {status}", case.display());
    into
}

/// Among how many of so many ranks the bonds are shared that broke in a run.
fn ranks_with_broken_bonds(case: &Case, run: &Path, ranks: u32) -> usize {
    let slab = case.slab().unwrap();
    let plan = setup::slab::mesh_plan(slab, &case.run.until, &setup::slab::material(slab).unwrap());
    let mesh = Mesh::new(&plan.unwrap());
    let domain = Domain::parts(ranks as usize, &mesh, |_| 1.0).next().unwrap();
    let (_, series) = read_series::<Setting>(&run.join("series.h5")).unwrap();
    let bonds = series.bonds.iter().filter(|bond| bond.probe > 0 && bond.broken);
    let elements = bonds.filter_map(|bond| mesh.owner_of([bond.column, bond.row]));
    elements
        .map(|element| domain.owner(element))
        .collect::<BTreeSet<_>>()
        .len()
}

#[test]
fn every_number_of_ranks_and_threads_computes_the_same_bytes_by_every_rule() {
    let folder = tempdir().unwrap();
    let study = study::read_text("ranks.yaml", STUDY).unwrap();
    let plan = plan::plan(&study).unwrap_or_else(|error| panic!("{}", error.render(false)));
    for planned in &plan.cases {
        let case = folder.path().join(format!("{}.yaml", planned.name));
        fs::write(&case, plan::write_case(planned)).unwrap();
        let alone = solve(&case, 1, 1);
        for ranks in [2, 3, 4, 7] {
            let sharing = ranks_with_broken_bonds(&planned.case, &alone, ranks);
            assert!(
                sharing > 1,
                "{}: the crack stays within one rank of {ranks}",
                planned.name
            );
            for threads in [1, 2] {
                let together = solve(&case, ranks, threads);
                for name in RESULTS {
                    let [own, other] = [&together, &alone].map(|run| fs::read(run.join(name)).unwrap());
                    assert!(
                        own == other,
                        "{}: {name} of {ranks} ranks x {threads} threads",
                        planned.name
                    );
                }
            }
        }
    }
}
