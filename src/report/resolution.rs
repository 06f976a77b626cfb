//! What the size of the elements does to a crack, for the cases of a report.

use super::Analysed;
use super::refined::is_refined;

/// Atoms an edge from which cracks turn aside at the first corner.
const KINKS_FROM: u32 = 5;

/// A term and what it means, for what is among the cases.
pub fn notes(cases: &[Analysed]) -> Vec<(&'static str, String)> {
    let settings = || cases.iter().filter_map(|case| case.result.setting.as_ref());
    let with_crack = || settings().filter(|setting| setting.crack_row.is_some());
    let is_coarse = with_crack().any(|setting| setting.element_at_crack >= KINKS_FROM);
    let has_band =
        with_crack().any(|setting| setting.element_at_crack == 1 && setting.nodes < setting.represented_atoms);
    let mut notes = Vec::new();
    if is_coarse {
        notes.push((
            "Cracks through large elements",
            format!(
                "They turn aside by 60° at a corner of the elements. There six elements meet, and the pull passes in series \
                 through the edges at 60° and the edge in the crack plane. An edge in the plane has two families of bonds to \
                 carry it, an edge at 60° has one, whose bonds stretch 1.67 times as much and give way first, by slip. Neither \
                 the sum over bonds nor the mass, the time step, the rate, the grips or the end of the notch changes that. \
                 Elements of fewer than {KINKS_FROM} atoms per edge let the crack run straight (studies convergence-D and \
                 models-A-E-fine)."
            ),
        ));
    }
    if cases.iter().any(is_refined) {
        notes.push((
            "Elements that become atoms",
            "The error of an element is the largest difference |F − F′| between its deformation gradient and that of an element \
             along one of its edges, over what the longest of their bonds has left until it gives way. Where it is larger than \
             asked for, the element becomes its atoms, and the layers around it with it, at the places and velocities at which \
             the element carried them. With the consistent mass and the sum over all bonds neither energy nor momentum changes."
                .to_owned(),
        ));
    }
    if has_band {
        notes.push((
            "Cracks in a band of atoms",
            "Slip that starts at the crack stops at the border of the band, where the traces are pinned: an element \
             beyond can slip along its edges only. Waves too short for the elements stay in the band."
                .to_owned(),
        ));
    }
    notes
}
