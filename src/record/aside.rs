//! Files appear whole or not at all.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use super::RecordError;
use crate::durable;

/// End of the name of a file that is being written; what a kill may leave behind.
pub(super) const ASIDE: &str = ".tmp";

/// Lets `produce` write a file beside `path`, makes it durable and puts it in place by one rename.
///
/// Whatever stood at `path` stays until then.
pub(super) fn replace(path: &Path, produce: impl FnOnce(&Path) -> Result<(), RecordError>) -> Result<(), RecordError> {
    let aside = name_aside(path);
    let result = produce(&aside)
        .and_then(|()| durable::put_in_place(&aside, path).map_err(|cause| RecordError::cannot_write(path, cause)));
    if result.is_err() {
        // The error that is returned matters more than one of tidying up.
        let _ = fs::remove_file(&aside);
    }
    result
}

fn name_aside(path: &Path) -> PathBuf {
    let mut name = OsString::from(path);
    name.push(ASIDE);
    PathBuf::from(name)
}
