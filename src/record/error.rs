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

    #[error("{path} is damaged ({what}); delete the folder it is in and run again: the case starts afresh")]
    Damaged { path: PathBuf, what: String },

    #[error("{path} is not a {expected} of cgaft; move it away and run again")]
    NotOurs { path: PathBuf, expected: &'static str },

    #[error(
        "{path} is a {kind} of format {found}, and this program reads format {readable}; read it with the version \
         that wrote it, or delete the folder it is in and run again: the case starts afresh"
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
            cause: brief(&cause.to_string()),
        }
    }

    pub(super) fn cannot_read(path: &Path, cause: impl std::fmt::Display) -> Self {
        RecordError::CannotRead {
            path: path.to_owned(),
            cause: brief(&cause.to_string()),
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

/// What the system said, out of the many lines that HDF5 makes of it; else everything.
fn brief(cause: &str) -> String {
    let said = cause
        .split_once("error message = '")
        .and_then(|(_, rest)| rest.split_once('\''));
    said.map_or(cause, |(message, _)| message).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_disk_is_told_in_the_words_of_the_system() {
        let hdf5 = "H5Dwrite(): can't write data: file write failed: time = Sun Nov 22 07:40:48 2026\n, filename = \
                    'f.h5.tmp', file descriptor = 3, errno = 28, error message = 'No space left on device', offset = 0";
        let message = RecordError::cannot_write(Path::new("f.h5"), hdf5).to_string();
        assert!(
            message.starts_with("f.h5 could not be written: No space left on device; make room"),
            "{message}"
        );
    }
}
