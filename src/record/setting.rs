//! The group `setting` of a series file: what the analysis must know of the specimen and the material.

use hdf5::Group;

use super::arrays::{get_scalar, new_group, put_scalar};
use crate::analysis::series::{CrackFrom, Setting};

/// The right edge, from which a crack comes, and the middle of a notch that reaches no edge.
const RIGHT: &str = "crack_from_right_edge";
const CENTER: &str = "crack_center";

pub(super) fn put_setting(parent: &Group, setting: &Setting) -> hdf5::Result<()> {
    // Taken apart by name, so that a new member cannot be forgotten here.
    let Setting {
        spacing,
        length,
        left_x,
        height,
        crack_row,
        crack_from,
        crack_length,
        strain_rate,
        thickness,
        longitudinal_speed,
        transverse_speed,
        rayleigh_speed,
        young_modulus,
        poisson_ratio,
        fracture_energy,
        element_at_crack,
        nodes,
        elements,
        represented_atoms,
    } = setting;
    let group = new_group(parent, "setting")?;
    for (name, unit, number) in [
        ("spacing", "nm", spacing),
        ("length", "nm", length),
        ("left_x", "nm", left_x),
        ("height", "nm", height),
        ("crack_length", "nm", crack_length),
        ("strain_rate", "1/ps", strain_rate),
        ("thickness", "nm", thickness),
        ("longitudinal_speed", "nm/ps", longitudinal_speed),
        ("transverse_speed", "nm/ps", transverse_speed),
        ("rayleigh_speed", "nm/ps", rayleigh_speed),
        ("young_modulus", "eV/nm^2", young_modulus),
        ("poisson_ratio", "1", poisson_ratio),
        ("fracture_energy", "eV/nm", fracture_energy),
    ] {
        put_scalar(&group, name, unit, *number)?;
    }
    for (name, count) in [
        ("nodes", nodes),
        ("elements", elements),
        ("represented_atoms", represented_atoms),
    ] {
        put_scalar(&group, name, "1", *count)?;
    }
    put_scalar(&group, "element_at_crack", "1", *element_at_crack)?;
    // A crack from the left: no dataset.
    match crack_from {
        CrackFrom::Left => {}
        CrackFrom::Right { edge } => put_scalar(&group, RIGHT, "nm", *edge)?,
        CrackFrom::Inside { center } => put_scalar(&group, CENTER, "nm", *center)?,
    }
    // No crack: no dataset.
    crack_row.map_or(Ok(()), |row| put_scalar(&group, "crack_row", "1", row))
}

pub(super) fn get_setting(parent: &Group) -> hdf5::Result<Setting> {
    let group = &parent.group("setting")?;
    Ok(Setting {
        spacing: get_scalar(group, "spacing")?,
        length: get_scalar(group, "length")?,
        left_x: get_scalar(group, "left_x")?,
        height: get_scalar(group, "height")?,
        crack_row: group
            .link_exists("crack_row")
            .then(|| get_scalar(group, "crack_row"))
            .transpose()?,
        crack_from: get_crack_from(group)?,
        crack_length: get_scalar(group, "crack_length")?,
        strain_rate: get_scalar(group, "strain_rate")?,
        thickness: get_scalar(group, "thickness")?,
        longitudinal_speed: get_scalar(group, "longitudinal_speed")?,
        transverse_speed: get_scalar(group, "transverse_speed")?,
        rayleigh_speed: get_scalar(group, "rayleigh_speed")?,
        young_modulus: get_scalar(group, "young_modulus")?,
        poisson_ratio: get_scalar(group, "poisson_ratio")?,
        fracture_energy: get_scalar(group, "fracture_energy")?,
        element_at_crack: get_scalar(group, "element_at_crack")?,
        nodes: get_scalar(group, "nodes")?,
        elements: get_scalar(group, "elements")?,
        represented_atoms: get_scalar(group, "represented_atoms")?,
    })
}

/// Runs of older versions have cracks from the left alone.
fn get_crack_from(group: &Group) -> hdf5::Result<CrackFrom> {
    if group.link_exists(RIGHT) {
        let edge = get_scalar(group, RIGHT)?;
        return Ok(CrackFrom::Right { edge });
    }
    if group.link_exists(CENTER) {
        let center = get_scalar(group, CENTER)?;
        return Ok(CrackFrom::Inside { center });
    }
    Ok(CrackFrom::Left)
}
