//! What is allowed and should be known before a case is computed.

use super::intervals::between_pictures;
use super::slab::material;
use super::slab::refined::{self, Growth};
use super::solid;
use crate::study::case::{Body, Case, Slab, Summation};

/// A sheet of atoms is about as thick as its atoms are apart; thicker or thinner than this many times, it is a slip of a unit.
const UNLIKELY_THICKNESS: f64 = 20.0;

/// Sentences about what a case has chosen, whose run takes about `time` (ps).
pub fn cautions(case: &Case, time: f64) -> Vec<String> {
    let own = match &case.body {
        Body::Slab(slab) => [summation(case.run.summation), thickness(slab), refinement(case, slab)],
        Body::Solid(_) => [patches(case.run.summation), None, None],
    };
    own.into_iter().flatten().chain(pictures(case, time)).collect()
}

/// Pictures that the run ends before.
fn pictures(case: &Case, time: f64) -> Option<String> {
    let strain_rate = match &case.body {
        Body::Slab(slab) => slab.loading.strain_rate(),
        Body::Solid(solid) => solid::strain_rate(solid),
    };
    let every = between_pictures(case, strain_rate).filter(|&every| every > time)?;
    Some(format!(
        "with a picture every {every:.3} ps a run of about {time:.3} ps has none but those of its start and its end; write a \
         shorter `snapshots: {{every: …}}`, such as {:.2e} ps",
        time / 10.0
    ))
}

/// What elements will become.
fn refinement(case: &Case, slab: &Slab) -> Option<String> {
    slab.resolution.refine?;
    let growth = material(slab)
        .ok()
        .and_then(|material| refined::growth(slab, &case.run.until, &material));
    Some(match growth {
        Some(Growth { half_width, atoms }) => format!(
            "elements become atoms along the way of the crack, some {half_width:.1} nm to either side of it: at its end about \
             {} atoms, if it runs straight; time, memory and disk are those of a run that ends so",
            significant(atoms)
        ),
        None => "without a crack no element becomes atoms before a bond is at its end".to_owned(),
    })
}

/// With two digits.
fn significant(number: f64) -> u64 {
    let digits = 10f64.powf((number.max(1.0).log10().floor() - 1.0).max(0.0));
    ((number / digits).round() * digits) as u64
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
