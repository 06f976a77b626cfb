use std::io;

use crate::executor::{ExecutorError, exit};
use crate::report::ReportError;
use crate::store::StoreError;
use crate::study::StudyError;

/// Everything that ends a command early, sorted by exit code.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    #[error(transparent)]
    Study(#[from] StudyError),
    #[error("{0}")]
    Input(String),
    #[error("{0}")]
    Environment(String),
    #[error(transparent)]
    Store(#[from] StoreError),
    #[error(transparent)]
    Executor(#[from] ExecutorError),
    #[error("cannot write {what}: {source}; check the disk and the permissions of its folder")]
    Output { what: String, source: io::Error },
    #[error("the report: {0}")]
    Report(#[from] ReportError),
}

impl CliError {
    pub fn exit_code(&self) -> u8 {
        match self {
            CliError::Study(_) | CliError::Input(_) | CliError::Report(ReportError::Read(_)) => exit::BAD_INPUT,
            CliError::Environment(_) => exit::MISSING_ENVIRONMENT,
            CliError::Executor(
                ExecutorError::NoSolver | ExecutorError::Start { .. } | ExecutorError::Mpi(_) | ExecutorError::Slurm(_),
            ) => exit::MISSING_ENVIRONMENT,
            CliError::Store(store) | CliError::Executor(ExecutorError::Store(store)) if store.is_of_the_input() => {
                exit::BAD_INPUT
            }
            CliError::Executor(ExecutorError::Store(_)) => exit::OUTPUT_FAILED,
            CliError::Store(_) | CliError::Output { .. } | CliError::Report(_) => exit::OUTPUT_FAILED,
        }
    }

    /// For programs: what `--json` prints instead of a result.
    pub fn to_json(&self) -> serde_json::Value {
        let mut error = serde_json::json!({ "exit_code": self.exit_code(), "message": self.to_string() });
        if let CliError::Study(study) = self {
            error["mistakes"] = serde_json::json!(study.mistakes());
        }
        serde_json::json!({ "error": error })
    }

    /// For people, on standard error.
    pub fn render(&self, color: bool) -> String {
        match self {
            CliError::Study(study) => study.render(color).trim_end().to_owned(),
            other => format!("error: {other}"),
        }
    }
}
