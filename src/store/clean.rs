use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::claim::SOLVER_LOCK;
use super::{MARK, Store, StoreError, files};

/// A run that nothing needs any more.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Leftover {
    pub path: PathBuf,
    /// `unpublished` or `superseded`.
    pub what: &'static str,
    /// Its size on disk.
    pub bytes: u64,
    /// Somebody works on it: it stays.
    pub in_use: bool,
    id: String,
}

impl Store {
    /// Runs that were never published, and published runs that are not in `current`. Changes nothing.
    /// Those in `waiting` are in use: a job in a queue goes on with them.
    pub fn leftovers(
        &self,
        current: &BTreeSet<String>,
        waiting: &BTreeSet<String>,
    ) -> Result<Vec<Leftover>, StoreError> {
        let mut found = Vec::new();
        for name in entries(&self.root.join("runs"))? {
            let (id, what) = match name.split_once('.') {
                None if current.contains(&name) => continue,
                None => (name.as_str(), "superseded"),
                Some((id, "partial")) => (id, "unpublished"),
                Some((id, "replaced")) => (id, "superseded"),
                Some(_) => continue,
            };
            let path = self.root.join("runs").join(&name);
            found.push(Leftover {
                what,
                bytes: size(&path),
                in_use: waiting.contains(id)
                    || files::is_locked(&self.lock_path(id))
                    || files::is_locked(&path.join(SOLVER_LOCK)),
                id: id.to_owned(),
                path,
            });
        }
        Ok(found)
    }

    /// Removes the leftovers that nobody works on, what points at them, and what a killed process was just writing.
    pub fn clean(
        &self,
        current: &BTreeSet<String>,
        waiting: &BTreeSet<String>,
        cases: &BTreeSet<String>,
    ) -> Result<Vec<Leftover>, StoreError> {
        let mut leftovers = self.leftovers(current, waiting)?;
        for leftover in &mut leftovers {
            let lock = files::try_lock(&self.lock_path(&leftover.id))?;
            leftover.in_use =
                waiting.contains(&leftover.id) || lock.is_none() || files::is_locked(&leftover.path.join(SOLVER_LOCK));
            if !leftover.in_use {
                files::remove(&leftover.path)?;
            }
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
        Ok(leftovers)
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
