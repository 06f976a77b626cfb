//! What would fall to each rank of a case if it had more of them.

use super::{SetupError, material, mesh_plan, refuse_what_does_not_fit};
use crate::domain::Burden;
use crate::forces;
use crate::mesh::Mesh;
use crate::study::Growth;
use crate::study::case::Case;

/// From three ranks on an inner one has all the neighbours that it will ever have, however wide the specimen becomes.
const ENOUGH: u32 = 3;

/// What falls to the busiest rank in a step, for several numbers of ranks. `case` is that of `ranks`; where it grows, its
/// rows of elements are what ranks get more of, so that three ranks show what any number does.
pub fn burdens(case: &Case, ranks: u32, growth: Growth, counts: &[u32]) -> Result<Vec<Burden>, SetupError> {
    match growth {
        Growth::Fixed => of(case, counts),
        Growth::Scaled => counts.iter().map(|&count| of_wider(case, ranks, count)).collect(),
    }
}

fn of_wider(case: &Case, ranks: u32, count: u32) -> Result<Burden, SetupError> {
    let shown = count.min(ENOUGH);
    let mut wider = case.clone();
    wider.specimen.width *= f64::from(shown) / f64::from(ranks);
    let shown_burden = of(&wider, &[shown])?[0];
    Ok(Burden {
        ranks: count,
        work: shown_burden.work * f64::from(shown) / f64::from(count),
        ..shown_burden
    })
}

fn of(case: &Case, counts: &[u32]) -> Result<Vec<Burden>, SetupError> {
    let material = material(case)?;
    let plan = mesh_plan(case, &material)?;
    refuse_what_does_not_fit(&plan)?;
    Ok(forces::burdens(&Mesh::new(&plan), &material, counts))
}
