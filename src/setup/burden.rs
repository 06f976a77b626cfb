//! What would fall to each rank of a case if it had more of them.

use super::{SetupError, slab, solid};
use crate::domain::Burden;
use crate::study::Growth;
use crate::study::case::{Body, Case};

/// From three ranks on an inner one has all the neighbours that it will ever have, however large the specimen becomes.
const ENOUGH: u32 = 3;

/// What falls to the busiest rank in a step, for several numbers of ranks. The case is that of `ranks`; where it grows, ranks
/// get more rows of elements, or more blocks along a3, so that three ranks show what any number does. Empty where it cannot be
/// told.
pub fn burdens(case: &Case, ranks: u32, growth: Growth, counts: &[u32]) -> Result<Vec<Burden>, SetupError> {
    let grown = |times: f64, counts: &[u32]| match &case.body {
        Body::Slab(one) => slab::burden::burdens(one, &case.run.until, times, counts),
        Body::Solid(one) => solid::burden::burdens(one, times, counts),
    };
    if growth == Growth::Fixed {
        return grown(1.0, counts);
    }
    let mut shown = Vec::new();
    for count in 1..=ENOUGH {
        let Some(&burden) = grown(f64::from(count) / f64::from(ranks), &[count])?.first() else {
            return Ok(Vec::new());
        };
        shown.push(burden);
    }
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
