//! The runs of a study on disk: content-addressed, published by one rename, never edited afterwards.
//!
//! ```text
//! results/<study>/
//!   cases/<case>            points at the run of that case
//!   runs/<id>/              published: manifest.json is in it, and it is complete; damage.txt tells of a file that was
//!                           found to have changed since
//!   runs/<id>.partial/      at work, interrupted or failed
//!   .locks/<id>             locked while somebody works on the run
//!   .slurm/                 tickets and output of jobs, which are the business of `executor::slurm`
//! ```
//!
//! Only this module creates, renames and deletes run folders.

mod claim;
mod clean;
mod cost;
mod error;
mod files;
mod links;
mod manifest;
mod seal;
mod state;
mod verify;

pub use claim::{Claim, FolderLock};
pub use clean::Leftover;
pub use cost::{Account, Spent};
pub use error::StoreError;
pub use files::write;
pub use manifest::{Attempt, ExitState, Failure, Manifest, MessageCost, Outcome, Phase, Program, Reached, host};
pub use state::State;

use std::fs::{self, File};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::durable;

/// Layout of the folder; goes up when an older program would misread it.
const FORMAT: u32 = 1;

/// The file that tells it.
const MARK: &str = "store.json";

/// The results of one study.
#[derive(Clone, Debug)]
pub struct Store {
    root: PathBuf,
}

#[derive(Serialize, Deserialize)]
struct Format {
    format: u32,
}

impl Store {
    /// The store of `study` below `results`. Reads the format mark, if there is one, and writes nothing.
    pub fn open(results: &Path, study: &str) -> Result<Store, StoreError> {
        let store = Store {
            root: results.join(study),
        };
        let mark = store.mark();
        let text = match durable::read_to_string(&mark) {
            Ok(text) => text,
            // A file in the place of the folder is told by who wants to write there.
            Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => return Ok(store),
            Err(error) => return Err(StoreError::read(&mark)(error)),
        };
        match serde_json::from_str::<Format>(&text) {
            Ok(Format { format: FORMAT }) => Ok(store),
            Ok(Format { format }) => Err(StoreError::Format {
                path: mark,
                found: format.to_string(),
                known: FORMAT,
            }),
            Err(_) => Err(StoreError::Format {
                path: mark,
                found: "unknown".to_owned(),
                known: FORMAT,
            }),
        }
    }

    /// Makes the folders, so that an unwritable place is found before anything is computed.
    pub fn prepare(&self) -> Result<(), StoreError> {
        for folder in [
            self.root.clone(),
            self.root.join("runs"),
            self.root.join("cases"),
            self.root.join(".locks"),
        ] {
            fs::create_dir_all(&folder).map_err(StoreError::write(&folder))?;
        }
        let mark = self.mark();
        if mark.exists() {
            return Ok(());
        }
        files::write_json(&mark, &Format { format: FORMAT })
    }

    /// `results/<study>`
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Where a run lives once it is published.
    pub fn run_folder(&self, id: &str) -> PathBuf {
        self.root.join("runs").join(id)
    }

    /// Where a run is at work, or has been interrupted, or has failed.
    pub fn partial_folder(&self, id: &str) -> PathBuf {
        self.root.join("runs").join(format!("{id}.partial"))
    }

    /// Waits until nobody else writes tables, figures and report, and keeps others from it until the answer is dropped.
    pub fn lock_report(&self) -> Result<File, StoreError> {
        self.lock("report")
    }

    /// The same for handing cases over to a scheduler, so that none is handed over twice.
    pub fn lock_submission(&self) -> Result<File, StoreError> {
        self.lock("submission")
    }

    fn lock(&self, name: &str) -> Result<File, StoreError> {
        let path = self.lock_path(name);
        let file = files::open_lock(&path)?;
        file.lock().map_err(StoreError::write(&path))?;
        Ok(file)
    }

    fn replaced_folder(&self, id: &str) -> PathBuf {
        self.root.join("runs").join(format!("{id}.replaced"))
    }

    fn lock_path(&self, name: &str) -> PathBuf {
        self.root.join(".locks").join(name)
    }

    fn mark(&self) -> PathBuf {
        self.root.join(MARK)
    }
}
