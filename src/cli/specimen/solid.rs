//! Solids in words.

use serde_json::{Value, json};

use super::{MANY_LEFTOVERS, NOTABLE, digits, size};
use crate::cli::format;
use crate::plan::PlannedCase;
use crate::setup::Size;
use crate::setup::solid::{Kind, Specimen};
use crate::units::EV_PER_NM3_SQRT_NM_IN_MPA_SQRT_M;

pub const HEAD: [&str; 9] = [
    "case",
    "blocks",
    "edges",
    "notch",
    "K / Griffith",
    "held",
    "loading",
    "elements by kind",
    "left over",
];

/// What the heads of the columns have no room for.
pub const NOTES: &str = "edges: along the axes of the solid, nm
K / Griffith: MPa √m of a severed plane as an edge crack in a long strip under its stress at rest, F σ √(πa) with the handbook
  factor, and over the K at which it releases what its surfaces cost
elements by kind: their number, and cells per edge of the block that they are a part of
left over: share of the atoms in smaller elements than asked for, because no larger one fits there
";

pub fn row(planned: &PlannedCase, specimen: &Specimen) -> Vec<String> {
    let blocks = specimen
        .blocks
        .map(|blocks| blocks.map(|number| number.to_string()).join(" x "));
    let edges = specimen.edges.each_ref().map(|(_, length)| digits(length.actual));
    vec![
        planned.name.clone(),
        blocks.unwrap_or_else(|| "-".to_owned()),
        edges.join(" x "),
        notch(specimen),
        intensity(specimen).unwrap_or_else(|| "-".to_owned()),
        specimen.held.clone().unwrap_or_else(|| "-".to_owned()),
        specimen.loading.clone(),
        kinds(specimen),
        specimen.leftover_share.map_or_else(|| "-".to_owned(), format::share),
    ]
}

/// `10,368 octahedra of 10, 20,736 tetrahedra of 10, 80 atoms`
pub fn kinds(specimen: &Specimen) -> String {
    let told = specimen.kinds.iter().map(|kind| {
        let name = plural(kind);
        match kind.size {
            1 => format!("{} {name}", kind.number),
            size => format!("{} {name} of {size}", kind.number),
        }
    });
    told.collect::<Vec<_>>().join(", ")
}

fn plural(kind: &Kind) -> &'static str {
    match (kind.name, kind.number) {
        (name, 1) => name,
        ("tetrahedron", _) => "tetrahedra",
        ("octahedron", _) => "octahedra",
        _ => "atoms",
    }
}

pub fn notch(specimen: &Specimen) -> String {
    match (specimen.slot, specimen.severed) {
        (Some(blocks), _) => format!("{blocks} blocks out"),
        (None, Some([depth, at])) => format!("severed {} deep at {}", size(depth), size(at)),
        (None, None) => "none".to_owned(),
    }
}

/// `1.21 / 1.16`: K in MPa √m, and over that of Griffith.
pub fn intensity(specimen: &Specimen) -> Option<String> {
    let told = specimen.intensity?;
    Some(format!(
        "{} / {}",
        digits(told.k * EV_PER_NM3_SQRT_NM_IN_MPA_SQRT_M),
        digits(told.k / told.griffith)
    ))
}

pub fn to_json(specimen: &Specimen) -> Value {
    let pair = |size: Size| json!({ "asked": size.asked, "actual": size.actual });
    let edges = specimen
        .edges
        .iter()
        .map(|(name, length)| (format!("{name}_nm"), json!(length.actual)));
    let kinds = specimen.kinds.iter().map(|kind| {
        json!({ "kind": kind.name, "cells_per_edge": kind.size, "number": kind.number, "nodes": kind.number * kind.nodes_each,
                "atoms": kind.number * kind.sites_each })
    });
    json!({
        "blocks": specimen.blocks,
        "edges": edges.collect::<serde_json::Map<_, _>>(),
        "blocks_left_out": specimen.slot,
        "severed_depth_nm": specimen.severed.map(|severed| pair(severed[0])),
        "severed_at_nm": specimen.severed.map(|severed| pair(severed[1])),
        "k_at_rest_mpa_sqrt_m": specimen.intensity.map(|told| told.k * EV_PER_NM3_SQRT_NM_IN_MPA_SQRT_M),
        "k_griffith_mpa_sqrt_m": specimen.intensity.map(|told| told.griffith * EV_PER_NM3_SQRT_NM_IN_MPA_SQRT_M),
        "held": specimen.held,
        "loading": specimen.loading,
        "kinds": kinds.collect::<Vec<Value>>(),
    })
}

/// What is to be known of one that is not what was asked for.
pub fn warnings(specimen: &Specimen) -> Vec<String> {
    let moved = specimen
        .severed
        .filter(|severed| severed.iter().any(|size| size.error().abs() > NOTABLE));
    let moved = moved.map(|[depth, at]| {
        format!(
            "along borders of elements, the severed plane lies at {} nm instead of {} nm and is {} nm deep instead of {} nm",
            digits(at.actual),
            digits(at.asked),
            digits(depth.actual),
            digits(depth.asked)
        )
    });
    let share = specimen.leftover_share.filter(|&share| share > MANY_LEFTOVERS);
    let leftover = share.map(|share| {
        format!(
            "{} of the atoms are in smaller elements than asked for: take smaller elements, a larger specimen, or a \
             `specimen.block` that they fit",
            format::share(share)
        )
    });
    moved.into_iter().chain(leftover).collect()
}
