//! The time series of a run that goes on: a small sealed file for every stretch between two checkpoints.

use std::path::Path;

use super::RecordError;
use super::arrays::{get_scalar, put_scalar};
use super::pieces::{Pieces, segment_path};
use super::sealed::{self, Seal};
use super::series::{get_series, put_series};
use crate::analysis::series::Series;

/// Writes the stretch of the series since the segment before, `first_probe` being the run's index of its first row.
///
/// The probes that the bond events name count from the start of the run. A stretch without a probe leaves no file.
pub fn write_segment(dir: &Path, first_probe: u64, part: &Series) -> Result<(), RecordError> {
    let (Some(first), Some(last)) = (part.probes.first(), part.probes.last()) else {
        return Ok(());
    };
    sealed::write(&segment_path(dir, first.step, last.step), SEGMENT, |group| {
        put_scalar(group, "first_probe", "1", first_probe)?;
        put_series(group, part)
    })
}

/// The series of the run so far, from its segments; empty if there are none.
pub fn read_segments(dir: &Path) -> Result<Series, RecordError> {
    let mut series = Series::default();
    for piece in Pieces::list(dir)?.segments {
        let (first_probe, part) = read_segment(&piece.path)?;
        append(&mut series, first_probe, part).map_err(|what| RecordError::gap(&piece.path, what))?;
    }
    Ok(series)
}

/// First probe and rows of a segment.
pub(super) fn read_segment(path: &Path) -> Result<(u64, Series), RecordError> {
    let file = sealed::open(path, SEGMENT)?;
    let read = || Ok((get_scalar(&file, "first_probe")?, get_series(&file)?));
    read().map_err(|cause: hdf5::Error| RecordError::damaged(path, cause))
}

const SEGMENT: Seal = Seal {
    kind: "series-segment",
    format: 1,
    case_id: "",
};

fn append(series: &mut Series, first_probe: u64, mut part: Series) -> Result<(), String> {
    let probes = series.probes.len();
    if first_probe != probes as u64 {
        return Err(format!(
            "it begins with probe {first_probe}, the segments before it end with {probes} probes"
        ));
    }
    if probes > 0 && part.profile_x != series.profile_x {
        return Err("the bins of its profiles are not those of the segments before it".to_owned());
    }
    if probes > 0 && part.gauge_places != series.gauge_places {
        return Err("its wave gauges do not stand where those of the segments before it do".to_owned());
    }
    series.profile_x = part.profile_x;
    series.gauge_places = part.gauge_places;
    append_all(&mut series.probes, &mut part.probes);
    append_all(&mut series.profiles, &mut part.profiles);
    append_all(&mut series.tractions, &mut part.tractions);
    append_all(&mut series.gauges, &mut part.gauges);
    append_all(&mut series.bonds, &mut part.bonds);
    Ok(())
}

/// With no more memory than the rows need: the profiles of a long run are large.
fn append_all<T>(rows: &mut Vec<T>, more: &mut Vec<T>) {
    rows.reserve_exact(more.len());
    rows.append(more);
}
