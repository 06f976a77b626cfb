//! The rules behind the numbers, in words, with the values in force. Those of a table stand beside its columns.

use super::numbers::significant;
use super::tables::{first_branch, k_ic, wave_arrival};
use super::units::{GIGAPASCAL, MEGAPASCAL_ROOT_METRE, METRE_PER_SECOND};
use super::{Analysed, resolution};
use crate::analysis::comparison::FROM_SHARE;
use crate::analysis::crack::YARDSTICK_SPACINGS;
use crate::analysis::initiation::{ADVANCE_SPACINGS, ARREST_SPEED, CREEP_GROWTH, STAND_GROWTH, STAND_GROWTH_AT_NOTCH};
use crate::analysis::series::{CrackFrom, Setting};
use crate::analysis::speed::{WINDOW_ADVANCES, WINDOW_SPEED};

/// A term and what it means here.
pub fn notes(cases: &[Analysed]) -> Vec<(&'static str, String)> {
    let mut notes = Vec::new();
    let has_crack = cases.iter().any(Analysed::has_crack);
    if has_crack {
        notes.extend(of_cracks(cases));
    }
    notes.extend(of_all(has_crack));
    notes.extend(constants(cases));
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

/// The constants of each material among the cases.
fn constants(cases: &[Analysed]) -> Vec<(&'static str, String)> {
    let mut told: Vec<String> = Vec::new();
    for setting in cases.iter().filter_map(|case| case.result.setting.as_ref()) {
        let three = |value: f64| significant(value, 3);
        let text = format!(
            "r0 = {} nm, E = {} GPa and ν = {} in the plane, c_L = {} m/s, c_T = {} m/s, c_R = {} m/s, 2γ = {} J/m², K of \
             Griffith = {} MPa √m.",
            significant(setting.spacing, 4),
            three(setting.young_modulus / setting.thickness * GIGAPASCAL),
            three(setting.poisson_ratio),
            three(setting.longitudinal_speed * METRE_PER_SECOND),
            three(setting.transverse_speed * METRE_PER_SECOND),
            three(setting.rayleigh_speed * METRE_PER_SECOND),
            // 1 GPa nm is 1 J/m².
            three(setting.fracture_energy / setting.thickness * GIGAPASCAL),
            three((setting.young_modulus * setting.fracture_energy).sqrt() / setting.thickness * MEGAPASCAL_ROOT_METRE)
        );
        if !told.contains(&text) {
            told.push(text);
        }
    }
    told.into_iter().map(|text| ("Material", text)).collect()
}

/// What belongs to a crack: its place, its course, K and the waves that come back to it.
fn of_cracks(cases: &[Analysed]) -> Vec<(&'static str, String)> {
    let mut notes = vec![of_the_tip()];
    notes.extend(sides(cases));
    notes.extend(of_the_course());
    notes.extend(first_branch::method());
    notes.extend(k_ic::method());
    notes.extend(wave_arrival::method());
    notes
}

fn of_the_tip() -> (&'static str, String) {
    (
        "Crack",
        "The broken nearest-neighbour bonds that hang together with the notch; fragments and holes away from it do \
         not count. The tip is its foremost point, in the reference configuration, from the left edge and from \
         the crack plane. A bond that closes far behind the tip is a contact of the faces and does not end the \
         crack."
            .to_owned(),
    )
}

fn of_the_course() -> [(&'static str, String); 3] {
    let percent = |share: f64| significant(share * 100.0, 3);
    [
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
            "Crack speed",
            format!(
                "Slope of the arc length over time by least squares. The window is the time in which a crack at \
                 {WINDOW_SPEED} c_R runs {WINDOW_ADVANCES} times the least advance that is seen on the mesh (stated for \
                 each case under Provenance), cut off where the tip jumps; a tip that moves back has no speed. c_R is the exact \
                 Rayleigh speed of this lattice and cutoff."
            ),
        ),
    ]
}

fn of_all(has_crack: bool) -> [(&'static str, String); 2] {
    [
        (
            "Comparison",
            match has_crack {
                true => format!(
                    "Each case is measured against the one with the most nodes on the same specimen. Stresses are compared at \
                     equal strain, from {} % of the earliest initiation strain among these cases up to it, as the largest \
                     difference; speeds as the mean difference while both cracks run, without sign.",
                    significant(100.0 * FROM_SHARE, 3)
                ),
                false => "Each case is measured against the one with the most nodes on the same specimen. Stresses are compared \
                          at equal strain, as the largest difference."
                    .to_owned(),
            },
        ),
        (
            "Energy error",
            "Largest |Δkinetic + Δpotential − work − cutoff release − refined| over the largest work. The cutoff release is \
             what the energy jumps where a pair crosses a truncated cutoff; it is zero where the potential is smooth. Refined is \
             what the energy jumps where elements become atoms."
                .to_owned(),
        ),
    ]
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
