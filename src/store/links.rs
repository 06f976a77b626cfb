//! `cases/<case>`: the run of each case under the name a person knows.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};

use super::{Store, StoreError, files};

impl Store {
    /// Points `cases/<case>` at its published run, in one step.
    pub fn link(&self, case: &str, id: &str) -> Result<(), StoreError> {
        let link = self.case_link(case);
        let target = Path::new("../runs").join(id);
        if fs::read_link(&link).is_ok_and(|old| old == target) {
            return Ok(());
        }
        let aside = self.root.join("cases").join(format!(".{case}.{}", std::process::id()));
        files::remove(&aside)?;
        symlink(&target, &aside).map_err(StoreError::write(&aside))?;
        fs::rename(&aside, &link).map_err(StoreError::write(&link))
    }

    /// The run that a case pointed at when it was last done.
    pub fn linked(&self, case: &str) -> Option<String> {
        let target = fs::read_link(self.case_link(case)).ok()?;
        Some(target.file_name()?.to_str()?.to_owned())
    }

    pub(super) fn case_link(&self, case: &str) -> PathBuf {
        self.root.join("cases").join(case)
    }
}
