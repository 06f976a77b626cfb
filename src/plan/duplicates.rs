//! Cases of a sweep that are the same under several names.

use std::collections::HashMap;

use super::PlannedCase;
use crate::study::{Finding, Findings, Place};

/// Where a planned case comes from: the name that the sweep started from, and its place.
pub type Origin = (String, Place);

/// Refuses cases that a sweep makes from one case and that are the same. Cases that are named are named on purpose.
pub fn refuse(cases: &[PlannedCase], origins: &[Origin], findings: &Findings) {
    let mut seen = HashMap::new();
    for (case, (origin, place)) in cases.iter().zip(origins) {
        let (first, first_place) = *seen.entry((case.id.to_string(), origin)).or_insert((case, *place));
        // Equal names are refused as such.
        if first.name == case.name {
            continue;
        }
        let message = format!("`{}` and `{}` are the same case under two names", first.name, case.name);
        findings.add(
            Finding::at(*place, message)
                .with(first_place, "the other one")
                .help("remove one of them; ranks and threads make other cases only where `report` asks for `scaling`"),
        );
    }
}
