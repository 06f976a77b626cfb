//! The time series of a run that goes on: a small sealed file for every stretch between two checkpoints.

use std::path::Path;

use super::RecordError;
use super::arrays::{get_scalar, put_scalar};
use super::pieces::{Pieces, segment_path};
use super::rows::Rows;
use super::sealed::{self, Seal};

/// Writes the stretch of the series since the segment before, `first_probe` being the run's index of its first row.
///
/// The probes that the bond events name count from the start of the run. A stretch without a probe leaves no file.
pub fn write_segment(dir: &Path, first_probe: u64, part: &impl Rows) -> Result<(), RecordError> {
    let steps = part.steps();
    let (Some(&first), Some(&last)) = (steps.first(), steps.last()) else {
        return Ok(());
    };
    sealed::write(&segment_path(dir, first, last), SEGMENT, |group| {
        put_scalar(group, "first_probe", "1", first_probe)?;
        part.put(group)
    })
}

/// The series of the run so far, from its segments; empty if there are none.
pub fn read_segments<R: Rows>(dir: &Path) -> Result<R, RecordError> {
    let mut series = R::default();
    for piece in Pieces::list(dir)?.segments {
        let (first_probe, part) = read_segment(&piece.path)?;
        append(&mut series, first_probe, part).map_err(|what| RecordError::gap(&piece.path, what))?;
    }
    Ok(series)
}

/// First probe and rows of a segment.
pub(super) fn read_segment<R: Rows>(path: &Path) -> Result<(u64, R), RecordError> {
    let file = sealed::open(path, SEGMENT)?;
    let read = || Ok((get_scalar(&file, "first_probe")?, R::get(&file)?));
    read().map_err(|cause: hdf5::Error| RecordError::damaged(path, cause))
}

const SEGMENT: Seal = Seal {
    kind: "series-segment",
    format: 1,
    case_id: "",
};

fn append<R: Rows>(series: &mut R, first_probe: u64, part: R) -> Result<(), String> {
    let probes = series.steps().len();
    if first_probe != probes as u64 {
        return Err(format!(
            "it begins with probe {first_probe}, the segments before it end with {probes} probes"
        ));
    }
    series.append(part)
}
