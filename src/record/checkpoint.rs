//! The file from which a run goes on.

use std::path::Path;

use hdf5::Group;

use super::RecordError;
use super::arrays::{Packing, get, get_rows, get_scalar, new_group, put, put_scalar};
use super::bonds::{get_bonds, put_bonds};
use super::sealed::{self, Seal};
use crate::solver::checkpoint::Checkpoint;

/// Replaces the checkpoint at `path`; the one before is there until the new one is safely on the disk.
pub fn write(path: &Path, case_id: &str, checkpoint: &Checkpoint) -> Result<(), RecordError> {
    sealed::write(path, seal(case_id), |group| put_checkpoint(group, checkpoint))
}

/// Reads what [`write`] wrote for the same case, every number to the bit.
pub fn read(path: &Path, case_id: &str) -> Result<Checkpoint, RecordError> {
    let file = sealed::open(path, seal(case_id))?;
    get_checkpoint(&file).map_err(|cause| RecordError::damaged(path, cause))
}

fn seal(case_id: &str) -> Seal<'_> {
    Seal {
        kind: "checkpoint",
        format: 7,
        case_id,
    }
}

fn put_checkpoint(group: &Group, checkpoint: &Checkpoint) -> hdf5::Result<()> {
    // Taken apart by name, so that a new member cannot be forgotten here.
    let Checkpoint {
        step,
        time,
        time_step,
        stability_limit,
        position: [position_x, position_y],
        velocity: [velocity_x, velocity_y],
        open_interfaces,
        start: [start_potential, start_pairs, start_kinetic],
        grip_impulses,
        absorbed,
        peak_work,
        peak_imbalance,
        broken_bonds,
        parted_bonds,
        joins,
        probes,
        snapshots,
        last_advance,
        farthest_tip,
        damage_front,
        branched,
        left_plane,
    } = checkpoint;
    for (name, unit, numbers) in [
        ("position_x", "nm", position_x),
        ("position_y", "nm", position_y),
        ("velocity_x", "nm/ps", velocity_x),
        ("velocity_y", "nm/ps", velocity_y),
        ("grip_impulses", "eV ps/nm", grip_impulses),
        ("absorbed", "eV", absorbed),
    ] {
        put(group, name, unit, &[numbers.len()], numbers, Packing::Plain)?;
    }
    for (name, numbers) in [("open_interfaces", open_interfaces), ("joins", joins)] {
        put(group, name, "1", &[numbers.len()], numbers, Packing::Plain)?;
    }
    let broken = broken_bonds.as_flattened();
    put(
        group,
        "broken_bonds",
        "1",
        &[broken_bonds.len(), 3],
        broken,
        Packing::Plain,
    )?;
    put_bonds(&new_group(group, "parted_bonds")?, parted_bonds)?;
    for (name, count) in [("step", step), ("probes", probes), ("snapshots", snapshots)] {
        put_scalar(group, name, "1", *count)?;
    }
    for (name, unit, number) in [
        ("time", "ps", time),
        ("time_step", "ps", time_step),
        ("stability_limit", "ps", stability_limit),
        ("start_potential", "eV", start_potential),
        ("start_pairs", "1", start_pairs),
        ("start_kinetic", "eV", start_kinetic),
        ("peak_work", "eV", peak_work),
        ("peak_imbalance", "eV", peak_imbalance),
        ("last_advance", "ps", last_advance),
        ("farthest_tip", "nm", farthest_tip),
        ("damage_front", "nm", damage_front),
        ("branched", "ps", branched),
        ("left_plane", "ps", left_plane),
    ] {
        put_scalar(group, name, unit, *number)?;
    }
    Ok(())
}

fn get_checkpoint(group: &Group) -> hdf5::Result<Checkpoint> {
    Ok(Checkpoint {
        step: get_scalar(group, "step")?,
        time: get_scalar(group, "time")?,
        time_step: get_scalar(group, "time_step")?,
        stability_limit: get_scalar(group, "stability_limit")?,
        position: [get(group, "position_x")?, get(group, "position_y")?],
        velocity: [get(group, "velocity_x")?, get(group, "velocity_y")?],
        open_interfaces: get(group, "open_interfaces")?,
        start: [
            get_scalar(group, "start_potential")?,
            get_scalar(group, "start_pairs")?,
            get_scalar(group, "start_kinetic")?,
        ],
        grip_impulses: get(group, "grip_impulses")?,
        absorbed: get(group, "absorbed")?,
        peak_work: get_scalar(group, "peak_work")?,
        peak_imbalance: get_scalar(group, "peak_imbalance")?,
        broken_bonds: get_rows(group, "broken_bonds")?,
        parted_bonds: get_bonds(&group.group("parted_bonds")?)?,
        joins: get(group, "joins")?,
        probes: get_scalar(group, "probes")?,
        snapshots: get_scalar(group, "snapshots")?,
        last_advance: get_scalar(group, "last_advance")?,
        farthest_tip: get_scalar(group, "farthest_tip")?,
        damage_front: get_scalar(group, "damage_front")?,
        branched: get_scalar(group, "branched")?,
        left_plane: get_scalar(group, "left_plane")?,
    })
}
