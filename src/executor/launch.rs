use std::env;
use std::fmt;
use std::path::{Path, PathBuf};

use super::ExecutorError;

/// A command, made but not started.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Launch {
    pub program: PathBuf,
    pub arguments: Vec<String>,
}

/// The command that computes the case in `folder`, with all files of the run in that folder.
pub fn launch(solver: &Path, folder: &Path, threads: u32) -> Launch {
    let folder_text = folder.display().to_string();
    let case_text = folder.join("case.yaml").display().to_string();
    let threads = threads.to_string();
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
    Launch {
        program: solver.to_owned(),
        arguments: arguments.map(str::to_owned).to_vec(),
    }
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
            2,
        );
        assert_eq!(
            command.to_string(),
            r"'/opt/my tools/cgaft-solve' 'results/it'\''s/runs/1f.partial/case.yaml' --into 'results/it'\''s/runs/1f.partial' --threads 2 --progress json --parent-pipe"
        );
    }
}
