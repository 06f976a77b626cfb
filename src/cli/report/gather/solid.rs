//! Solids as the report wants them.

use crate::cli::specimen::solid::{kinds, notch};
use crate::report::CaseResult;
use crate::report::solid::Specimen;
use crate::setup::solid::Specimen as Laid;

/// Tells of the specimen of a solid.
pub fn tell(result: &mut CaseResult, laid: &Laid) {
    let solid = result.solid.get_or_insert_default();
    solid.specimen = Specimen {
        edges: laid.edges.iter().map(|(name, length)| (*name, length.actual)).collect(),
        kinds: kinds(laid),
        notch: notch(laid),
        held: laid.held.clone().unwrap_or_else(|| "nothing".to_owned()),
        loading: laid.loading.clone(),
        direction: laid.direction,
        nodes: laid.nodes,
        elements: laid.elements,
        atoms: laid.sites,
        leftover_share: laid.leftover_share,
        computation: laid.computation,
    };
}
