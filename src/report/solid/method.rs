//! How the numbers of a report of solids came about.

use super::Analysed;
use crate::report::numbers::significant;
use crate::report::units::PERCENT;

/// Notes that say something of a slab under a pulse, too.
const OF_PULSES: [&str; 2] = ["Distance of curves", "Energy missing"];

pub fn notes(cases: &[Analysed]) -> Vec<(&'static str, String)> {
    let is_pulse = |case: &Analysed| case.solid.specimen.wave_speed.is_some();
    let mut notes = of_solids();
    if cases.iter().all(is_pulse) {
        notes.retain(|(name, _)| OF_PULSES.contains(name));
    }
    if cases.iter().any(is_pulse) {
        notes.extend(of_pulses());
    }
    notes.extend(cases.iter().map(specimen));
    notes
}

fn of_pulses() -> Vec<(&'static str, String)> {
    vec![
        (
            "Stress and gauges of a slab",
            "Average stress: virial of all bonds between the grips over the area of their atoms and the thickness, along x. A gauge is \
             a line across the slab, in each row of atoms between the two that are next to it; its velocity is the mean on the line, \
             its stress that of the elements whose atoms these are."
                .to_owned(),
        ),
        (
            "Bonds lost in a slab",
            "Bonds of nearest neighbours that are broken, less those that have closed again.".to_owned(),
        ),
        (
            "Arrival",
            "When the middle of that part of the pulse passes a gauge where the velocity along x is above half of its greatest there, \
             for the first time: that a pulse which disperses has another shape at the next gauge hardly moves it. A gauge so near to \
             the far face that the reflection meets the pulse has no true time. The speed of long waves is c_L = √(C11 / ρ) of the \
             crystal at rest; with grips that slide, the wave is plane."
                .to_owned(),
        ),
    ]
}

fn of_solids() -> Vec<(&'static str, String)> {
    vec![
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
            "Crack and slip",
            "A border between two elements along a face has opened when the middles of its faces are so far apart that an even \
             opening would break all bonds, and slid when they have moved along each other by half a partial dislocation, \
             r0/√12. A broken bond of atoms belongs to a crack when its two atoms have lost four neighbours or more between them, \
             and to slip otherwise. Areas are those in the crystal: √3/2 of a squared spacing a site, √3/4 of a squared edge \
             between two blocks. The crack is what has opened and hangs together with the notch. Planes are named by the axis that \
             they cross; the fourth holds a1 - a2 and a2 - a3."
                .to_owned(),
        ),
        (
            "Front",
            "For each strip of ten spacings along the front of the notch the farthest piece of the crack, as its distance from the \
             notch; the speed is that between two pictures, normal to the front."
                .to_owned(),
        ),
        (
            "What keeps a direction",
            "Branches of the crack from a notch and bands of slip that go on at 60° to its plane, within 5°, over 10 nm without a gap; cracks from a ball that are 0.4 \
             as long as the longest or more, 30° apart or more, with a dip between them; 0° is x."
                .to_owned(),
        ),
        (
            "Dislocated atoms",
            "Of the atoms with twelve atoms as neighbours at rest those whose centrosymmetry [Kelchner1998] exceeds a quarter of \
             that in a stacking fault while they have eleven neighbours or more within 1.207 spacings."
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
            "Of one sine that is fitted to the average stress in a Hann window from its first crossing of zero on, so that faster \
             waves do not count; where fewer than two periods were seen, from the crossings of zero between swings of more than \
             0.3 of the greatest stress."
                .to_owned(),
        ),
        (
            "Young's modulus at rest",
            "The solid comes to rest under its traction before it moves: force over cross-section and over the displacement of the \
             loaded face a length. A thin bar has the period 4 L sqrt(ρ/E); L is from what is held to the loaded face. That of \
             the crystal is of a bar without surfaces along the load."
                .to_owned(),
        ),
        (
            "Distance of curves",
            "Root of the mean square difference of the average stress from that of the case with the most nodes of those that \
             load the same solid in the same way, at equal times, over the greatest stress of that case."
                .to_owned(),
        ),
        (
            "Energy missing",
            "Kinetic and potential energy gained, less the work of the loading and what pairs released that crossed the \
             cutoff; the greatest over the greatest work."
                .to_owned(),
        ),
    ]
}

fn specimen(case: &Analysed) -> (&'static str, String) {
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
    let intensity = specimen.intensity.as_ref().map_or(String::new(), |told| {
        format!(
            ", with a K at rest by F σ √(πa), the handbook factor of an edge crack in a long strip, in MPa √m and over that of \
             Griffith: {told}"
        )
    });
    (
        "Specimen",
        format!(
            "{}: {}; {}; notch: {}{intensity}; held: {}; loading: {}{leftover}.",
            case.name(),
            edges.join(", "),
            specimen.kinds,
            specimen.notch,
            specimen.held,
            specimen.loading,
        ),
    )
}
