use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::claim::SOLVER_LOCK;
use super::{MARK, Store, StoreError, files};

/// Something that was taken away, or left because somebody works on it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Removed {
    pub path: PathBuf,
    pub what: &'static str,
    /// Its size on disk, bytes.
    pub bytes: u64,
    /// `false`: it is in use, and stays.
    pub removed: bool,
}

impl Store {
    /// Removes runs that were never published, published runs that are not in `current`, what points at them, and
    /// what a killed process was just writing.
    pub fn clean(&self, current: &BTreeSet<String>, cases: &BTreeSet<String>) -> Result<Vec<Removed>, StoreError> {
        let mut removed = Vec::new();
        for name in entries(&self.root.join("runs"))? {
            let (id, what) = match name.split_once('.') {
                None if current.contains(&name) => continue,
                None => (name.as_str(), "superseded"),
                Some((id, "partial")) => (id, "unpublished"),
                Some((id, "replaced")) => (id, "superseded"),
                Some(_) => continue,
            };
            removed.push(self.clean_folder(&name, id, what)?);
        }
        for name in entries(&self.root.join("cases"))? {
            let link = self.case_link(&name);
            if !cases.contains(&name) || !link.exists() {
                files::remove(&link)?;
            }
        }
        if self.root.exists() {
            files::remove_asides(&self.root, MARK)?;
        }
        Ok(removed)
    }

    fn clean_folder(&self, name: &str, id: &str, what: &'static str) -> Result<Removed, StoreError> {
        let path = self.root.join("runs").join(name);
        let bytes = size(&path);
        let lock = files::try_lock(&self.lock_path(id))?;
        let free = lock.is_some() && !files::is_locked(&path.join(SOLVER_LOCK));
        if free {
            files::remove(&path)?;
        }
        Ok(Removed {
            path,
            what,
            bytes,
            removed: free,
        })
    }
}

/// Names in a folder, in order; none when there is no folder.
fn entries(folder: &Path) -> Result<Vec<String>, StoreError> {
    let listing = match fs::read_dir(folder) {
        Ok(listing) => listing,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(StoreError::read(folder)(error)),
    };
    let mut names = Vec::new();
    for entry in listing {
        let entry = entry.map_err(StoreError::read(folder))?;
        names.extend(entry.file_name().into_string().ok());
    }
    names.sort();
    Ok(names)
}

fn size(folder: &Path) -> u64 {
    let files = fs::read_dir(folder).into_iter().flatten().flatten();
    files
        .filter_map(|entry| entry.metadata().ok())
        .map(|metadata| metadata.len())
        .sum()
}
