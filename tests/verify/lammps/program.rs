//! LAMMPS at work in a folder of its own, and what it says.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::Command;

use tempfile::TempDir;

pub struct Folder(TempDir);

/// What a dump tells of one moment: a vector of every atom, and another.
pub struct Snapshot<const D: usize = 2> {
    pub step: u64,
    pub first: [Vec<f64>; D],
    pub second: [Vec<f64>; D],
}

impl Folder {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub fn path(&self) -> &Path {
        self.0.path()
    }

    pub fn file(&self, name: &str) -> PathBuf {
        self.path().join(name)
    }

    /// Runs a script of this folder.
    pub fn run(&self, script: &str) {
        let output = Command::new("lmp")
            .args(["-in", script])
            .current_dir(self.path())
            .output();
        let output = output.unwrap_or_else(|error| match error.kind() {
            ErrorKind::NotFound => panic!("LAMMPS (`lmp`) is not installed; type: make verify"),
            _ => panic!("lmp: {error}"),
        });
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{said}");
    }

    /// What a dump with columns `id …`, then two vectors, holds; atoms sorted.
    pub fn snapshots<const D: usize>(&self, name: &str) -> Vec<Snapshot<D>> {
        let text = fs::read_to_string(self.file(name)).unwrap();
        text.split("ITEM: TIMESTEP\n").skip(1).map(snapshot).collect()
    }

    /// The last row of the log.
    pub fn last_row(&self) -> Vec<f64> {
        let text = fs::read_to_string(self.file("log.lammps")).unwrap();
        let (rows, _) = text.split_once("Loop time").unwrap();
        let last = rows.trim_end().lines().last().unwrap();
        last.split_whitespace().map(|word| word.parse().unwrap()).collect()
    }
}

fn snapshot<const D: usize>(text: &str) -> Snapshot<D> {
    let (head, rows) = text.split_once("ITEM: ATOMS").unwrap();
    let mut snapshot = Snapshot {
        step: head.lines().next().unwrap().parse().unwrap(),
        first: std::array::from_fn(|_| Vec::new()),
        second: std::array::from_fn(|_| Vec::new()),
    };
    for (number, row) in rows.lines().skip(1).enumerate() {
        let words: Vec<&str> = row.split_whitespace().collect();
        assert_eq!(words[0].parse(), Ok(number + 1), "sorted");
        let numbers = words[words.len() - 2 * D..].iter().map(|word| word.parse().unwrap());
        let planes = snapshot.first.iter_mut().chain(&mut snapshot.second);
        planes
            .zip(numbers)
            .for_each(|(plane, number): (_, f64)| plane.push(number));
    }
    snapshot
}
