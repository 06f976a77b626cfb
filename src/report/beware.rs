//! What the first lines of a report warn of.

use super::numbers::significant;
use super::units::PERCENT;
use super::{Analysed, refined};

/// Share of the work from which on an energy error is told before anything else: what is measured of a crack changes by as
/// much.
const ENERGY_ERROR: f64 = 0.01;

/// What parts farther than this share of the height from the crack plane parts at a grip, which is half the height away.
const AT_THE_GRIP: f64 = 0.45;

/// `Beware: the energy error of coarse is 2.2 % of the work.`
pub fn sentences(cases: &[Analysed]) -> Vec<String> {
    let energy = cases.iter().filter_map(|case| {
        let error = case
            .result
            .manifest
            .energy_error
            .filter(|&error| error > ENERGY_ERROR)?;
        let share = significant(error * PERCENT, 2);
        Some(format!(
            "Beware: the energy error of {} is {share} % of the work.",
            case.name()
        ))
    });
    let nodal = cases.iter().filter(|case| case.is_nodal()).map(|case| {
        format!(
            "Beware: {} sums the bonds of nodes only, which fails the patch test: uncracked it is far too soft, so no K that \
             takes the moduli of the lattice, Griffith's among them, is given for it.",
            case.name()
        )
    });
    energy
        .chain(nodal)
        .chain(cases.iter().filter_map(refined::outrun))
        .chain(cases.iter().filter_map(parted_elsewhere))
        .collect()
}

/// `Beware: coarse parted away from its crack, at the upper grip, at 3.1 % strain …`
fn parted_elsewhere(case: &Analysed) -> Option<String> {
    let parted = case.findings.parted_elsewhere?;
    let height = case.result.setting.as_ref()?.height;
    let side = if parted.y > 0.0 { "upper" } else { "lower" };
    let place = if parted.y.abs() > AT_THE_GRIP * height {
        format!("at the {side} grip")
    } else {
        let off = significant(parted.y.abs(), 3);
        format!("in its {side} half, {off} nm from the crack plane")
    };
    let strain = significant(parted.strain * PERCENT, 3);
    Some(format!(
        "Beware: {} parted away from its crack, {place}, at {strain} % strain: nothing from then on tells of a crack in a \
         specimen that is whole.",
        case.name()
    ))
}
