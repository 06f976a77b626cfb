//! Cases as jobs of a real Slurm, on one node of its own: what a script in its place cannot show.
//!
//! One test, because it needs the machine for itself: an array, a failing case, a cancelled one, one whose jobs are too
//! short for it, a node that refuses, and cases of two ranks.

mod ranks;

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::thread;
use std::time::{Duration, Instant};

use tempfile::TempDir;

const STUDY: &str = include_str!("../studies/slab.yaml");

/// A strain rate at which the coarse slab computes for about a minute and a half: longer than a job of a minute, which
/// Slurm warns 15 to 45 s after its start.
const SLOW_RATE: &str = "5e5 /s";

/// A loaded machine; nothing waits so long when all is well.
const PATIENCE: Duration = Duration::from_secs(60);

/// The daemons, which end with it.
struct Slurm {
    folder: TempDir,
}

impl Slurm {
    /// `None` where Slurm is not installed.
    fn start() -> Option<Slurm> {
        let found = |name: &str| {
            ["/usr/sbin", "/usr/bin"]
                .iter()
                .any(|folder| Path::new(folder).join(name).exists())
        };
        if !found("slurmctld") || !found("slurmd") || !found("sbatch") {
            return None;
        }
        let slurm = Slurm {
            folder: tempfile::tempdir().unwrap(),
        };
        let started = slurm.daemons("start");
        assert!(started.status.success(), "{}", String::from_utf8_lossy(&started.stderr));
        Some(slurm)
    }

    fn daemons(&self, what: &str) -> Output {
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/verify/slurm/daemons.sh");
        Command::new(script).arg(self.folder.path()).arg(what).output().unwrap()
    }

    /// A command that knows this Slurm.
    fn command(&self, program: &str, arguments: &[&str]) -> Command {
        let mut command = Command::new(program);
        command
            .args(arguments)
            .env("SLURM_CONF", self.folder.path().join("slurm.conf"));
        command
    }
}

impl Drop for Slurm {
    fn drop(&mut self) {
        let _ = self.command("scancel", &["--name=cgaft-slab", "--quiet"]).output();
        self.daemons("stop");
    }
}

/// A study in a folder of its own.
struct Place<'a> {
    slurm: &'a Slurm,
    folder: TempDir,
}

impl<'a> Place<'a> {
    fn new(slurm: &'a Slurm, study: &str) -> Place<'a> {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("slab.yaml"), study).unwrap();
        Place { slurm, folder }
    }

    fn command(&self, command: &str, arguments: &[&str]) -> Command {
        let arguments = [&["study", command, "slab.yaml"], arguments].concat();
        let mut cgaft = self.slurm.command(env!("CARGO_BIN_EXE_cgaft"), &arguments);
        cgaft
            .current_dir(self.folder.path())
            .env("CGAFT_SOLVE", env!("CARGO_BIN_EXE_cgaft-solve"))
            .env("XDG_CONFIG_HOME", self.folder.path());
        cgaft
    }

    /// What it prints, after it has ended with this code.
    #[track_caller]
    fn cgaft(&self, command: &str, arguments: &[&str], code: i32) -> String {
        let output = self.command(command, arguments).output().unwrap();
        let said = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
        assert_eq!(output.status.code(), Some(code), "{said}\n{}", self.outputs());
        said
    }

    fn status(&self) -> String {
        self.cgaft("status", &[], 0)
    }

    fn wait_for(&self, what: &str) {
        let start = Instant::now();
        while !self.status().contains(what) {
            assert!(
                start.elapsed() < PATIENCE,
                "waited too long for `{what}`: {}{}",
                self.status(),
                self.outputs()
            );
            thread::sleep(Duration::from_millis(200));
        }
    }

    /// What the shells of the jobs have said.
    fn outputs(&self) -> String {
        let files = fs::read_dir(self.folder.path().join("results/slab/.slurm"))
            .into_iter()
            .flatten()
            .flatten();
        let outputs = files.filter(|file| file.path().extension().is_some_and(|extension| extension == "out"));
        outputs
            .filter_map(|file| fs::read_to_string(file.path()).ok())
            .collect()
    }

    fn run_of(&self, case: &str) -> PathBuf {
        fs::canonicalize(self.folder.path().join("results/slab/cases").join(case)).unwrap()
    }
}

fn assert_same_results(run: &Path, reference: &Path) {
    for name in ["checkpoint.h5", "series.h5", "fields.vtkhdf"] {
        let [own, other] = [run, reference].map(|folder| fs::read(folder.join(name)).unwrap());
        assert!(own == other, "{name} in {} is another one", run.display());
    }
}

#[test]
fn a_real_slurm_computes_fails_cancels_and_requeues_cases() {
    let Some(slurm) = Slurm::start() else {
        // Written past the harness, which keeps to itself what a passing test prints.
        let words = "skipped: slurmctld, slurmd and sbatch are not here; `.ci/packages slurm-wlm` installs them";
        writeln!(io::stderr(), "{words}").unwrap();
        return;
    };
    a_refusal_is_told(&slurm);
    an_array_gives_the_bits_of_a_local_run_and_a_failure_stays_alone(&slurm);
    ranks::a_job_starts_its_ranks_by_mpirun(&slurm);
    a_cancelled_case_goes_on(&slurm);
    a_case_longer_than_its_jobs_is_requeued_until_it_is_done(&slurm);
}

fn a_refusal_is_told(slurm: &Slurm) {
    let place = Place::new(slurm, &format!("{STUDY}cluster: {{partition: nowhere}}\n"));
    let said = place.cgaft("run", &["--on", "slurm"], 3);
    assert!(said.contains("invalid partition specified: nowhere"), "{said}");
}

/// A given step just below the limit of the crystal: it blows up when the crack breaks through.
const FAILING: &str = "  failing: {resolution: {element: 10, regions: [{band: {half-width: 2.3 nm, element: 1}}]}, \
                       run: {time-step: 108 fs}}\n";

fn an_array_gives_the_bits_of_a_local_run_and_a_failure_stays_alone(slurm: &Slurm) {
    let place = Place::new(slurm, &format!("{STUDY}{FAILING}"));
    let said = place.cgaft("run", &["--on", "slurm"], 1);
    assert!(said.contains("failing: failed: the physics failed"), "{said}");
    let status = place.status();
    assert!(
        status.contains("3 of 4 cases done") && status.contains("(Slurm job "),
        "{status}"
    );

    let local = Place::new(slurm, STUDY);
    local.cgaft("run", &[], 0);
    for case in ["coarse", "mixed", "atoms"] {
        assert_same_results(&place.run_of(case), &local.run_of(case));
    }
}

fn a_cancelled_case_goes_on(slurm: &Slurm) {
    let place = Place::new(slurm, &STUDY.replace("1e9 /s", "1e7 /s"));
    place.cgaft("run", &["--on", "slurm", "--detach", "--only", "atoms"], 0);
    place.wait_for("running as Slurm job");
    place.wait_for(" at step ");
    let said = place.cgaft("cancel", &[], 0);
    assert!(said.starts_with("cancelled 1 job"), "{said}");
    place.wait_for("goes on from its last checkpoint");
    assert!(place.status().contains("was cancelled"), "{}", place.status());
}

fn a_case_longer_than_its_jobs_is_requeued_until_it_is_done(slurm: &Slurm) {
    let study = STUDY.replace("1e9 /s", SLOW_RATE);
    let place = Place::new(slurm, &format!("{study}cluster: {{time: 1 min}}\n"));
    place.cgaft("run", &["--on", "slurm", "--only", "coarse"], 0);
    let manifest = fs::read_to_string(place.run_of("coarse").join("manifest.json")).unwrap();
    let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
    assert!(manifest["attempts"].as_u64() >= Some(2), "{manifest}");
    let log = fs::read_to_string(place.run_of("coarse").join("log.txt")).unwrap();
    assert!(log.contains("going on from step "), "{log}");
}
