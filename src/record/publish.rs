//! The pieces of a finished run become the files that stay.
//!
//! The pieces go only when the assembled file is complete and in place, so a kill at any moment is cured by
//! calling again.

use std::path::{Path, PathBuf};

use super::cut_back::{last_published_frame, last_published_probe};
use super::frames::{FieldMesh, Vector};
use super::pieces::{Pieces, remove};
use super::rows::Described;
use super::segments::read_segments;
use super::series::write_series;
use super::{FIELDS_FILE, RecordError, SERIES_FILE, aside, fields};

/// Makes [`SERIES_FILE`] of the segments in `dir`, then removes them.
pub fn publish_series<S: Described>(dir: &Path, case_id: &str, setting: &S) -> Result<(), RecordError> {
    let segments = Pieces::list(dir)?.segments;
    let path = dir.join(SERIES_FILE);
    if is_there(&path)? {
        nothing_newer(
            &path,
            segments.last().map(|piece| piece.last),
            last_published_probe(dir)?,
        )?;
    } else {
        write_series(&path, case_id, setting, &read_segments(dir)?)?;
    }
    remove(dir, segments.iter().map(|piece| &piece.path))
}

/// Makes [`FIELDS_FILE`] of the frames in `dir`, one frame in memory at a time, then removes them.
///
/// A run without frames gets no such file.
pub fn publish_fields<V: Vector>(dir: &Path, case_id: &str, mesh: &FieldMesh<V>) -> Result<(), RecordError> {
    let frames = Pieces::list(dir)?.frames;
    let path = dir.join(FIELDS_FILE);
    if is_there(&path)? {
        nothing_newer(&path, frames.last().map(|piece| piece.step), last_published_frame(dir)?)?;
    } else if !frames.is_empty() {
        aside::replace(&path, |aside| fields::assemble(aside, case_id, mesh, &frames))?;
    }
    remove(dir, frames.iter().map(|piece| &piece.path))
}

/// Pieces may be removed only if the published file reaches as far as they do.
fn nothing_newer(path: &Path, piece: Option<u64>, published: Option<u64>) -> Result<(), RecordError> {
    if piece <= published {
        return Ok(());
    }
    let what = "there are pieces of later steps than those it was published with";
    Err(RecordError::Gap {
        path: PathBuf::from(path),
        what: what.to_owned(),
    })
}

fn is_there(path: &Path) -> Result<bool, RecordError> {
    path.try_exists().map_err(|cause| RecordError::cannot_read(path, cause))
}
