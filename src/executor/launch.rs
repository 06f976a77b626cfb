use std::env;
use std::path::{Path, PathBuf};

use super::ExecutorError;
use super::command::Launch;
use super::mpi::under_mpirun;
use super::share::Crew;

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
