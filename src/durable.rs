//! Files and folders on the disk as they are meant: either old or new, never half.

use std::fs::{self, File};
use std::io;
use std::path::Path;

/// Puts what was written aside in the place of a file by one rename, when all of it is on the disk. Whatever stood there stays
/// until then.
pub fn put_in_place(aside: &Path, path: &Path) -> io::Result<()> {
    sync(aside)?;
    fs::rename(aside, path)?;
    sync(folder_of(path))
}

/// Flushes a file, or the entries of a folder, to the disk.
pub fn sync(path: &Path) -> io::Result<()> {
    File::open(path)?.sync_all()
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
