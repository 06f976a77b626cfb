//! Pieces of a run that goes on: series segments and frames, each a small sealed file.

use std::path::Path;

use hdf5::Group;

use super::RecordError;
use super::arrays::{Packing, get_column, get_rows, get_scalar, put, put_scalar};
use super::frames::Frame;
use super::pieces::{Pieces, frame_path, segment_path};
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

/// Writes one picture of the run.
pub fn write_frame(dir: &Path, frame: &Frame) -> Result<(), RecordError> {
    sealed::write(&frame_path(dir, frame.step), FRAME, |group| put_frame(group, frame))
}

pub(super) fn read_frame(path: &Path) -> Result<Frame, RecordError> {
    let file = sealed::open(path, FRAME)?;
    get_frame(&file).map_err(|cause| RecordError::damaged(path, cause))
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
const FRAME: Seal = Seal {
    kind: "frame",
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
    series.profile_x = part.profile_x;
    series.probes.append(&mut part.probes);
    series.profiles.append(&mut part.profiles);
    series.bonds.append(&mut part.bonds);
    Ok(())
}

fn put_frame(group: &Group, frame: &Frame) -> hdf5::Result<()> {
    let Frame {
        step,
        time,
        strain,
        displacement,
        velocity,
        stress,
        damage,
    } = frame;
    put_scalar(group, "step", "1", *step)?;
    put_scalar(group, "time", "ps", *time)?;
    put_scalar(group, "strain", "1", *strain)?;
    let (nodes, cells) = (displacement.len(), stress.len());
    put(
        group,
        "displacement",
        "nm",
        &[nodes, 2],
        displacement.as_flattened(),
        Packing::Plain,
    )?;
    put(
        group,
        "velocity",
        "nm/ps",
        &[nodes, 2],
        velocity.as_flattened(),
        Packing::Plain,
    )?;
    put(
        group,
        "stress",
        "eV/nm^3",
        &[cells, 3],
        stress.as_flattened(),
        Packing::Plain,
    )?;
    put(group, "damage", "1", &[cells], damage, Packing::Plain)
}

fn get_frame(group: &Group) -> hdf5::Result<Frame> {
    let stress: Vec<[f64; 3]> = get_rows(group, "stress")?;
    Ok(Frame {
        step: get_scalar(group, "step")?,
        time: get_scalar(group, "time")?,
        strain: get_scalar(group, "strain")?,
        displacement: get_rows(group, "displacement")?,
        velocity: get_rows(group, "velocity")?,
        damage: get_column(group, "damage", stress.len())?,
        stress,
    })
}
