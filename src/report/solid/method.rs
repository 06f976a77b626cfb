//! How the numbers of a report of solids came about.

use super::Analysed;
use crate::report::numbers::significant;
use crate::report::units::PERCENT;

pub fn notes(cases: &[Analysed]) -> Vec<(&'static str, String)> {
    let mut notes = vec![
        (
            "Average stress",
            "Virial of all bonds over the volume of all atoms at rest, in the direction in which the loading pulls.".to_owned(),
        ),
        (
            "Nominal strain",
            "Displacement of the moving face over the length between it and what is held opposite, along the motion; under \
             other loadings it is that of the two faces that the loading acts along."
                .to_owned(),
        ),
        (
            "Bonds lost",
            "Pairs of atoms that have left the cutoff since the start, less those that have come within it, from the energy \
             that they release there. Slip along a plane breaks bonds too, and makes others."
                .to_owned(),
        ),
        (
            "Modulus",
            "Least squares of stress over strain up to 1 % strain or the first change of bonds; the waves of a loading from rest \
             are in it."
                .to_owned(),
        ),
        (
            "Period",
            "From the crossings of zero between swings of more than 0.3 of the greatest average stress.".to_owned(),
        ),
        (
            "Distance of curves",
            "Root of the mean square difference of the average stress from that of the case with the most nodes, at equal \
             times, over the greatest stress of that case."
                .to_owned(),
        ),
        (
            "Energy missing",
            "Kinetic and potential energy gained, less the work of the loading and what pairs released that crossed the \
             cutoff; the greatest over the greatest work."
                .to_owned(),
        ),
    ];
    for case in cases {
        let specimen = &case.solid.specimen;
        let edges: Vec<String> = specimen
            .edges
            .iter()
            .map(|(name, length)| format!("{name} {} nm", significant(*length, 4)))
            .collect();
        let leftover = specimen.leftover_share.filter(|&share| share > 0.0);
        let leftover = leftover.map_or(String::new(), |share| {
            format!(
                "; {} % of the atoms in smaller elements than asked for",
                significant(PERCENT * share, 2)
            )
        });
        notes.push((
            "Specimen",
            format!(
                "{}: {}; {}; notch: {}; held: {}; loading: {}{leftover}.",
                case.name(),
                edges.join(", "),
                specimen.kinds,
                specimen.notch,
                specimen.held,
                specimen.loading,
            ),
        ));
    }
    notes
}
