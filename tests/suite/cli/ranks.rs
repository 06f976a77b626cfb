//! Cases of several processes, with a script in the place of mpirun.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Command;

use super::interrupt::{checkpoints, signal, wait_for};
use super::{STUDY, Said, Workspace, finished, said};

/// A study whose cases ask for ranks, in a folder with an mpirun of its own.
struct Ranks {
    place: Workspace,
}

impl Ranks {
    fn new() -> Ranks {
        let place = Workspace::new();
        place.write_study(&STUDY.replace("run: {", "run: {ranks: 3, "));
        fs::create_dir(place.path("bin")).unwrap();
        let fake = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/suite/fake-mpirun.sh");
        symlink(fake, place.path("bin/mpirun")).unwrap();
        Ranks { place }
    }

    /// `cgaft study COMMAND slab.yaml …` where this mpirun is on the PATH, not yet started.
    fn command(&self, command: &str, arguments: &[&str]) -> Command {
        let mut cgaft = self
            .place
            .command(&[&["study", command, "slab.yaml"], arguments].concat());
        let path = std::env::var("PATH").unwrap();
        cgaft.env("PATH", format!("{}:{path}", self.place.path("bin").display()));
        cgaft
    }

    fn cgaft(&self, command: &str, arguments: &[&str]) -> Said {
        said(&mut self.command(command, arguments))
    }

    fn manifest(&self, case: &str) -> serde_json::Value {
        let path = self.place.path("results/slab/cases").join(case).join("manifest.json");
        serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
    }
}

#[test]
fn ranks_are_those_of_the_study_or_of_the_command_and_no_part_of_the_case() {
    let ranks = Ranks::new();
    ranks.cgaft("run", &["--only", "A", "--threads", "2"]).succeeded();
    ranks.cgaft("run", &["--only", "B", "--ranks", "2"]).succeeded();
    ranks.cgaft("run", &["--only", "C", "--ranks", "1"]).succeeded();
    let starts = ranks.place.starts();
    assert!(starts[0].ends_with(" threads=2 ranks=3"), "{starts:?}");
    assert!(starts[1].ends_with(" ranks=2"), "{starts:?}");
    assert!(!starts[2].contains("ranks"), "one process needs no mpirun: {starts:?}");
    assert_eq!(ranks.manifest("A")["ranks"], 3);
    assert_eq!(ranks.manifest("A")["threads"], 2);

    ranks.cgaft("run", &["--ranks", "7"]).succeeded();
    assert_eq!(
        ranks.place.starts().len(),
        3,
        "what is done is done with any number of ranks"
    );
}

#[test]
fn a_sweep_over_ranks_computes_each_number_for_itself_and_is_not_overruled() {
    let ranks = Ranks::new();
    ranks
        .place
        .write_study(&(STUDY.to_owned() + "sweep:\n  run.ranks: [1, 3]\n"));
    for command in ["plan", "run"] {
        let refused = ranks.cgaft(command, &["--ranks", "2"]);
        assert_eq!(refused.code, Some(2), "{}", refused.stdout);
        assert!(refused.stderr.contains("leave out `--ranks`"), "{}", refused.stderr);
    }
    let run = ranks.cgaft("run", &["--threads", "1"]).succeeded();
    assert!(run.stdout.contains("6 cases to run, 1 at once"), "{}", run.stdout);
    let starts = ranks.place.starts();
    assert_eq!(starts.len(), 6);
    let [alone, shared]: [Vec<&str>; 2] = ["-r1.partial ", "-r3.partial "].map(|end| {
        starts
            .iter()
            .filter_map(|start| Some(start.split_once(end)?.0))
            .collect()
    });
    assert_eq!((alone.len(), shared.len()), (3, 3), "{starts:?}");
    assert!(
        shared.iter().all(|id| alone.contains(id)),
        "these are runs of the same cases"
    );
    assert_eq!(ranks.manifest("B-ranks-3")["ranks"], 3);
    let again = ranks.cgaft("run", &[]).succeeded();
    assert_eq!(again.stdout.matches("done (unchanged)").count(), 6, "{}", again.stdout);
}

#[test]
fn more_ranks_than_cores_are_told_and_started() {
    let ranks = Ranks::new();
    let run = ranks
        .cgaft("run", &["--only", "A", "--ranks", "500", "--dry-run"])
        .succeeded();
    let told = "1 case to run, 1 at once with 500 ranks of 1 thread each: 500 in all on ";
    assert!(run.stdout.contains(told), "{}", run.stdout);
    let run = ranks.cgaft("run", &["--only", "A", "--ranks", "40"]).succeeded();
    assert!(run.stdout.contains("40 in all on "), "{}", run.stdout);
    assert!(ranks.place.starts()[0].ends_with(" ranks=40"));
}

#[test]
fn plan_and_check_warn_of_ranks_that_the_solver_cannot_start() {
    let ranks = Ranks::new();
    let without = "was built without MPI, so that it computes with threads but not with 3 ranks: `make build`";
    for (command, arguments) in [("plan", &[][..]), ("check", &[]), ("plan", &["--on", "slurm"])] {
        let mut blind = ranks.command(command, arguments);
        let told = said(blind.env("FAKE_FEATURES", "none")).succeeded().stdout;
        assert!(
            told.contains("warning: ") && told.contains(without),
            "{command}: {told}"
        );
        let mut blind = ranks.command(command, &[arguments, &["--json"]].concat());
        let json = said(blind.env("FAKE_FEATURES", "none")).succeeded().json();
        let warnings = json["warnings"].as_array().unwrap();
        assert!(
            warnings.iter().any(|told| told.as_str().unwrap().contains(without)),
            "{json}"
        );
        let told = ranks.cgaft(command, arguments).succeeded().stdout;
        assert!(!told.contains("without MPI"), "{command}: {told}");
    }
    let mut one = ranks.command("plan", &["--ranks", "1"]);
    let told = said(one.env("FAKE_FEATURES", "none")).succeeded().stdout;
    assert!(!told.contains("without MPI"), "{told}");
}

#[test]
fn the_plan_shows_mpirun() {
    let ranks = Ranks::new();
    let plan = ranks
        .cgaft("plan", &["--ranks", "2", "--threads", "5"])
        .succeeded()
        .stdout;
    assert_eq!(
        plan.matches("    mpirun -n 2 --bind-to none --oversubscribe ").count(),
        3,
        "{plan}"
    );
    assert!(plan.contains(" --threads 5 "), "{plan}");
}

#[test]
fn ranks_that_cannot_be_started_are_refused_before_anything_is() {
    let ranks = Ranks::new();
    let refused = |change: &dyn Fn(&mut Command)| {
        let mut run = ranks.command("run", &[]);
        change(&mut run);
        let refused = said(&mut run);
        assert_eq!(refused.code, Some(3), "{}{}", refused.stdout, refused.stderr);
        assert!(!ranks.place.path("results").exists(), "nothing was started");
        refused.stderr
    };
    let without = refused(&|run| {
        run.env("FAKE_FEATURES", "none");
    });
    for told in ["was built without MPI", "3 ranks", "`make build`", "--threads"] {
        assert!(without.contains(told), "no `{told}` in {without}");
    }
    let another = refused(&|run| {
        run.env("FAKE_MPIRUN", "HYDRA build details:");
    });
    assert!(another.contains("is that of HYDRA"), "{another}");
    // A folder with the shell that the fake solver needs, and no mpirun.
    fs::remove_file(ranks.place.path("bin/mpirun")).unwrap();
    symlink("/bin/sh", ranks.place.path("bin/sh")).unwrap();
    let missing = refused(&|run| {
        run.env("PATH", ranks.place.path("bin"));
    });
    for told in ["`mpirun` is not on the PATH", "openmpi-bin", "--threads"] {
        assert!(missing.contains(told), "no `{told}` in {missing}");
    }
    let doctor = said(ranks.place.command(&["doctor"]).env("PATH", ranks.place.path("bin")));
    assert!(
        doctor.stdout.contains("built with Open MPI 4.1.4, but no mpirun"),
        "{}",
        doctor.stdout
    );
}

#[test]
fn ctrl_c_reaches_the_first_rank_which_leaves_a_checkpoint() {
    let ranks = Ranks::new();
    let run = ranks
        .command("run", &["--only", "A"])
        .env("FAKE_SLOW", "study:")
        .spawn()
        .unwrap();
    wait_for("the first rank", || ranks.place.starts().len() == 1);
    signal(&run, "-INT");
    finished(run).ended_with(130);
    assert_eq!(checkpoints(&ranks.place), 1);
    ranks.cgaft("run", &["--only", "A", "--ranks", "5"]).succeeded();
    let log = fs::read_to_string(ranks.place.path("results/slab/cases/A/log.txt")).unwrap();
    assert!(log.contains("mpirun -n 3 ") && log.contains("mpirun -n 5 "), "{log}");
}

#[test]
fn a_failure_of_the_ranks_has_the_meaning_of_the_solvers_own_exit_code() {
    let ranks = Ranks::new();
    let run = said(ranks.command("run", &["--only", "A"]).env("FAKE_FAIL", "study:"));
    assert_eq!(run.code, Some(1));
    assert!(run.stderr.contains("A: failed: the physics failed"), "{}", run.stderr);
    assert!(run.stderr.contains("    | log line 30\n"), "{}", run.stderr);
}
