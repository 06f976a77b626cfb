//! What is allowed and should be known before a case is computed.

use super::intervals::between_pictures;
use super::slab::material;
use super::solid;
use crate::study::case::{Body, Case, Loading, Slab, Summation};

/// A sheet of atoms is about as thick as its atoms are apart; thicker or thinner than this many times, it is a slip of a unit.
const UNLIKELY_THICKNESS: f64 = 20.0;

/// Sentences about what a case has chosen, whose run takes about `time` (ps).
pub fn cautions(case: &Case, time: f64) -> Vec<String> {
    let own = match &case.body {
        Body::Slab(slab) => [summation(case.run.summation), thickness(slab)],
        Body::Solid(_) => [patches(case.run.summation), None],
    };
    own.into_iter().flatten().chain(pictures(case, time)).collect()
}

/// Pictures that the run ends before.
fn pictures(case: &Case, time: f64) -> Option<String> {
    let strain_rate = match &case.body {
        Body::Slab(slab) => {
            let Loading::StrainRate { rate, .. } = slab.loading;
            Some(rate)
        }
        Body::Solid(solid) => solid::strain_rate(solid),
    };
    let every = between_pictures(case, strain_rate).filter(|&every| every > time)?;
    Some(format!(
        "with a picture every {every:.3} ps a run of about {time:.3} ps has none but those of its start and its end; write a \
         shorter `snapshots: {{every: …}}`, such as {:.2e} ps",
        time / 10.0
    ))
}

fn thickness(slab: &Slab) -> Option<String> {
    let thickness = slab.material.thickness;
    let spacings = thickness / material(slab).ok()?.spacing;
    let is_likely = (1.0 / UNLIKELY_THICKNESS..UNLIKELY_THICKNESS).contains(&spacings);
    (!is_likely).then(|| {
        format!(
            "a thickness of {thickness:e} nm is {spacings:.1e} times the distance of the atoms; every stress is a force per \
             length over it"
        )
    })
}

fn summation(rule: Summation) -> Option<String> {
    Some(match rule {
        Summation::Exact | Summation::StrictGauss { .. } => return None,
        Summation::Gauss { points } => format!(
            "`summation: {{gauss: {points}}}` looks at some bonds of a string only: once bonds part the energy may drift; \
             the report tells by how much"
        ),
        Summation::Nodal => {
            "`summation: nodal` fails the patch test: uncracked it is 43 % too soft with 10 atoms per edge (2.20 against \
             3.92 GPa at 1 %), and the report gives no K that takes the moduli of the lattice"
                .to_owned()
        }
    })
}

/// Of a solid.
fn patches(rule: Summation) -> Option<String> {
    (rule == Summation::Nodal).then(|| {
        "`summation: nodal` fails the patch test: an evenly strained solid is not at rest, and its moduli are not those of \
         the lattice"
            .to_owned()
    })
}
