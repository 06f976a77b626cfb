//! What the files of the hard cases expect, and what is found.

use std::collections::HashMap;
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use glob::Pattern;
use serde_json::Value;

/// A study of hard cases.
pub struct Study {
    pub name: String,
    pub question: String,
    file: PathBuf,
    /// Patterns of names of cases; the last that fits holds.
    expected: Vec<(Pattern, Expected)>,
}

/// What must come out of a case.
#[derive(Clone, Debug, PartialEq)]
pub enum Expected {
    /// Energy error as a share of the work, and the closest that sites may come, in spacings.
    Stable { energy: f64, approach: f64 },
    /// The reason has these words.
    Stops { words: String },
}

/// What came out of it.
pub struct Found {
    case: String,
    expected: Expected,
    /// `None` where it stopped.
    run: Option<Run>,
    /// Why it stopped.
    reason: String,
}

struct Run {
    steps: f64,
    /// As a share of the work; `None` where none was done.
    energy: Option<f64>,
    /// In spacings; `None` where all bonds were regular.
    closest: Option<f64>,
    atom_steps_a_core_second: f64,
}

/// All studies, by the names of their files.
pub fn studies() -> Vec<Study> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/hard-cases");
    let files = fs::read_dir(folder).expect("the hard cases are there");
    let mut files: Vec<PathBuf> = files.map(|file| file.expect("it can be read").path()).collect();
    files.sort();
    files.into_iter().map(Study::read).collect()
}

impl Study {
    fn read(file: PathBuf) -> Self {
        let text = fs::read_to_string(&file).expect("a study can be read");
        let after = |start: &str| {
            text.lines()
                .find_map(|line| line.strip_prefix(start))
                .map(str::to_owned)
        };
        let expected = text.lines().filter_map(|line| line.strip_prefix("# expect "));
        let expected = expected.map(|line| {
            let (case, rest) = line.split_once(": ").expect("a case and what is expected of it");
            (Pattern::new(case).expect("a pattern"), Expected::read(rest))
        });
        Self {
            name: after("study: ").expect("a name"),
            question: after("question: ").expect("a question"),
            expected: expected.collect(),
            file,
        }
    }

    fn expected_of(&self, case: &str) -> Expected {
        let fits = |(pattern, _): &&(Pattern, Expected)| pattern.matches(case);
        let (_, expected) = self
            .expected
            .iter()
            .rev()
            .find(fits)
            .expect("every case is expected to do something");
        expected.clone()
    }

    /// Computes it by this program.
    pub fn run(&self, program: &Path, results: &Path) -> Vec<Found> {
        let mut command = Command::new(program);
        command
            .args(["study", "run"])
            .arg(&self.file)
            .arg("--results")
            .arg(results);
        let output = command.args(["--threads", "1"]).output().expect("cgaft can be started");
        let told = [output.stdout, output.stderr].concat();
        let told = String::from_utf8_lossy(&told).into_owned();
        let folder = results.join(&self.name);
        if output.status.code() == Some(2) {
            let cases = self.expected.iter().map(|(pattern, _)| pattern.as_str().to_owned());
            return cases.map(|case| self.found(case, None, told.clone())).collect();
        }
        let atoms = atoms(&folder);
        let found = atoms.into_iter().map(|(case, atoms)| {
            let manifest = fs::read_to_string(folder.join("cases").join(&case).join("manifest.json"));
            let run = manifest.ok().map(|text| Run::read(&text, atoms));
            self.found(case, run, told.clone())
        });
        found.collect()
    }

    fn found(&self, case: String, run: Option<Run>, reason: String) -> Found {
        Found {
            expected: self.expected_of(&case),
            case,
            run,
            reason,
        }
    }
}

/// The cases of a report in their order, and how many atoms each represents.
fn atoms(folder: &Path) -> Vec<(String, f64)> {
    let table = fs::read_to_string(folder.join("tables/summary.csv")).expect("a report has its table");
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let heads = lines.next().expect("a table has a head");
    let columns: HashMap<&str, usize> = heads
        .into_iter()
        .enumerate()
        .map(|(index, head)| (head, index))
        .collect();
    let number = |cells: &[&str]| cells[columns["represented_atoms"]].parse().unwrap_or(0.0);
    lines.map(|cells| (cells[0].to_owned(), number(&cells))).collect()
}

impl Expected {
    fn read(text: &str) -> Self {
        let mut parts = text.split("; ");
        match parts.next() {
            Some("stops") => Self::Stops {
                words: parts.next().expect("words of the reason").to_owned(),
            },
            Some("stable") => {
                let mut number = |start: &str| -> f64 {
                    let part = parts.next().and_then(|part| part.strip_prefix(start)).expect("a bound");
                    part.trim_end_matches(" %").parse().expect("a number")
                };
                Self::Stable {
                    energy: number("energy ") / 100.0,
                    approach: number("approach "),
                }
            }
            _ => panic!("neither `stable` nor `stops`: {text}"),
        }
    }
}

impl Run {
    fn read(manifest: &str, atoms: f64) -> Self {
        let manifest: Value = serde_json::from_str(manifest).expect("a manifest is JSON");
        let outcome = &manifest["outcome"];
        let steps = outcome["steps"].as_f64().expect("a run has steps");
        Self {
            steps,
            energy: outcome["energy_error_relative"].as_f64(),
            closest: outcome["closest_approach_spacings"].as_f64(),
            atom_steps_a_core_second: atoms * steps / outcome["core_seconds"].as_f64().expect("a run has a cost"),
        }
    }
}

impl Found {
    /// Why it is not what was expected.
    pub fn failure(&self) -> Option<String> {
        let what = match (&self.expected, &self.run) {
            (Expected::Stops { words }, None) if self.reason.contains(words) => return None,
            (Expected::Stops { words }, None) => format!("stopped without `{words}`: {}", self.reason),
            (Expected::Stops { .. }, Some(_)) => "ran to its end".to_owned(),
            (Expected::Stable { .. }, None) => format!("stopped: {}", self.reason),
            (&Expected::Stable { energy, approach }, Some(run)) => {
                let is_near = run.closest.is_some_and(|closest| closest < approach);
                match run.energy.is_some_and(|error| error > energy) || is_near {
                    true => format!("energy {:?}, closest {:?}", run.energy, run.closest),
                    false => return None,
                }
            }
        };
        Some(format!("{}: expected {}; {what}", self.case, self.expected))
    }
}

impl fmt::Display for Expected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stable { energy, approach } => {
                write!(f, "stable, energy {} %, no closer than {approach}", 100.0 * energy)
            }
            Self::Stops { words } => write!(f, "stops: {words}"),
        }
    }
}

/// A row of the table.
impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = match (self.failure().is_none(), &self.run) {
            (true, Some(_)) => "as expected",
            (true, None) => "stopped as expected",
            (false, _) => "**otherwise**",
        };
        write!(f, "| {} | {} | {verdict} |", self.case, self.expected)?;
        match &self.run {
            None => write!(f, " | | | |"),
            Some(run) => {
                let energy = run
                    .energy
                    .map_or("no work".to_owned(), |error| format!("{:.3} %", 100.0 * error));
                let closest = run
                    .closest
                    .map_or("regular".to_owned(), |closest| format!("{closest:.3}"));
                let speed = run.atom_steps_a_core_second / 1e6;
                write!(f, " {energy} | {closest} | {} | {speed:.0} million /s |", run.steps)
            }
        }
    }
}
