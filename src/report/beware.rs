//! What the first lines of a report warn of.

use super::Analysed;
use super::numbers::significant;
use super::units::PERCENT;

/// Share of the work from which on an energy error is told before anything else: what is measured of a crack changes by as
/// much.
const ENERGY_ERROR: f64 = 0.01;

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
    energy.chain(nodal).collect()
}
