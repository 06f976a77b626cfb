//! Several processes a case: `mpirun` starts them, and takes part in how they end.

use std::fs;
use std::os::unix::fs::MetadataExt;
use std::path::Path;

use super::command::Launch;
use super::probe::output_of;

/// Why ranks cannot be started here.
#[derive(Debug, thiserror::Error)]
pub enum MpiError {
    #[error(
        "`mpirun` is not on the PATH, and {ranks} ranks need it: install Open MPI (`apt-get install openmpi-bin`, or \
         the MPI module of a cluster), or leave out `ranks` and use `--threads N`"
    )]
    NoMpirun { ranks: u32 },
    #[error(
        "{solver} does not start, so that it cannot tell whether it knows MPI: `{solver} --version` shows why; \
         perhaps the MPI library that it was built with is missing"
    )]
    SolverMute { solver: String },
    #[error(
        "{solver} was built without MPI, so that it computes with threads but not with {ranks} ranks: `make build` \
         builds one with MPI; or leave out `ranks` and use `--threads N`"
    )]
    SolverWithout { solver: String, ranks: u32 },
    #[error(
        "{solver} was built with {built}, and `mpirun` is that of {found}: put the mpirun of {built} first on the \
         PATH, or run `make build` again"
    )]
    Another {
        solver: String,
        built: String,
        found: String,
    },
    #[error(
        "{solver} was built with {built}, and only Open MPI is started from here: run `make build` with Open MPI, or \
         start the cases with your own mpirun, as `study plan` shows them"
    )]
    OnlyOpenMpi { solver: String, built: String },
}

/// What a solver says of itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Speaks {
    /// With the library, such as `Open MPI 4.1.4`.
    Mpi(String),
    ThreadsOnly,
    /// It does not start here.
    Nothing,
}

/// Whether a solver was built with MPI.
pub fn of_solver(solver: &Path) -> Speaks {
    let Some(version) = output_of(solver, &["--version"]) else {
        return Speaks::Nothing;
    };
    let features = version.lines().find_map(|line| line.strip_prefix("features: "));
    let library = features.and_then(|features| {
        let (_, rest) = features.split_once("mpi (")?;
        Some(rest.split_once(')')?.0.to_owned())
    });
    library.map_or(Speaks::ThreadsOnly, Speaks::Mpi)
}

/// `mpirun (Open MPI) 4.1.4`
pub fn of_mpirun() -> Option<String> {
    output_of("mpirun", &["--version"])?.lines().next().map(str::to_owned)
}

/// Refuses ranks that could not be started on this machine, before anything is.
pub fn check(solver: &Path, ranks: u32) -> Result<(), MpiError> {
    if ranks <= 1 {
        return Ok(());
    }
    check_elsewhere(solver, ranks)?;
    let name = solver.display().to_string();
    let Speaks::Mpi(built) = of_solver(solver) else {
        return Err(MpiError::SolverMute { solver: name });
    };
    let found = of_mpirun().ok_or(MpiError::NoMpirun { ranks })?;
    let is_open_mpi = |text: &str| text.contains("Open MPI") || text.contains("OpenRTE");
    match [is_open_mpi(&built), is_open_mpi(&found)] {
        [true, true] => Ok(()),
        [false, false] => Err(MpiError::OnlyOpenMpi { solver: name, built }),
        _ => Err(MpiError::Another {
            solver: name,
            built,
            found,
        }),
    }
}

/// Refuses ranks that no machine could start. A solver that does not start here may do so where its modules are loaded.
pub fn check_elsewhere(solver: &Path, ranks: u32) -> Result<(), MpiError> {
    if ranks > 1 && of_solver(solver) == Speaks::ThreadsOnly {
        let solver = solver.display().to_string();
        return Err(MpiError::SolverWithout { solver, ranks });
    }
    Ok(())
}

/// The command that starts `ranks` of a solver.
///
/// Nothing is bound to cores: several `mpirun` side by side would all take the first ones, and a rank's threads would
/// share one. Whoever waits gives way, because a rank may have to share its core.
pub fn under_mpirun(solve: Launch, ranks: u32) -> Launch {
    let ranks = ranks.to_string();
    let mut words = vec!["-n", &ranks, "--bind-to", "none", "--oversubscribe"];
    words.extend(["--mca", "mpi_yield_when_idle", "1"]);
    if is_root() {
        words.push("--allow-run-as-root");
    }
    let solver = solve.program.display().to_string();
    words.push(&solver);
    let arguments = words.into_iter().map(str::to_owned).chain(solve.arguments).collect();
    Launch {
        program: "mpirun".into(),
        arguments,
    }
}

/// Whether this process belongs to root, whom some programs refuse.
fn is_root() -> bool {
    fs::metadata("/proc/self").is_ok_and(|process| process.uid() == 0)
}

/// Keeps from `mpirun` what Slurm tells all processes of a job at its end: it would kill its ranks a second later, in
/// the middle of their last checkpoint. They hear it themselves. Where `env` cannot do that, the checkpoint before counts.
pub fn shielded(mpirun: Launch) -> Launch {
    const SHIELD: [&str; 2] = ["--block-signal=TERM", "--block-signal=INT"];
    if output_of("env", &[&SHIELD[..], &["true"]].concat()).is_none() {
        return mpirun;
    }
    let program = mpirun.program.display().to_string();
    let words = SHIELD.map(str::to_owned).into_iter().chain([program]);
    Launch {
        program: "env".into(),
        arguments: words.chain(mpirun.arguments).collect(),
    }
}
