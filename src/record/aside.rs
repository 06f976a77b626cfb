//! Files appear whole or not at all.

use std::ffi::OsString;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use super::RecordError;

/// End of the name of a file that is being written; what a kill may leave behind.
pub(super) const ASIDE: &str = ".tmp";

/// Lets `produce` write a file beside `path`, makes it durable and puts it in place by one rename.
///
/// Whatever stood at `path` stays until then.
pub(super) fn replace(path: &Path, produce: impl FnOnce(&Path) -> Result<(), RecordError>) -> Result<(), RecordError> {
    let aside = name_aside(path);
    let result =
        produce(&aside).and_then(|()| settle(&aside, path).map_err(|cause| RecordError::cannot_write(path, cause)));
    if result.is_err() {
        // The error that is returned matters more than one of tidying up.
        let _ = fs::remove_file(&aside);
    }
    result
}

/// Makes a rename or a removal in `folder` durable.
pub(super) fn sync_folder(folder: &Path) -> std::io::Result<()> {
    File::open(folder)?.sync_all()
}

fn settle(aside: &Path, path: &Path) -> std::io::Result<()> {
    File::open(aside)?.sync_all()?;
    fs::rename(aside, path)?;
    sync_folder(parent(path))
}

fn name_aside(path: &Path) -> PathBuf {
    let mut name = OsString::from(path);
    name.push(ASIDE);
    PathBuf::from(name)
}

fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
