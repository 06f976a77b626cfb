//! What would fall to each rank of a case if it had more of them.

use super::estimate::refuse_what_does_not_fit;
use super::{material, mesh_plan};
use crate::domain::Burden;
use crate::forces;
use crate::mesh::Mesh;
use crate::setup::SetupError;
use crate::study::Growth;
use crate::study::case::{Slab, Until};

/// From three ranks on an inner one has all the neighbours that it will ever have, however wide the specimen becomes.
const ENOUGH: u32 = 3;

/// What falls to the busiest rank in a step, for several numbers of ranks. `slab` is that of `ranks`; where it grows, its
/// rows of elements are what ranks get more of, so that three ranks show what any number does.
pub fn burdens(
    slab: &Slab,
    until: &Until,
    ranks: u32,
    growth: Growth,
    counts: &[u32],
) -> Result<Vec<Burden>, SetupError> {
    if growth == Growth::Fixed {
        return of(slab, until, counts);
    }
    let of_width = |count: u32| {
        let mut wider = slab.clone();
        wider.specimen.width *= f64::from(count) / f64::from(ranks);
        Ok(of(&wider, until, &[count])?[0])
    };
    let shown: Vec<Burden> = (1..=ENOUGH).map(of_width).collect::<Result<_, SetupError>>()?;
    let of_count = |&count: &u32| {
        let alike = shown[(count.clamp(1, ENOUGH) - 1) as usize];
        Burden {
            ranks: count,
            work: alike.work * f64::from(alike.ranks) / f64::from(count),
            ..alike
        }
    };
    Ok(counts.iter().map(of_count).collect())
}

fn of(slab: &Slab, until: &Until, counts: &[u32]) -> Result<Vec<Burden>, SetupError> {
    let material = material(slab)?;
    let plan = mesh_plan(slab, until, &material)?;
    refuse_what_does_not_fit(&plan, 1)?;
    Ok(forces::burdens(&Mesh::new(&plan), &material, counts))
}
