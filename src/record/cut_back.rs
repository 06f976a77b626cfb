//! A run that goes on from a checkpoint forgets what came after it.

use std::path::Path;

use super::pieces::{Pieces, SegmentPiece, remove};
use super::rows::Rows;
use super::segments::{read_segment, write_segment};
use super::{FIELDS_FILE, RecordError, SERIES_FILE, read_fields, series};

/// Keeps what was recorded up to `step` and removes what came after it; `None` removes everything recorded.
///
/// What a killed run was just writing goes in both cases. The checkpoint itself is not touched. A series or a
/// picture file that was published with later steps cannot be cut: that is a [`RecordError::Gap`].
pub fn cut_back<R: Rows>(dir: &Path, step: Option<u64>) -> Result<(), RecordError> {
    let pieces = Pieces::list(dir)?;
    remove(dir, &pieces.leftovers)?;
    let Some(step) = step else {
        remove(dir, &[dir.join(SERIES_FILE), dir.join(FIELDS_FILE)])?;
        remove(dir, pieces.frames.iter().map(|piece| &piece.path))?;
        return remove(dir, pieces.segments.iter().map(|piece| &piece.path));
    };
    for last in [last_published_probe(dir)?, last_published_frame(dir)?]
        .into_iter()
        .flatten()
    {
        if last > step {
            return Err(RecordError::gap(
                dir,
                format!("it was published up to step {last}, its checkpoint is of step {step}"),
            ));
        }
    }
    remove(
        dir,
        pieces
            .frames
            .iter()
            .filter(|piece| piece.step > step)
            .map(|piece| &piece.path),
    )?;
    for piece in pieces.segments.iter().filter(|piece| piece.last > step) {
        shorten::<R>(dir, piece, step)?;
    }
    Ok(())
}

/// Step of the last row of the published series; `None` if none is published.
pub(super) fn last_published_probe(dir: &Path) -> Result<Option<u64>, RecordError> {
    Ok(absent_is_none(series::last_step(&dir.join(SERIES_FILE)))?.flatten())
}

/// Step of the last published frame; `None` if none is published.
pub(super) fn last_published_frame(dir: &Path) -> Result<Option<u64>, RecordError> {
    let published = absent_is_none(read_fields::<[f64; 2]>(&dir.join(FIELDS_FILE)))?;
    Ok(published.and_then(|(_, frames)| frames.steps().last().copied()))
}

fn absent_is_none<T>(result: Result<T, RecordError>) -> Result<Option<T>, RecordError> {
    match result {
        Err(RecordError::Absent { .. }) => Ok(None),
        other => other.map(Some),
    }
}

/// Replaces a segment by its rows up to `step`. The shorter one is in place before the longer one goes.
fn shorten<R: Rows>(dir: &Path, piece: &SegmentPiece, step: u64) -> Result<(), RecordError> {
    if piece.first <= step {
        let (first_probe, mut part) = read_segment::<R>(&piece.path)?;
        let kept = part.steps().partition_point(|&row| row <= step);
        part.truncate(kept, first_probe);
        write_segment(dir, first_probe, &part)?;
    }
    remove(dir, [&piece.path])
}
