//! Cases as jobs of Slurm, for which a script stands in.

mod arrays;
mod refusals;
mod room;
mod stopping;

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::{STUDY, Said, Workspace, finished, of_cases, said};

/// A study in a folder with a Slurm of its own.
struct Cluster {
    place: Workspace,
}

impl Cluster {
    fn new() -> Cluster {
        Cluster::with("")
    }

    /// A study with this at its end.
    fn with(block: &str) -> Cluster {
        let place = Workspace::new();
        place.write_study(&format!("{STUDY}{block}"));
        fs::create_dir(place.path("bin")).unwrap();
        fs::create_dir(place.path("slurm")).unwrap();
        let fake = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/suite/fake-slurm.sh");
        for name in ["sbatch", "squeue", "scancel", "scontrol", "sacct"] {
            symlink(&fake, place.path("bin").join(name)).unwrap();
        }
        Cluster { place }
    }

    /// `cgaft study COMMAND slab.yaml …` where this Slurm is on the PATH, not yet started.
    fn command(&self, command: &str, arguments: &[&str]) -> Command {
        let mut cgaft = self
            .place
            .command(&[&["study", command, "slab.yaml"], arguments].concat());
        let path = format!(
            "{}:{}",
            self.place.path("bin").display(),
            std::env::var("PATH").unwrap()
        );
        cgaft.env("PATH", path);
        cgaft.env("FAKE_SLURM", self.slurm());
        cgaft.env("XDG_CONFIG_HOME", self.place.path("config"));
        cgaft
    }

    fn cgaft(&self, command: &str, arguments: &[&str]) -> Said {
        said(&mut self.command(command, arguments))
    }

    /// `study run --on slurm`
    fn run(&self) -> Command {
        self.command("run", &["--on", "slurm"])
    }

    fn slurm(&self) -> PathBuf {
        self.place.path("slurm")
    }

    /// Lines of a file in which Slurm remembers what it was asked.
    fn asked(&self, what: &str) -> Vec<String> {
        let text = fs::read_to_string(self.slurm().join(what)).unwrap_or_default();
        text.lines().map(str::to_owned).collect()
    }

    fn status(&self) -> serde_json::Value {
        self.cgaft("status", &["--json"]).succeeded().json()
    }

    fn states(&self) -> Vec<String> {
        of_cases(&self.status(), "state")
    }
}

impl Drop for Cluster {
    /// A test that fails leaves nothing at work.
    fn drop(&mut self) {
        for job in fs::read_dir(self.slurm()).into_iter().flatten().flatten() {
            if job.path().extension().is_some_and(|extension| extension == "pid") {
                let process = fs::read_to_string(job.path()).unwrap_or_default();
                // That it has ended is the only way in which this fails.
                let _ = Command::new("kill").arg(process.trim()).stderr(Stdio::null()).status();
            }
        }
    }
}

#[test]
fn an_array_of_jobs_computes_a_study_to_its_report() {
    let cluster = Cluster::new();
    let run = said(&mut cluster.run()).succeeded();
    for told in [
        "A: submitted as Slurm job 100_0",
        "C: done",
        "report: results/slab/report.html",
    ] {
        assert!(run.stdout.contains(told), "no `{told}` in {}", run.stdout);
    }
    assert_eq!(cluster.asked("submissions").len(), 1, "one array for all");
    assert_eq!(cluster.states(), ["done"; 3]);
    assert!(cluster.place.path("results/slab/cases/B/manifest.json").exists());

    said(&mut cluster.run()).succeeded();
    assert_eq!(cluster.asked("submissions").len(), 1, "what is done is not handed over");
    assert_eq!(cluster.place.starts().len(), 3);
}

#[test]
fn the_plan_shows_the_script_that_is_submitted() {
    let cluster = Cluster::with(
        "cluster:\n  partition: long\n  account: fracture\n  time: 1.5 h\n  threads: 4\n  modules: [hdf5/1.14]\n  \
         preamble: |\n    module() { echo \"$@\"; }\n    export OMP_PROC_BIND=true\n  options: [--mem=8G]\n",
    );
    let plan = cluster.cgaft("plan", &["--on", "slurm", "--json"]).succeeded().json();
    let script = plan["scripts"][0].as_str().unwrap();
    for line in [
        "#SBATCH --job-name=cgaft-slab",
        "#SBATCH --array=0-2",
        "#SBATCH --cpus-per-task=4",
        "#SBATCH --partition=long",
        "#SBATCH --account=fracture",
        "#SBATCH --time=01:30:00",
        "#SBATCH --signal=B:USR1@120",
        "#SBATCH --mem=8G",
        "module load hdf5/1.14",
        "export OMP_PROC_BIND=true",
    ] {
        assert!(script.lines().any(|found| found == line), "no `{line}` in {script}");
    }
    assert!(!cluster.place.path("results").exists(), "a plan changes nothing");
    said(&mut cluster.run()).succeeded();
    assert_eq!(fs::read_to_string(cluster.slurm().join("100.sh")).unwrap(), script);
    assert!(cluster.place.starts().iter().all(|start| start.ends_with("threads=4")));
}

/// A folder whose name has a meaning to bash and to sbatch in every place.
const AWKWARD: &str = "it's \"my\" $HOME; rm #1 %A \\ end";

#[test]
fn a_whole_script_is_shell_and_holds_the_results_folder_as_it_is() {
    let cluster = Cluster::new();
    let plan = cluster.cgaft("plan", &["--on", "slurm", "--json", "--results", AWKWARD]);
    let script = plan.succeeded().json()["scripts"][0].as_str().unwrap().to_owned();
    let place = fs::canonicalize(cluster.place.path("")).unwrap().display().to_string();
    let plain = |letter: char| letter.is_ascii_alphanumeric() || "/-_.".contains(letter);
    assert!(place.chars().all(plain), "{place} needs quotes itself");

    let options: Vec<&str> = script.lines().filter(|line| line.starts_with("#SBATCH")).collect();
    let output =
        format!("#SBATCH \"--output={place}/it's \\\"my\\\" $HOME; rm #1 %%A \\\\ end/slab/.slurm/%A_%a.out\"");
    assert_eq!(
        options,
        [
            "#SBATCH --job-name=cgaft-slab",
            "#SBATCH --array=0-2",
            "#SBATCH --nodes=1",
            "#SBATCH --ntasks=1",
            "#SBATCH --cpus-per-task=1",
            "#SBATCH --signal=B:USR1@120",
            "#SBATCH --requeue",
            "#SBATCH --open-mode=append",
            &output,
        ]
    );

    let file = cluster.place.path("job.sh");
    fs::write(&file, &script).unwrap();
    let checked = Command::new("bash").arg("-n").arg(&file).output().unwrap();
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stderr));

    // The words that bash hands over, one a line.
    let told = script.replace("\nexec ", "\nprintf '%s\\n' ");
    let words = Command::new("bash")
        .arg("-c")
        .arg(&told)
        .env("SLURM_ARRAY_TASK_ID", "1")
        .output()
        .unwrap();
    let words = String::from_utf8(words.stdout).unwrap();
    let words: Vec<&str> = words.lines().collect();
    let second = script
        .lines()
        .find_map(|line| line.strip_suffix(" # B"))
        .unwrap()
        .trim();
    assert_eq!(
        words[1..],
        ["slurm-job", "--results", &format!("{place}/{AWKWARD}"), "slab", second]
    );
}

#[test]
fn cases_with_other_resources_go_into_an_array_of_their_own() {
    let cluster = Cluster::new();
    let threads = STUDY.replace(
        "  C: {crack: {length: 55 nm}}",
        "  C: {crack: {length: 55 nm}, run: {threads: 3}}",
    );
    cluster.place.write_study(&threads);
    said(&mut cluster.run()).succeeded();
    assert_eq!(cluster.asked("submissions").len(), 2);
    let mut starts = cluster.place.starts();
    starts.sort_by_key(|start| start.split_once(' ').map(|(_, threads)| threads.to_owned()));
    assert!(
        starts[2].ends_with("threads=3") && starts[1].ends_with("threads=1"),
        "{starts:?}"
    );
}

#[test]
fn a_profile_of_ones_own_serves_all_studies_and_a_study_stands_over_it() {
    let cluster = Cluster::with("cluster: {partition: long}\n");
    let profile = cluster.place.path("config/cgaft/cluster.yaml");
    fs::create_dir_all(profile.parent().unwrap()).unwrap();
    fs::write(&profile, "partition: short\naccount: fracture\n").unwrap();
    let plan = cluster.cgaft("plan", &["--on", "slurm"]).succeeded().stdout;
    assert!(
        plan.contains("--partition=long\n") && plan.contains("--account=fracture\n"),
        "{plan}"
    );

    fs::write(&profile, "acount: fracture\nranks: 0\noptions: [--array=1-9]\n").unwrap();
    let refused = cluster.cgaft("plan", &["--on", "slurm"]);
    assert_eq!(refused.code, Some(2));
    for told in [
        "cluster.yaml:1:",
        "`account`",
        "cluster.yaml:2:",
        "`cluster.ranks` must be at least 1",
        "cluster.yaml:3:",
    ] {
        assert!(refused.stderr.contains(told), "no `{told}` in {}", refused.stderr);
    }
}

#[test]
fn a_failing_case_does_not_keep_the_others_from_their_end() {
    let cluster = Cluster::new();
    let run = said(cluster.run().env("FAKE_FAIL", "study: B"));
    assert_eq!(run.code, Some(1), "{}{}", run.stdout, run.stderr);
    assert!(run.stderr.contains("B: failed: the physics failed"), "{}", run.stderr);
    assert!(run.stderr.contains("    | log line 30\n"), "{}", run.stderr);
    assert_eq!(cluster.states(), ["done", "failed", "done"]);
    let status = cluster.cgaft("status", &[]).stdout;
    assert!(status.contains("(Slurm job 100_1)"), "{status}");

    said(&mut cluster.run()).succeeded();
    assert_eq!(cluster.asked("submissions").len(), 2);
    assert_eq!(cluster.place.starts().len(), 4, "only the failed case ran again");
}

#[test]
fn what_is_done_is_computed_again_on_request() {
    let cluster = Cluster::new();
    said(&mut cluster.run()).succeeded();
    said(&mut cluster.command("run", &["--on", "slurm", "--fresh", "--only", "A"])).succeeded();
    assert_eq!(cluster.place.starts().len(), 4);
}
