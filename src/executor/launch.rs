use std::env;
use std::fmt;
use std::fs;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};

use super::ExecutorError;
use super::mpi::under_mpirun;
use super::share::Crew;

/// A command, made but not started.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Launch {
    pub program: PathBuf,
    pub arguments: Vec<String>,
}

/// The command that computes the case in `folder`, with all files of the run in that folder.
pub fn launch(solver: &Path, folder: &Path, crew: Crew) -> Launch {
    let folder_text = folder.display().to_string();
    let case_text = folder.join("case.yaml").display().to_string();
    let threads = crew.threads.to_string();
    let arguments = [
        &case_text,
        "--into",
        &folder_text,
        "--threads",
        &threads,
        "--progress",
        "json",
        "--parent-pipe",
    ];
    let solve = Launch {
        program: solver.to_owned(),
        arguments: arguments.map(str::to_owned).to_vec(),
    };
    match crew.ranks {
        1 => solve,
        ranks => under_mpirun(solve, ranks),
    }
}

/// Whether this process belongs to root, whom some programs refuse.
pub(super) fn is_root() -> bool {
    fs::metadata("/proc/self").is_ok_and(|process| process.uid() == 0)
}

/// Finds `cgaft-solve`: where CGAFT_SOLVE says, else beside this program, else on the PATH.
pub fn find_solver() -> Result<PathBuf, ExecutorError> {
    if let Some(path) = env::var_os("CGAFT_SOLVE").map(PathBuf::from) {
        return if path.is_file() {
            Ok(path)
        } else {
            Err(ExecutorError::NoSolver)
        };
    }
    let beside = env::current_exe()
        .ok()
        .and_then(|program| Some(program.parent()?.to_owned()));
    let on_path = env::var_os("PATH")
        .map(|path| env::split_paths(&path).collect::<Vec<_>>())
        .unwrap_or_default();
    let mut candidates = beside
        .into_iter()
        .chain(on_path)
        .map(|folder| folder.join("cgaft-solve"));
    candidates
        .find(|program| program.is_file())
        .ok_or(ExecutorError::NoSolver)
}

impl fmt::Display for Launch {
    /// As one would type it in a shell.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}", quoted(&self.program.display().to_string()))?;
        self.arguments
            .iter()
            .try_for_each(|argument| write!(formatter, " {}", quoted(argument)))
    }
}

/// A word as a shell takes it.
pub fn quoted(word: &str) -> String {
    let plain = |letter: char| letter.is_ascii_alphanumeric() || "-_./=:,+@%".contains(letter);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_shown_is_the_command_that_a_shell_would_run() {
        let command = launch(
            Path::new("/opt/my tools/cgaft-solve"),
            Path::new("results/it's/runs/1f.partial"),
            Crew { ranks: 1, threads: 2 },
        );
        assert_eq!(
            command.to_string(),
            r"'/opt/my tools/cgaft-solve' 'results/it'\''s/runs/1f.partial/case.yaml' --into 'results/it'\''s/runs/1f.partial' --threads 2 --progress json --parent-pipe"
        );
    }

    #[test]
    fn ranks_are_started_by_mpirun_unbound_and_more_than_there_are_cores_if_need_be() {
        let crew = Crew { ranks: 4, threads: 2 };
        let command = launch(Path::new("/opt/cgaft-solve"), Path::new("1f.partial"), crew).to_string();
        assert!(
            command.starts_with("mpirun -n 4 --bind-to none --oversubscribe --mca mpi_yield_when_idle 1 ")
                && command.contains("/opt/cgaft-solve 1f.partial/case.yaml --into 1f.partial --threads 2 "),
            "{command}"
        );
    }
}
