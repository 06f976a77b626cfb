//! Writing that survives a crash: a file is either old or new, never half.

use std::fs::{self, File, Permissions, TryLockError};
use std::io;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::StoreError;
use crate::durable;

/// The bits of a mode that let anybody write, and that let the owner.
const WRITE: u32 = 0o222;
const OWN_WRITE: u32 = 0o200;

/// End of the name of a file that is still being written.
pub const ASIDE: &str = ".new";

/// Writes `value` as JSON, as [`write`] does.
pub fn write_json(path: &Path, value: &impl Serialize) -> Result<(), StoreError> {
    let mut text = serde_json::to_vec_pretty(value).expect("these types always have a JSON form");
    text.push(b'\n');
    write(path, &text)
}

/// Writes `bytes` aside, flushes them to the disk and renames them into place.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), StoreError> {
    // Two processes may write the same file at once: each has its own aside, and the last one wins.
    let aside = path.with_extension(format!("{}{ASIDE}", std::process::id()));
    fs::write(&aside, bytes)
        .and_then(|()| durable::put_in_place(&aside, path))
        .map_err(StoreError::write(path))
}

/// The value in a JSON file; the error is told in words.
pub fn read_json<T: DeserializeOwned>(path: &Path) -> Result<T, String> {
    let name = path.file_name().unwrap_or_default().display();
    let text = durable::read_to_string(path).map_err(|error| format!("{name} cannot be read ({error})"))?;
    serde_json::from_str(&text).map_err(|error| format!("{name} is damaged ({error})"))
}

/// BLAKE3 of what is in a file, hexadecimal.
pub fn checksum(path: &Path) -> io::Result<String> {
    let mut hasher = blake3::Hasher::new();
    hasher.update_reader(durable::open(path)?)?;
    Ok(hasher.finalize().to_string())
}

pub fn open_lock(path: &Path) -> Result<File, StoreError> {
    durable::append(path).map_err(StoreError::write(path))
}

/// The locked file, or `None` while another process holds it.
pub fn try_lock(path: &Path) -> Result<Option<File>, StoreError> {
    let file = open_lock(path)?;
    match file.try_lock() {
        Ok(()) => Ok(Some(file)),
        Err(TryLockError::WouldBlock) => Ok(None),
        Err(TryLockError::Error(error)) => Err(StoreError::write(path)(error)),
    }
}

/// Whether another process holds the lock; leaves no trace.
pub fn is_locked(path: &Path) -> bool {
    let Ok(file) = durable::open(path) else { return false };
    matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock))
}

/// Flushes a file or the entries of a folder to the disk.
pub fn sync(path: &Path) -> Result<(), StoreError> {
    durable::sync(path).map_err(StoreError::write(path))
}

/// Takes from everybody the right to write the files of a folder, or gives it back to their owner.
pub fn set_read_only(folder: &Path, read_only: bool) -> Result<(), StoreError> {
    for entry in fs::read_dir(folder).map_err(StoreError::read(folder))? {
        let path = entry.map_err(StoreError::read(folder))?.path();
        let metadata = fs::symlink_metadata(&path).map_err(StoreError::read(&path))?;
        if metadata.is_file() {
            let mode = metadata.permissions().mode();
            let mode = if read_only { mode & !WRITE } else { mode | OWN_WRITE };
            fs::set_permissions(&path, Permissions::from_mode(mode)).map_err(StoreError::write(&path))?;
        }
    }
    Ok(())
}

/// Removes what a killed process was just writing in place of `name`.
pub fn remove_asides(folder: &Path, name: &str) -> Result<(), StoreError> {
    let stem = format!("{}.", name.split('.').next().unwrap_or(name));
    let is_aside = |found: &str| found.starts_with(&stem) && found.ends_with(ASIDE);
    for entry in fs::read_dir(folder).map_err(StoreError::read(folder))? {
        let entry = entry.map_err(StoreError::read(folder))?;
        if entry.file_name().to_str().is_some_and(is_aside) {
            remove(&entry.path())?;
        }
    }
    Ok(())
}

/// Removes a file or a folder with all that is in it; that it is not there is no error.
pub fn remove(path: &Path) -> Result<(), StoreError> {
    let removed = match fs::symlink_metadata(path) {
        Ok(metadata) if metadata.is_dir() => fs::remove_dir_all(path),
        Ok(_) => fs::remove_file(path),
        Err(error) => Err(error),
    };
    match removed {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(StoreError::write(path)(error)),
        _ => Ok(()),
    }
}
