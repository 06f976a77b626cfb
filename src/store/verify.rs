//! Whether published files still hold what was published.
//!
//! Sizes are compared whenever somebody asks for a state; content only here, because pictures may be gigabytes. What is
//! found to be damaged is remembered beside the manifest, so that the next run of the study computes the case again.

use std::path::PathBuf;

use super::{Manifest, State, Store, files};
use crate::durable;

/// Says what is damaged; goes with the folder when a new run takes its place.
const DAMAGE: &str = "damage.txt";

impl Store {
    /// State of a run; if it is published, after every file of it was read and compared with its checksum.
    pub fn verified_state(&self, id: &str) -> State {
        if !self.run_folder(id).exists() {
            return self.state(id);
        }
        // Nobody may replace the run meanwhile. Where no lock can be made, nobody can replace it either.
        let lock = files::try_lock(&self.lock_path(id));
        if matches!(lock, Ok(None)) {
            return self.state(id);
        }
        let manifest = match self.manifest(id) {
            Ok(manifest) => manifest,
            Err(why) => return State::Corrupt { why },
        };
        match self.first_damaged(&manifest) {
            None => {
                // What was damaged may have come back from a copy.
                let _ = files::remove(&self.damage(id));
                State::Done(Box::new(manifest))
            }
            Some(why) => {
                // Where this cannot be written, the damage is found again next time.
                let _ = files::write(&self.damage(id), why.as_bytes());
                State::Corrupt { why }
            }
        }
    }

    /// What an earlier look at the content of a run has found.
    pub(super) fn known_damage(&self, id: &str) -> Option<String> {
        durable::read_to_string(&self.damage(id)).ok()
    }

    fn first_damaged(&self, manifest: &Manifest) -> Option<String> {
        let folder = self.run_folder(&manifest.id);
        let is_damaged = |(name, published): (&String, &String)| match files::checksum(&folder.join(name)) {
            Ok(found) if found == *published => None,
            Ok(_) => Some(format!("{name} no longer holds what was published")),
            Err(error) => Some(format!("{name} cannot be read ({error})")),
        };
        manifest.blake3.iter().find_map(is_damaged)
    }

    fn damage(&self, id: &str) -> PathBuf {
        self.run_folder(id).join(DAMAGE)
    }
}
