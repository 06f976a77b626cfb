//! What would fall to each rank of a slab.

use super::estimate::refuse_what_does_not_fit;
use super::{material, mesh_plan};
use crate::domain::Burden;
use crate::forces;
use crate::mesh::Mesh;
use crate::setup::SetupError;
use crate::study::case::{Slab, Until};

/// What falls to the busiest rank of a slab that is so many times as wide.
pub fn burdens(slab: &Slab, until: &Until, times: f64, counts: &[u32]) -> Result<Vec<Burden>, SetupError> {
    let mut slab = slab.clone();
    slab.specimen.width *= times;
    let material = material(&slab)?;
    let plan = mesh_plan(&slab, until, &material)?;
    refuse_what_does_not_fit(&plan, 1)?;
    Ok(forces::burdens(&Mesh::new(&plan), &material, counts))
}
