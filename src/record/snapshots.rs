//! The pictures of a run that goes on: a small sealed file each, in full precision and internal units.

use std::path::Path;

use hdf5::Group;

use super::RecordError;
use super::arrays::{Packing, get_column, get_rows, get_scalar, put, put_scalar};
use super::frames::Frame;
use super::pieces::frame_path;
use super::sealed::{self, Seal};

/// Writes one picture of the run.
pub fn write_frame(dir: &Path, frame: &Frame) -> Result<(), RecordError> {
    sealed::write(&frame_path(dir, frame.step), FRAME, |group| put_frame(group, frame))
}

pub(super) fn read_frame(path: &Path) -> Result<Frame, RecordError> {
    let file = sealed::open(path, FRAME)?;
    get_frame(&file).map_err(|cause| RecordError::damaged(path, cause))
}

const FRAME: Seal = Seal {
    kind: "frame",
    format: 1,
    case_id: "",
};

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
