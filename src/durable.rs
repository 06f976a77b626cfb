//! Files and folders on the disk as they are meant: either old or new, never half, and with an end.

use std::fs::{self, File};
use std::io::{self, Read};
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
    refuse_endless(path)?;
    File::open(path)?.sync_all()
}

/// Opens a file that can be read to its end: neither a folder nor a pipe or device, which might never end.
pub fn open(path: &Path) -> io::Result<File> {
    if fs::metadata(path)?.is_dir() {
        return Err(io::Error::other("it is a folder and no file"));
    }
    refuse_endless(path)?;
    File::open(path)
}

/// Opens a file to write at its end, and makes it if it is not there.
pub fn append(path: &Path) -> io::Result<File> {
    if path.exists() {
        refuse_endless(path)?;
    }
    File::options().create(true).append(true).open(path)
}

/// Replaces the content of a file, or makes it.
pub fn write(path: &Path, bytes: impl AsRef<[u8]>) -> io::Result<()> {
    if path.exists() {
        refuse_endless(path)?;
    }
    fs::write(path, bytes)
}

/// All bytes of a file.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open(path)?.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The text of a file.
pub fn read_to_string(path: &Path) -> io::Result<String> {
    let mut text = String::new();
    open(path)?.read_to_string(&mut text)?;
    Ok(text)
}

fn refuse_endless(path: &Path) -> io::Result<()> {
    let kind = fs::metadata(path)?.file_type();
    match kind.is_file() || kind.is_dir() {
        true => Ok(()),
        false => Err(io::Error::other("it is a pipe or a device and no file")),
    }
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
