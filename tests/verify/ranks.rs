//! What the tests of ranks share.

use std::process::Command;

/// Whether `cgaft-solve` was built with MPI, and `mpirun` is here to start it.
pub fn solver_speaks_mpi() -> bool {
    let says = |program: &str, word: &str| {
        let output = Command::new(program).arg("--version").output();
        output.is_ok_and(|output| String::from_utf8_lossy(&output.stdout).contains(word))
    };
    says(env!("CARGO_BIN_EXE_cgaft-solve"), "features: mpi") && says("mpirun", "Open MPI")
}
