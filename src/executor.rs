//! Starts the solver, one process a case, and sees each through to its end.
//!
//! Making a command ([`launch`]) and starting it ([`local`]) are separate, so that `cgaft study plan` can show it.
//! [`slurm`] starts jobs that do the same on another machine.

pub mod command;
pub mod errand;
pub mod exit;
pub mod launch;
mod local;
pub mod mpi;
pub mod probe;
pub mod progress;
pub mod queue;
pub mod share;
pub mod slurm;
pub mod stop;

pub use command::Launch;
pub use errand::{Ending, Errand, Job, Watcher};
pub use progress::Progress;
pub use queue::{Settings, WORTH_A_RESTART, run};
pub use stop::Stop;

use std::io;
use std::path::PathBuf;

use crate::store::StoreError;

/// What keeps cases from being started at all. A case that fails is no error here but an [`Ending`].
#[derive(Debug, thiserror::Error)]
pub enum ExecutorError {
    #[error(
        "cannot find `cgaft-solve`, the program that computes a case; it belongs beside `cgaft` or on the PATH: \
         run `make install`, or set CGAFT_SOLVE to where it is"
    )]
    NoSolver,
    #[error("cannot start {}: {source}; check that it is a program that this machine can run", program.display())]
    Start { program: PathBuf, source: io::Error },
    #[error(transparent)]
    Mpi(#[from] mpi::MpiError),
    #[error(transparent)]
    Slurm(#[from] slurm::SlurmError),
    #[error(transparent)]
    Store(#[from] StoreError),
}
