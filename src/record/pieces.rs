//! The pieces of a run that goes on: their names in the run's folder, and their removal.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::aside::ASIDE;
use super::{CHECKPOINT_FILE, FIELDS_FILE, RecordError, SERIES_FILE};
use crate::durable;

/// Everything in a run's folder that is not there to stay, in order of steps.
#[derive(Default)]
pub(super) struct Pieces {
    pub segments: Vec<SegmentPiece>,
    pub frames: Vec<FramePiece>,
    /// Files that were being written when a run was killed.
    pub leftovers: Vec<PathBuf>,
}

pub(super) struct SegmentPiece {
    /// Steps of its first and last probe.
    pub first: u64,
    pub last: u64,
    pub path: PathBuf,
}

pub(super) struct FramePiece {
    pub step: u64,
    pub path: PathBuf,
}

// Sixteen digits, so that names sort by step for the first 10^16 steps.
pub(super) fn segment_path(dir: &Path, first: u64, last: u64) -> PathBuf {
    dir.join(format!("series-{first:016}-{last:016}.h5"))
}

pub(super) fn frame_path(dir: &Path, step: u64) -> PathBuf {
    dir.join(format!("frame-{step:016}.h5"))
}

impl Pieces {
    pub(super) fn list(dir: &Path) -> Result<Pieces, RecordError> {
        let reading = |cause| RecordError::reading(dir, &cause);
        let mut pieces = Pieces::default();
        for entry in fs::read_dir(dir).map_err(reading)? {
            let path = entry.map_err(reading)?.path();
            // Our names are ASCII; any other belongs to somebody else.
            if let Some(name) = path.file_name().and_then(|name| name.to_str()).map(str::to_owned) {
                pieces.add(&name, path);
            }
        }
        pieces.segments.sort_by_key(|piece| (piece.first, piece.last));
        pieces.frames.sort_by_key(|piece| piece.step);
        Ok(pieces)
    }

    fn add(&mut self, name: &str, path: PathBuf) {
        if let Some(name) = name.strip_suffix(ASIDE) {
            let published = [CHECKPOINT_FILE, SERIES_FILE, FIELDS_FILE].contains(&name);
            if published || segment_steps(name).is_some() || frame_step(name).is_some() {
                self.leftovers.push(path);
            }
        } else if let Some((first, last)) = segment_steps(name) {
            self.segments.push(SegmentPiece { first, last, path });
        } else if let Some(step) = frame_step(name) {
            self.frames.push(FramePiece { step, path });
        }
    }
}

/// Removes files, absent ones included, and makes that durable.
pub(super) fn remove<'a>(dir: &Path, paths: impl IntoIterator<Item = &'a PathBuf>) -> Result<(), RecordError> {
    for path in paths {
        match fs::remove_file(path) {
            Err(cause) if cause.kind() != ErrorKind::NotFound => return Err(RecordError::cannot_write(path, cause)),
            _ => {}
        }
    }
    durable::sync(dir).map_err(|cause| RecordError::cannot_write(dir, cause))
}

fn segment_steps(name: &str) -> Option<(u64, u64)> {
    let (first, last) = name.strip_prefix("series-")?.strip_suffix(".h5")?.split_once('-')?;
    Some((first.parse().ok()?, last.parse().ok()?))
}

fn frame_step(name: &str) -> Option<u64> {
    name.strip_prefix("frame-")?.strip_suffix(".h5")?.parse().ok()
}
