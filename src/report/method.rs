//! The rules behind the numbers, in words, with the values in force.

use super::numbers::significant;
use super::{Analysed, resolution};
use crate::analysis::comparison::FROM_SHARE;
use crate::analysis::crack::YARDSTICK_SPACINGS;
use crate::analysis::crack::leaving::LEAVES_PLANE_SPACINGS;
use crate::analysis::crack::{SPUR_ELEMENTS, SPUR_SPACINGS};
use crate::analysis::initiation::{ADVANCE_SPACINGS, ARREST_SPEED, CREEP_GROWTH, STAND_GROWTH, STAND_GROWTH_AT_NOTCH};
use crate::analysis::series::{CrackFrom, RINGS, Setting};
use crate::analysis::speed::{WINDOW_ADVANCES, WINDOW_SPEED};
use crate::analysis::stress_intensity::{
    FROM_ELEMENTS, FROM_SPACINGS, LEAST_GRIFFITH_SHARE, MOST_CORRECTION, MOST_ERROR_SHARE, MOST_RING_SHARE,
    RING_CLEAR_SHARE, RING_ELEMENTS, RING_SPACINGS, TO_SHARE,
};
use crate::analysis::waves::{AFTER_SHARE, BEFORE_SHARE, LEAST_RIVALS, LEAST_SCATTERS, WINDOW};

/// A term and what it means here.
pub fn notes(cases: &[Analysed]) -> Vec<(&'static str, String)> {
    let percent = |share: f64| significant(share * 100.0, 3);
    let mut notes = vec![
        (
            "Crack",
            "The broken nearest-neighbour bonds that hang together with the notch; fragments and holes away from it do \
             not count. The tip is its foremost point, in the reference configuration, from the left edge and from \
             the crack plane. A bond that closes far behind the tip is a contact of the faces and does not end the \
             crack."
                .to_owned(),
        ),
        (
            "Arc length",
            format!(
                "Length of the shortest broken path from the mouth to the tip, measured with a yardstick of \
                 {YARDSTICK_SPACINGS} lattice spacings."
            ),
        ),
        (
            "Initiation",
            format!(
                "The beginning of the advance that takes the tip {ADVANCE_SPACINGS} spacings beyond the notch, or one edge of an \
                 element where that is longer, at every rate: where it leaves for good the place at which it last stood still \
                 while the strain grew by {} %. An advance that needs {} % more strain and is slower than {ARREST_SPEED} c_R \
                 creeps and is no start. The single bond at the end of the notch is none if {} % more strain pass before the \
                 next. Under compression there is none. The first bond is that by which the tip first moves.",
                percent(STAND_GROWTH),
                percent(CREEP_GROWTH),
                percent(STAND_GROWTH_AT_NOTCH)
            ),
        ),
        (
            "Leaves the plane",
            format!(
                "When a broken path from the notch first reaches {LEAVES_PLANE_SPACINGS} spacings from the crack plane, and where; beside \
                 it when the first bond of that path off the plane broke. A crack that joins one that has opened ahead of it \
                 is told in the table joins: that is neither a speed nor a branch."
            ),
        ),
        (
            "Crack speed",
            format!(
                "Slope of the arc length over time by least squares. The window is the time in which a crack at \
                 {WINDOW_SPEED} c_R runs {WINDOW_ADVANCES} times the least advance that is seen on the mesh (stated for \
                 each case under Provenance), cut off where the tip jumps; a tip that moves back has no speed. c_R is the exact \
                 Rayleigh speed of this lattice and cutoff."
            ),
        ),
        (
            "K near the tip",
            format!(
                "Least-squares fit of σyy √(2πr) = K (1 + c r) at the last probe before initiation, from r = \
                 {FROM_SPACINGS} spacings (at least {FROM_ELEMENTS} element edges) to {} % of the crack length, the \
                 ligament or the height, whichever is smallest; ± is the standard error of the fit alone. Refused where K is not positive, where \
                 that error is above {} % of K, and where c r is above {MOST_CORRECTION} at the end of the range.",
                percent(TO_SHARE),
                percent(MOST_ERROR_SHARE)
            ),
        ),
        (
            "K of the J-integral",
            format!(
                "√(EJ) at the same probe, J being the energy that the field around the tip would give for its advance: \
                 the domain integral with finite strain and inertia, in {RINGS} rings side by side that reach to at most \
                 {RING_SPACINGS} spacings (at least {RING_ELEMENTS} element edges), and to at most {} % of the way to the nearest \
                 edge or grip. The value is the mean of the rings; they agree to half of the range between \
                 them, which is no uncertainty of K. Refused where they agree to no better than {} %, and below {} % of Griffith's K: \
                 a crack that sets out gets what its surfaces cost. Waves that pass the tip let J itself swing by some percent \
                 within picoseconds, in all rings alike. Absent where there is no room for rings.",
                percent(RING_CLEAR_SHARE),
                percent(MOST_RING_SHARE),
                percent(LEAST_GRIFFITH_SHARE)
            ),
        ),
        (
            "K of Griffith",
            "√(2γE) over the thickness, with the energy that the potential and its treatment at the cutoff need to \
             part a close-packed row, and the two-dimensional Young's modulus."
                .to_owned(),
        ),
        (
            "K of the energy balance",
            "√(E C H / 2) times the strain at the same probe, C being the stiffness of the uncracked slab and H its height: what \
             the slab holds far ahead of a long crack and gives up for its advance. Exact where crack and ligament are longer \
             than the height; a short crack has less."
                .to_owned(),
        ),
        (
            "K between grips",
            "F E ε √(πa) at the same probe, with the factor F of an edge crack between grips that move, from the static release \
             of energy of the lattice (`make verify`, single edge), linear between the geometries computed. Waves that the \
             loading itself has made are not in it."
                .to_owned(),
        ),
        (
            "K under stress",
            "F σ √(πa) with the handbook factor of an edge crack in a long strip under uniform stress (Tada), put to the stress on \
             the grips at the same probe: what one gets who takes moving grips for a stress. Up to several times too large, \
             because grips that stand still take load off a crack that is long for their distance."
                .to_owned(),
        ),
        (
            "Branches",
            format!(
                "Side paths of at least {SPUR_SPACINGS} spacings (and {SPUR_ELEMENTS} element edges) that end at least \
                 half of that away from the others. The angle is that of their first stretch, from the x axis. \
                 Arrested means slower than {ARREST_SPEED} c_R over the last such length."
            ),
        ),
        (
            "Comparison",
            format!(
                "Each case is measured against the one with the most nodes on the same specimen. Stresses are compared \
                 at equal strain, from {} % of the earliest initiation strain among these cases up to it, as the \
                 largest difference; speeds as the mean difference while both cracks run, without sign.",
                percent(FROM_SHARE)
            ),
        ),
        (
            "Waves",
            format!(
                "Arrivals at the tip, counted from initiation. Predicted: straight paths at the speeds of long waves, to a \
                 tip at rest and (at the running tip) to where it is by then. Measured: wave gauges halfway to the grips and \
                 halfway along the notch to its edge record the mean velocity v and stress σ of a patch; σ ± ρcv is what a plane wave brings back towards the tip, and is \
                 untouched by what leaves it. Where it bends most, where its mean over the next {} % of the predicted \
                 time lies farthest off its line over the {} % before, the wave is at the gauge, and the way from there \
                 is added. It is known to a probe, and comes late by up to half of the time in which the front rises. \
                 Absent where this bend is not {LEAST_SCATTERS} times the scatter before initiation and {LEAST_RIVALS} \
                 times any before it, or \
                 comes {} % before the prediction or {} % after it; behind cracks longer than half of the height, where other waves \
                 come first; and for Rayleigh waves, which have no plane front.",
                percent(AFTER_SHARE),
                percent(BEFORE_SHARE),
                percent(AFTER_SHARE),
                percent(WINDOW)
            ),
        ),
        (
            "Energy error",
            "Largest |Δkinetic + Δpotential − work − cutoff release| over the largest work. The cutoff release is what \
             the energy jumps where a pair crosses a truncated cutoff; it is zero where the potential is smooth."
                .to_owned(),
        ),
    ];
    notes.splice(1..1, sides(cases));
    notes.extend(resolution::notes(cases));
    let treatment = |case: &Analysed| {
        let about = case
            .result
            .choices
            .iter()
            .filter(|choice| choice.0.contains("potential"));
        about
            .map(|(key, value)| format!("{key} = {value}"))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let mut treatments: Vec<String> = cases.iter().map(treatment).filter(|text| !text.is_empty()).collect();
    treatments.dedup();
    notes.extend(treatments.into_iter().map(|text| ("Potential", text)));
    notes
}

/// What is to be known of cracks that do not come from the left.
fn sides(cases: &[Analysed]) -> Vec<(&'static str, String)> {
    let named = |is_so: fn(&Setting) -> bool| {
        let such = cases
            .iter()
            .filter(|case| case.result.setting.as_ref().is_some_and(is_so));
        such.map(Analysed::name).collect::<Vec<_>>().join(", ")
    };
    let right = named(|setting| matches!(setting.crack_from, CrackFrom::Right { .. }));
    let inside = named(Setting::is_crack_inside);
    let mut notes = Vec::new();
    if !right.is_empty() {
        let text = format!(
            "In {right} the crack begins at the right edge and runs left. Its length, and what ends a run at a crack length, is \
             measured from there; places are from the left edge as everywhere, and angles from the x axis, so that straight \
             ahead is 180 degrees."
        );
        notes.push(("Crack from the right", text));
    }
    if !inside.is_empty() {
        let text = format!(
            "In {inside} the notch lies inside and has two tips. All that is said of the crack is said of the one that runs to the \
             right: tip, start, speed, K, branches, and what ends a run. Its length is measured from the middle of the notch to the \
             tip. What runs to the left shows in the pictures and in the table path alone. Waves from the sides and the geometry \
             factors, which are those of a crack from an edge, are left out."
        );
        notes.push(("Crack inside", text));
    }
    notes
}
