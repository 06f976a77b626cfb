//! Opening HDF5 files the way all of them are opened here.
//!
//! Without HDF5's file locks: renames already keep writers and readers apart, many network file systems have no
//! locks, and a lock outlives its file in every child process that is started meanwhile.

use std::path::Path;

use hdf5::File;
use hdf5::file::FileBuilder;

use crate::durable;

/// A new file whose first `header` bytes HDF5 leaves alone (0, or a power of two from 512 on).
///
/// It carries no time stamps, so that equal content gives equal bytes.
pub(super) fn create(path: &Path, header: u64) -> hdf5::Result<File> {
    unlocked()
        .with_fcpl(|create| create.userblock(header).obj_track_times(false))
        .create(path)
}

/// Opens a file that is there.
pub(super) fn open(path: &Path) -> hdf5::Result<File> {
    // HDF5 waits for the other end of a pipe.
    durable::open(path).map_err(|error| hdf5::Error::from(error.to_string()))?;
    unlocked().open(path)
}

/// Ends a file whose datasets were all flushed before they were dropped.
///
/// HDF5 keeps quiet about a write that fails while a dataset or a file is closed; a flush tells.
pub(super) fn finish(file: File) -> hdf5::Result<()> {
    file.flush()?;
    file.close()
}

fn unlocked() -> FileBuilder {
    let mut options = File::with_options();
    options.with_fapl(|access| access.file_locking(false));
    options
}
