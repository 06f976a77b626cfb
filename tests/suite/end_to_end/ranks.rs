//! Several ranks compute one case: the number of ranks is no part of a result, and no rank outlives another's failure.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::{PATIENCE, Program, Workspace, assert_same_results, send, wait_for};

/// Seconds after which a job of ranks is taken to hang.
const HANGS: &str = "100";

/// In which a job of ranks ends after one of them has, on a machine with other work.
const SECONDS_TO_END: Duration = Duration::from_secs(20);

/// The solver with MPI, which `cargo test` does not build.
pub fn solver_with_mpi() -> PathBuf {
    let built = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/mpi/cgaft-solve");
    let solver = std::env::var_os("CGAFT_TEST_MPI_SOLVER").map_or(built, PathBuf::from);
    assert!(
        solver.exists(),
        "{} is needed to test several ranks; type `make test-setup`",
        solver.display()
    );
    solver
}

/// `mpirun` with so many ranks of a program, more than there are cores if need be, as any user; not yet started.
fn mpirun(ranks: u32, program: &Path) -> Command {
    let mut command = Command::new("timeout");
    command.args(["--kill-after=5", HANGS, "mpirun", "-n", &ranks.to_string()]);
    command.arg(program);
    for (name, value) in [
        ("OMPI_ALLOW_RUN_AS_ROOT", "1"),
        ("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"),
        ("OMPI_MCA_rmaps_base_oversubscribe", "1"),
        ("OMPI_MCA_hwloc_base_binding_policy", "none"),
        ("OMPI_MCA_mpi_yield_when_idle", "1"),
    ] {
        command.env(name, value);
    }
    command
}

/// So many ranks of the solver for a case file.
pub fn ranks(count: u32, case: &Path, into: &Path, arguments: &[&str]) -> Command {
    let mut command = mpirun(count, &solver_with_mpi());
    command.arg(case).arg("--into").arg(into).args(arguments);
    command
}

/// A study computed by one process, and the case file of a mesh of triangles and atoms in it.
pub fn computed(place: &Workspace) -> (PathBuf, PathBuf) {
    place.cgaft("run", &["--only", "mixed"]).succeeded();
    let run = place.case("mixed");
    let case = place.path("case.yaml");
    fs::copy(run.join("case.yaml"), &case).unwrap();
    (run, case)
}

/// How often a specimen was cut anew.
fn cuts(run: &Path) -> u64 {
    let outcome = fs::read(run.join("outcome.json")).unwrap();
    let outcome: serde_json::Value = serde_json::from_slice(&outcome).unwrap();
    let mut phases = outcome["cost"].as_array().unwrap().iter();
    let cut = phases.find(|phase| phase["name"] == "cut").unwrap();
    cut["calls"].as_u64().unwrap()
}

#[test]
fn any_number_of_ranks_and_threads_writes_the_same_bytes_however_often_the_specimen_is_cut_anew() {
    let place = Workspace::new();
    let (run, case) = computed(&place);
    for (count, threads) in [(1, "2"), (2, "1"), (3, "2"), (7, "1")] {
        let into = place.path(&format!("{count} ranks"));
        let job = &mut ranks(count, &case, &into, &["--threads", threads]);
        Program::start(job, &place).wait(PATIENCE).succeeded();
        assert_same_results(&into, &run);
        // Among seven ranks of some elements each, those along the crack have much more to do.
        assert!(cuts(&into) > 1 || count < 7, "{count} ranks");
        assert!(cuts(&into) == 1 || count > 1, "{count} ranks");
    }
}

#[test]
fn a_checkpoint_of_some_ranks_goes_on_with_any_other_number_to_the_same_bytes() {
    let place = Workspace::restless();
    let (run, case) = computed(&place);
    let into = place.path("elastic");
    for count in [3, 2] {
        let mut job = ranks(count, &case, &into, &["--progress", "json", "--parent-pipe"]);
        let job = job.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut job = job.spawn().unwrap();
        let mut lines = BufReader::new(job.stdout.take().unwrap()).lines();
        lines.next().expect("it tells where it starts").unwrap();
        wait_for("a checkpoint", || into.join("checkpoint.h5").exists());
        // The ranks stop when their input ends.
        drop(job.stdin.take());
        lines.for_each(drop);
        let said = job.wait_with_output().unwrap();
        let errors = String::from_utf8_lossy(&said.stderr);
        assert_eq!(said.status.code(), Some(130), "{count} ranks: {errors}");
    }
    let said = Program::start(&mut ranks(4, &case, &into, &[]), &place)
        .wait(PATIENCE)
        .succeeded();
    assert!(said.stderr.contains("going on from step "), "{}", said.stderr);
    assert_same_results(&into, &run);
}

#[test]
fn a_rank_that_is_killed_ends_the_job_and_the_checkpoint_is_still_good() {
    let place = Workspace::restless();
    let (run, case) = computed(&place);
    let into = place.path("killed");
    let mut job = Program::start(&mut ranks(3, &case, &into, &[]), &place);
    wait_for("a checkpoint", || into.join("checkpoint.h5").exists());
    let solvers = descendants(job.child.id());
    let victim = *solvers.iter().max().expect("ranks are at work");
    let start = Instant::now();
    send("-KILL", victim);
    wait_for("the end of the job", || job.has_ended());
    assert!(start.elapsed() < SECONDS_TO_END, "{:?}", start.elapsed());
    assert!(!job.wait(PATIENCE).status.success());
    // mpirun does not wait for the ranks that it kills.
    wait_for("the end of all ranks", || {
        solvers.iter().all(|&solver| !is_at_work(solver))
    });
    Program::start(&mut ranks(2, &case, &into, &[]), &place)
        .wait(PATIENCE)
        .succeeded();
    assert_same_results(&into, &run);
}

#[test]
fn a_rank_that_fails_alone_ends_the_job_with_its_message_and_code() {
    let place = Workspace::new();
    let (_, case) = computed(&place);
    let script = place.path("one-fails.sh");
    let lines = "#!/bin/sh\nsolver=$1; case=$2; shift 2\n\
                 [ $OMPI_COMM_WORLD_RANK = 1 ] && case=absent.yaml\nexec \"$solver\" \"$case\" \"$@\"\n";
    fs::write(&script, lines).unwrap();
    let mut job = mpirun(3, Path::new("sh"));
    job.arg(&script).arg(solver_with_mpi()).arg(&case);
    job.arg("--into").arg(place.path("fails"));
    let start = Instant::now();
    let said = Program::start(&mut job, &place).wait(PATIENCE).ended_with(2);
    assert!(said.stderr.contains("absent.yaml"), "{}", said.stderr);
    assert!(start.elapsed() < SECONDS_TO_END);
}

#[test]
fn a_rank_that_panics_ends_the_job_with_its_message_and_code() {
    let place = Workspace::new();
    let program = solver_with_mpi().with_file_name("one_rank_panics");
    let start = Instant::now();
    let said = Program::start(&mut mpirun(3, &program), &place)
        .wait(PATIENCE)
        .ended_with(101);
    assert!(said.stderr.contains("rank 1 panics"), "{}", said.stderr);
    assert!(start.elapsed() < SECONDS_TO_END);
}

#[test]
fn physics_that_fails_on_any_rank_is_told_once_with_step_and_place() {
    let place = Workspace::new();
    let (_, case) = computed(&place);
    let text = fs::read_to_string(&case).unwrap();
    // Just below the limit of the crystal at rest, which the breaking one undercuts.
    let wild = text.replace("time-step: {fraction: 0.5}", "time-step: 108 fs");
    assert_ne!(text, wild, "{text}");
    fs::write(&case, wild).unwrap();
    let into = place.path("wild");
    let said = Program::start(&mut ranks(3, &case, &into, &[]), &place)
        .wait(PATIENCE)
        .ended_with(4);
    let told = said.stderr.matches("error: step ").count();
    assert!(told == 1 && said.stderr.contains("kept in"), "{}", said.stderr);
    assert!(into.join("series.h5").exists());
}

#[test]
fn a_solver_without_mpi_tells_why_several_of_it_cannot_work_together() {
    let place = Workspace::new();
    let mut job = mpirun(2, Path::new(env!("CARGO_BIN_EXE_cgaft-solve")));
    job.arg("case.yaml").arg("--into").arg(place.path("none"));
    let said = Program::start(&mut job, &place).wait(PATIENCE).ended_with(3);
    assert!(said.stderr.contains("built without MPI"), "{}", said.stderr);
}

#[test]
fn a_solver_under_the_mpirun_of_another_mpi_says_so() {
    let place = Workspace::new();
    let mut solve = Command::new(solver_with_mpi());
    solve.args(["case.yaml", "--into", "none"]).env("PMI_SIZE", "4");
    let said = Program::start(&mut solve, &place).wait(PATIENCE).ended_with(3);
    assert!(said.stderr.contains("another MPI"), "{}", said.stderr);
}

#[test]
fn only_the_solver_needs_the_mpi_library() {
    let names_mpi = |program: &Path| {
        let bytes = fs::read(program).unwrap();
        bytes.windows(9).any(|part| part == b"libmpi.so")
    };
    assert!(!names_mpi(Path::new(env!("CARGO_BIN_EXE_cgaft"))));
    assert!(names_mpi(&solver_with_mpi()));
}

/// The solvers below a process.
fn descendants(process: u32) -> Vec<u32> {
    let children = fs::read_to_string(format!("/proc/{process}/task/{process}/children")).unwrap_or_default();
    let children = children.split_whitespace().map(|number| number.parse::<u32>().unwrap());
    let each = children.flat_map(|child| {
        let name = fs::read_to_string(format!("/proc/{child}/comm")).unwrap_or_default();
        if name.trim() == "cgaft-solve" {
            vec![child]
        } else {
            descendants(child)
        }
    });
    each.collect()
}

fn is_at_work(process: u32) -> bool {
    let status = fs::read_to_string(format!("/proc/{process}/stat")).unwrap_or_default();
    // A process that nobody has asked about yet is a zombie.
    status.rsplit_once(") ").is_some_and(|(_, rest)| !rest.starts_with('Z'))
}
