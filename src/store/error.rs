use std::io;
use std::path::{Path, PathBuf};

/// What can go wrong between the runs and the disk.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    #[error("cannot write {}: {source}; {}", path.display(), advice(source))]
    Write { path: PathBuf, source: io::Error },
    #[error("cannot read {}: {source}; make it readable, or choose another folder with --results DIR", path.display())]
    Read { path: PathBuf, source: io::Error },
    #[error(
        "{} says that its results have format {found}, and this version of cgaft reads format {known}; \
         use the version that wrote them, or choose another folder with --results DIR",
        path.display()
    )]
    Format { path: PathBuf, found: String, known: u32 },
}

impl StoreError {
    /// Whether it lies in what is there already and cannot be used, and not in what is to be written.
    pub fn is_of_the_input(&self) -> bool {
        matches!(self, StoreError::Read { .. } | StoreError::Format { .. })
    }

    pub(super) fn write(path: &Path) -> impl FnOnce(io::Error) -> StoreError + '_ {
        move |source| StoreError::Write {
            path: path.to_owned(),
            source,
        }
    }

    pub(super) fn read(path: &Path) -> impl FnOnce(io::Error) -> StoreError + '_ {
        move |source| StoreError::Read {
            path: path.to_owned(),
            source,
        }
    }
}

/// Of Linux: no locks available.
const NO_LOCKS: i32 = 37;

fn advice(error: &io::Error) -> &'static str {
    match error.kind() {
        _ if error.kind() == io::ErrorKind::Unsupported || error.raw_os_error() == Some(NO_LOCKS) => {
            "this file system has no file locks, by which processes keep out of each other's runs: choose a folder on another \
             one with --results DIR, or have it mounted with locks (Lustre: `flock`; NFS: with its lock service)"
        }
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "make the folder writable, or choose another one with --results DIR"
        }
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            "free some space (`cgaft study clean` removes what is no longer needed) and run again: \
             what was published is safe, and interrupted cases go on from their last checkpoint"
        }
        io::ErrorKind::NotADirectory | io::ErrorKind::AlreadyExists => {
            "a file is where a folder should be: move it away, or choose another folder with --results DIR"
        }
        _ => "check the disk, or choose another folder with --results DIR",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_system_without_locks_is_told_as_one() {
        const NOT_SUPPORTED: i32 = 95;
        for code in [NO_LOCKS, NOT_SUPPORTED] {
            let error = StoreError::write(Path::new("results/.locks/a"))(io::Error::from_raw_os_error(code));
            assert!(error.to_string().contains("has no file locks"), "{error}");
        }
    }
}
