//! The solver that knows MPI, for tests that start several ranks.

use std::path::{Path, PathBuf};
use std::process::Command;

/// `cgaft-solve` with MPI, as `make` builds it for tests or beside the other programs, and an `mpirun` for it.
pub fn solver_with_mpi() -> Option<PathBuf> {
    let says = |program: &Path, word: &str| {
        let output = Command::new(program).arg("--version").output();
        output.is_ok_and(|output| String::from_utf8_lossy(&output.stdout).contains(word))
    };
    let of_tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/mpi/cgaft-solve");
    let candidates = [of_tests, PathBuf::from(env!("CARGO_BIN_EXE_cgaft-solve"))];
    let solver = candidates.into_iter().find(|solver| says(solver, "features: mpi"))?;
    says(Path::new("mpirun"), "Open MPI").then_some(solver)
}
