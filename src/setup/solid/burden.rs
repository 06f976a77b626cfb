//! What would fall to each rank of a solid.

use super::{estimate, lay_out, material, specimen};
use crate::domain::Burden;
use crate::forces;
use crate::mesh::solid::Solid as Mesh;
use crate::setup::SetupError;
use crate::study::case::Solid;
use crate::study::case::solid::Shape;

/// What falls to the busiest rank of a solid of blocks that is so many times as long along a3; empty where it has atoms, or is
/// none of blocks.
pub fn burdens(solid: &Solid, times: f64, counts: &[u32]) -> Result<Vec<Burden>, SetupError> {
    let Shape::Blocks([first, second, third]) = solid.specimen.shape else {
        return Ok(Vec::new());
    };
    let mut solid = solid.clone();
    let grown = (f64::from(third) * times).round() as u32;
    solid.specimen.shape = Shape::Blocks([first, second, grown]);
    let material = material(&solid)?;
    let laid = lay_out(&solid, material.spacing)?;
    estimate::refuse_what_does_not_fit(specimen::site_count(&laid.plan), solid.resolution.element, 1)?;
    let mesh = Mesh::new(&laid.plan);
    match mesh.atom_count() {
        0 => Ok(forces::solid::burdens(&mesh, &material, counts)),
        _ => Ok(Vec::new()),
    }
}
