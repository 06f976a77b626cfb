//! The program as a person uses it, with a script in the place of the solver.

mod cautions;
mod export;
mod interrupt;
mod messages;
mod ranks;
mod repeat;
mod single;
mod slurm;
mod specimen;
mod sweep;
mod table;
mod tools;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;

/// A folder with a study of three cases in it.
struct Workspace {
    folder: TempDir,
}

struct Said {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

const STUDY: &str = r"
study: slab
question: Does the runner run?
base:
  material:
    potential: {lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, cutoff: 0.34 nm, at-cutoff: truncated}}
    mass: 802 u
    thickness: 0.2087 nm
  specimen: {lattice: triangular, length: 115 nm, width: 35.4 nm}
  resolution: {element: 10}
  crack: {edge: left, length: 46 nm}
  loading: {strain-rate: {mode: I, rate: 9.81e7 /s, ramp: initial-velocity}}
  run: {until: {strain: 3.5 %}}
  probes: {every: 1 ps}
  observe: [crack]
cases:
  A: {}
  B: {crack: {length: 50 nm}}
  C: {crack: {length: 55 nm}}
";

impl Workspace {
    fn new() -> Workspace {
        let workspace = Workspace {
            folder: tempfile::tempdir().unwrap(),
        };
        workspace.write_study(STUDY);
        workspace
    }

    fn write_study(&self, text: &str) {
        fs::write(self.path("slab.yaml"), text).unwrap();
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// `cgaft` in this folder, not yet started.
    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_cgaft"));
        let solver = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/suite/fake-solver.sh");
        command
            .args(arguments)
            .current_dir(self.folder.path())
            .env("CGAFT_SOLVE", solver);
        command
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        command
    }

    fn cgaft(&self, arguments: &[&str]) -> Said {
        said(&mut self.command(arguments))
    }

    /// Names of the runs that were started, in the order of starting.
    fn starts(&self) -> Vec<String> {
        let text = fs::read_to_string(self.path("results/slab/starts.txt")).unwrap_or_default();
        text.lines().map(str::to_owned).collect()
    }
}

fn said(command: &mut Command) -> Said {
    Said::from(command.output().unwrap())
}

/// What a program that is at work says until its end.
fn finished(child: Child) -> Said {
    Said::from(child.wait_with_output().unwrap())
}

impl From<Output> for Said {
    fn from(output: Output) -> Said {
        Said {
            code: output.status.code(),
            stdout: String::from_utf8(output.stdout).unwrap(),
            stderr: String::from_utf8(output.stderr).unwrap(),
        }
    }
}

impl Said {
    fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error}: {}", self.stdout))
    }

    #[track_caller]
    fn succeeded(self) -> Said {
        self.ended_with(0)
    }

    #[track_caller]
    fn ended_with(self, code: i32) -> Said {
        assert_eq!(self.code, Some(code), "{}{}", self.stdout, self.stderr);
        self
    }
}

/// One value of every case, such as `state`.
fn of_cases(json: &Value, key: &str) -> Vec<String> {
    let cases = json["cases"].as_array().unwrap();
    cases
        .iter()
        .map(|case| case[key].as_str().map_or_else(|| case[key].to_string(), str::to_owned))
        .collect()
}
