//! Studies from the file to the report, with the real programs.

mod beside;
mod chapter_6;
mod checkpoint;
mod cost;
mod damage;
mod endless;
mod failure;
mod full;
mod interrupt;
mod kill;
mod pages;
mod pictures;
mod pulses;
mod quickstart;
mod ranks;
mod refined;
mod repeat;
mod scaling;
mod solids;
mod threads;

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::Value;
use tempfile::TempDir;

const STUDY: &str = include_str!("../studies/slab.yaml");
/// A program of these tests needs a few seconds; this is for a machine with other work.
const PATIENCE: Duration = Duration::from_secs(120);

/// A folder with the study of a small slab in it.
struct Workspace {
    folder: TempDir,
}

/// A program that has ended.
struct Said {
    status: ExitStatus,
    stdout: String,
    stderr: String,
}

impl Workspace {
    fn new() -> Workspace {
        Workspace::with(STUDY)
    }

    fn with(study: &str) -> Workspace {
        let folder = tempfile::tempdir().unwrap();
        let place = Workspace { folder };
        place.write_study(study);
        place
    }

    /// Hardly computes for writing checkpoints and pictures.
    fn restless() -> Workspace {
        Workspace::with(&restless(STUDY))
    }

    fn write_study(&self, text: &str) {
        fs::write(self.path("slab.yaml"), text).unwrap();
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn results(&self) -> PathBuf {
        self.path("results/slab")
    }

    /// Folder of a published case.
    fn case(&self, name: &str) -> PathBuf {
        fs::canonicalize(self.results().join("cases").join(name)).unwrap()
    }

    /// `cgaft study COMMAND slab.yaml …`, not yet started.
    fn command(&self, command: &str, arguments: &[&str]) -> Command {
        let mut cgaft = Command::new(env!("CARGO_BIN_EXE_cgaft"));
        cgaft.args(["study", command, "slab.yaml"]).args(arguments);
        cgaft.env("CGAFT_SOLVE", env!("CARGO_BIN_EXE_cgaft-solve"));
        cgaft.current_dir(self.folder.path());
        cgaft
    }

    fn cgaft(&self, command: &str, arguments: &[&str]) -> Said {
        Program::start(&mut self.command(command, arguments), self).wait(PATIENCE)
    }

    /// `cgaft-solve` for one case file, not yet started.
    fn solver(&self, case: &Path, into: &Path, arguments: &[&str]) -> Command {
        let mut solve = Command::new(env!("CARGO_BIN_EXE_cgaft-solve"));
        solve.arg(case).arg("--into").arg(into).args(arguments);
        solve.current_dir(self.folder.path());
        solve
    }

    fn states(&self) -> Vec<String> {
        let json = self.cgaft("status", &["--json"]).succeeded().json();
        let cases = json["cases"].as_array().unwrap();
        cases
            .iter()
            .map(|case| case["state"].as_str().unwrap().to_owned())
            .collect()
    }
}

fn restless(study: &str) -> String {
    assert!(study.contains("checkpoint-every: 1 h") && study.contains("every: 0.5 % strain"));
    study
        .replace("checkpoint-every: 1 h", "checkpoint-every: 20 ms")
        .replace("every: 0.5 % strain", "every: 0.1 % strain")
}

/// A program at work; what it says goes to files, so that it never waits for a reader.
struct Program {
    child: Child,
    folder: TempDir,
}

impl Program {
    fn start(command: &mut Command, place: &Workspace) -> Program {
        let folder = tempfile::tempdir_in(place.folder.path()).unwrap();
        let file = |name: &str| File::create(folder.path().join(name)).unwrap();
        let child = command
            .stdin(Stdio::null())
            .stdout(file("stdout"))
            .stderr(file("stderr"))
            .spawn()
            .unwrap();
        Program { child, folder }
    }

    fn has_ended(&mut self) -> bool {
        self.child.try_wait().unwrap().is_some()
    }

    /// Waits for its end; a program that hangs is a failure.
    fn wait(mut self, patience: Duration) -> Said {
        let start = Instant::now();
        while !self.has_ended() {
            if start.elapsed() > patience {
                self.kill();
                panic!("it hangs: {}", self.said());
            }
            thread::sleep(Duration::from_millis(5));
        }
        let status = self.child.wait().unwrap();
        let [stdout, stderr] = ["stdout", "stderr"].map(|name| self.text(name));
        Said { status, stdout, stderr }
    }

    /// As `kill -9` does.
    fn kill(&mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }

    fn said(&self) -> String {
        self.text("stdout") + &self.text("stderr")
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.folder.path().join(name)).unwrap()
    }
}

impl Drop for Program {
    /// A test that fails leaves nothing at work.
    fn drop(&mut self) {
        if !self.has_ended() {
            self.kill();
        }
    }
}

impl Said {
    #[track_caller]
    fn succeeded(self) -> Said {
        self.ended_with(0)
    }

    #[track_caller]
    fn ended_with(self, code: i32) -> Said {
        assert_eq!(self.status.code(), Some(code), "{}{}", self.stdout, self.stderr);
        self
    }

    fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error}: {}", self.stdout))
    }

    /// Whether a solver was started.
    fn started(&self, case: &str) -> bool {
        self.stdout.contains(&format!("{case}: started"))
    }
}

fn send(signal: &str, process: u32) {
    // That it has ended meanwhile is the only way in which this fails.
    let _ = Command::new("kill")
        .args([signal, &process.to_string()])
        .stderr(Stdio::null())
        .status();
}

fn wait_for(what: &str, mut happened: impl FnMut() -> bool) {
    let start = Instant::now();
    while !happened() {
        assert!(start.elapsed() < PATIENCE, "waited too long for {what}");
        thread::sleep(Duration::from_millis(2));
    }
}

/// Every file below a folder, links not followed.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            found.extend(files(&entry.path()));
        } else {
            found.push(entry.path());
        }
    }
    found.sort();
    found
}

/// When every file was last written.
fn written(folder: &Path) -> BTreeMap<PathBuf, std::time::SystemTime> {
    let time = |path: &PathBuf| fs::symlink_metadata(path).unwrap().modified().unwrap();
    files(folder)
        .into_iter()
        .map(|path| (path.clone(), time(&path)))
        .collect()
}

/// What a computation is: its end state, its time series and its pictures.
const RESULTS: [&str; 3] = ["checkpoint.h5", "series.h5", "fields.vtkhdf"];

#[track_caller]
fn assert_same_results(run: &Path, reference: &Path) {
    for name in RESULTS {
        let [own, other] = [run, reference].map(|folder| fs::read(folder.join(name)).unwrap());
        assert!(own == other, "{name} in {} is another one", run.display());
    }
}

/// Rows of a table of the report.
fn table(results: &Path, name: &str) -> Vec<BTreeMap<String, String>> {
    let text = fs::read_to_string(results.join("tables").join(format!("{name}.csv"))).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned));
    let head: Vec<String> = lines.next().unwrap().collect();
    lines.map(|line| head.iter().cloned().zip(line).collect()).collect()
}
