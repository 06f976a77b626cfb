//! The file from which a run goes on.

mod slab;
mod solid;

use std::array;
use std::path::Path;

use hdf5::Group;

use super::RecordError;
use super::arrays::{Give, Packing, get, get_scalar, put, put_blocks, put_scalar};
use super::sealed::{self, Seal};
use crate::solver::checkpoint::Checkpoint;

/// What a kind of specimen keeps beside the motion of its nodes.
pub trait Keep: Sized {
    /// Writes it beside what all specimens have.
    fn put(&self, group: &Group) -> hdf5::Result<()>;
    /// Reads what [`Self::put`] wrote.
    fn get(group: &Group) -> hdf5::Result<Self>;
}

/// Replaces the checkpoint at `path`; the one before is there until the new one is safely on the disk.
pub fn write<K: Keep, const D: usize>(
    path: &Path,
    case_id: &str,
    checkpoint: &Checkpoint<K, D>,
) -> Result<(), RecordError> {
    let planes = [&checkpoint.position, &checkpoint.velocity];
    let plane = |number: usize| planes[number / D][number % D].as_slice();
    write_with(
        path,
        case_id,
        checkpoint,
        |number| plane(number).len(),
        |number, give| give(plane(number)),
    )
}

/// The same with planes of such lengths, those of the positions first, then those of the velocities. Each is asked for by its number
/// when the one before has been written, and given block by block.
pub fn write_with<K: Keep, const D: usize>(
    path: &Path,
    case_id: &str,
    checkpoint: &Checkpoint<K, D>,
    length: impl Fn(usize) -> usize,
    plane: impl FnMut(usize, Give<'_, f64>),
) -> Result<(), RecordError> {
    sealed::write(path, seal(case_id), |group| {
        put_checkpoint(group, checkpoint, length, plane)
    })
}

/// Reads what [`write`] wrote for the same case, every number to the bit.
pub fn read<K: Keep, const D: usize>(path: &Path, case_id: &str) -> Result<Checkpoint<K, D>, RecordError> {
    let file = sealed::open(path, seal(case_id))?;
    get_checkpoint(&file).map_err(|cause| RecordError::damaged(path, cause))
}

fn seal(case_id: &str) -> Seal<'_> {
    Seal {
        kind: "checkpoint",
        format: 10,
        case_id,
    }
}

fn get_planes<const D: usize>(group: &Group, name: &str) -> hdf5::Result<[Vec<f64>; D]> {
    let mut planes = array::from_fn(|_| Vec::new());
    for (axis, plane) in AXES.iter().zip(&mut planes) {
        *plane = get(group, &format!("{name}_{axis}"))?;
    }
    Ok(planes)
}

const AXES: [&str; 3] = ["x", "y", "z"];

fn put_checkpoint<K: Keep, const D: usize>(
    group: &Group,
    checkpoint: &Checkpoint<K, D>,
    length: impl Fn(usize) -> usize,
    mut plane: impl FnMut(usize, Give<'_, f64>),
) -> hdf5::Result<()> {
    // Taken apart by name, so that a new member cannot be forgotten here.
    let Checkpoint {
        step,
        time,
        time_step,
        step_after_next,
        longest_step,
        stability_limit,
        // Planes of their own.
        position: _,
        velocity: _,
        open_interfaces,
        start: [start_potential, start_pairs, start_kinetic],
        refined_energy,
        peak_work,
        peak_imbalance,
        closest_approach,
        probes,
        snapshots,
        looks,
        kept,
    } = checkpoint;
    for (first, name, unit) in [(0, "position", "nm"), (D, "velocity", "nm/ps")] {
        for (axis, letter) in AXES[..D].iter().enumerate() {
            put_blocks(
                group,
                &format!("{name}_{letter}"),
                unit,
                &[length(first + axis)],
                |give| {
                    plane(first + axis, give);
                },
            )?;
        }
    }
    let interfaces = [open_interfaces.len()];
    put(
        group,
        "open_interfaces",
        "1",
        &interfaces,
        open_interfaces,
        Packing::Plain,
    )?;
    for (name, count) in [
        ("step", step),
        ("probes", probes),
        ("snapshots", snapshots),
        ("looks", looks),
    ] {
        put_scalar(group, name, "1", *count)?;
    }
    for (name, unit, number) in [
        ("time", "ps", time),
        ("time_step", "ps", time_step),
        ("step_after_next", "ps", step_after_next),
        ("longest_step", "ps", longest_step),
        ("stability_limit", "ps", stability_limit),
        ("start_potential", "eV", start_potential),
        ("start_pairs", "1", start_pairs),
        ("start_kinetic", "eV", start_kinetic),
        ("refined_energy", "eV", refined_energy),
        ("peak_work", "eV", peak_work),
        ("peak_imbalance", "eV", peak_imbalance),
        ("closest_approach", "nm", closest_approach),
    ] {
        put_scalar(group, name, unit, *number)?;
    }
    kept.put(group)
}

fn get_checkpoint<K: Keep, const D: usize>(group: &Group) -> hdf5::Result<Checkpoint<K, D>> {
    Ok(Checkpoint {
        step: get_scalar(group, "step")?,
        time: get_scalar(group, "time")?,
        time_step: get_scalar(group, "time_step")?,
        step_after_next: get_scalar(group, "step_after_next")?,
        longest_step: get_scalar(group, "longest_step")?,
        stability_limit: get_scalar(group, "stability_limit")?,
        position: get_planes(group, "position")?,
        velocity: get_planes(group, "velocity")?,
        open_interfaces: get(group, "open_interfaces")?,
        start: [
            get_scalar(group, "start_potential")?,
            get_scalar(group, "start_pairs")?,
            get_scalar(group, "start_kinetic")?,
        ],
        refined_energy: get_scalar(group, "refined_energy")?,
        peak_work: get_scalar(group, "peak_work")?,
        peak_imbalance: get_scalar(group, "peak_imbalance")?,
        closest_approach: get_scalar(group, "closest_approach")?,
        probes: get_scalar(group, "probes")?,
        snapshots: get_scalar(group, "snapshots")?,
        looks: get_scalar(group, "looks")?,
        kept: K::get(group)?,
    })
}
