//! What can go wrong between a run and its files.

use std::path::{Path, PathBuf};

#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RecordError {
    #[error(
        "{path} could not be written: {cause}; make room or give a folder that can be written, then run again: \
         the run goes on from its last checkpoint"
    )]
    CannotWrite { path: PathBuf, cause: String },

    #[error("{path} could not be read: {cause}; check the disk and the permissions, then run again")]
    CannotRead { path: PathBuf, cause: String },

    #[error("{path} does not exist; run the case to make it")]
    Absent { path: PathBuf },

    #[error("{path} is damaged ({what}); delete it and run again: the case starts afresh")]
    Damaged { path: PathBuf, what: String },

    #[error("{path} is not a {expected} of cgaft; move it away and run again")]
    NotOurs { path: PathBuf, expected: &'static str },

    #[error(
        "{path} is a {kind} of format {found}, and this program reads format {readable}; read it with the version \
         that wrote it, or delete it and run again: the case starts afresh"
    )]
    OtherFormat {
        path: PathBuf,
        kind: &'static str,
        found: String,
        readable: u32,
    },

    #[error("{path} belongs to case {found}, not to case {expected}; move it away and run again")]
    OtherCase {
        path: PathBuf,
        found: String,
        expected: String,
    },

    #[error("the pieces of the run in {path} do not fit together ({what}); delete the folder and run the case afresh")]
    Gap { path: PathBuf, what: String },
}

impl RecordError {
    /// The output is at fault (disk full, read-only folder), not what was read.
    pub fn is_write_failure(&self) -> bool {
        matches!(self, RecordError::CannotWrite { .. })
    }

    pub(super) fn cannot_write(path: &Path, cause: impl std::fmt::Display) -> Self {
        RecordError::CannotWrite {
            path: path.to_owned(),
            cause: cause.to_string(),
        }
    }

    pub(super) fn cannot_read(path: &Path, cause: impl std::fmt::Display) -> Self {
        RecordError::CannotRead {
            path: path.to_owned(),
            cause: cause.to_string(),
        }
    }

    pub(super) fn damaged(path: &Path, what: impl std::fmt::Display) -> Self {
        RecordError::Damaged {
            path: path.to_owned(),
            what: what.to_string(),
        }
    }

    pub(super) fn gap(path: &Path, what: impl Into<String>) -> Self {
        RecordError::Gap {
            path: path.to_owned(),
            what: what.into(),
        }
    }

    /// An error of opening or reading `path`, told apart from its absence.
    pub(super) fn reading(path: &Path, cause: &std::io::Error) -> Self {
        match cause.kind() {
            std::io::ErrorKind::NotFound => RecordError::Absent { path: path.to_owned() },
            _ => RecordError::cannot_read(path, cause),
        }
    }
}
