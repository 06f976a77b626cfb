//! A slab that a pulse goes through: what it has not, and its gauges.

use crate::study::{
    file::{self, CaseFile, Loading, Observe},
    finding::Finding,
    reader::Given,
    resolve::{Check, specimen::SpecimenAt},
};

/// Whether a case is loaded by a pulse.
pub fn is_pulse(case: &CaseFile) -> bool {
    matches!(case.loading.right(), Some(Loading::Pulse(_)))
}

impl Check<'_> {
    /// Waves are told by gauges in a slab without a crack, whose grips are at rest.
    pub fn refuse_what_a_pulse_has_not(&self, case: &CaseFile) {
        let refuse = |place, message: &str, help: &str| {
            if let Some(place) = place {
                self.add(Finding::at(place, message).help(help));
            }
        };
        let crack = "a pulse goes through a slab without a crack";
        let help = "leave the crack out, or pull it with `loading: {strain-rate: {mode: I, rate: 4.6e6 /s}}`";
        refuse(case.crack.place(), crack, help);
        if let Some(resolution) = case.resolution.right() {
            let message = "elements become atoms where a crack comes, and under a pulse there is none";
            refuse(resolution.refine.place(), message, "leave `refine` out");
        }
        if let Some(run) = case.run.right() {
            let strain = run.relax.right().and_then(|relax| relax.strain.right());
            if strain.is_some_and(|strain| strain.value != 0.0) {
                let message = "the grips of a slab under a pulse are at rest, and strain nothing";
                refuse(
                    run.relax.place(),
                    message,
                    "write `relax: {strain: 0 %}`, or leave it out",
                );
            }
        }
        for item in case.observe.right().into_iter().flatten() {
            if let Given::Right(Observe::StressProfile, place) = item {
                let message = "`stress-profile` tells of the stress ahead of a crack, and under a pulse there is none";
                refuse(
                    Some(*place),
                    message,
                    "leave it out, or write `gauges: {axis: x, at: [20 nm, 60 nm]}`",
                );
            }
        }
        self.refuse_strains(
            case,
            "speak of a time, such as `200 ps`, or pull it with a `strain-rate`",
        );
    }

    /// Distances of the gauges from the left face, nm; `None` is a mistake.
    pub fn slab_gauges(&self, case: &CaseFile, specimen: &SpecimenAt) -> Option<Vec<f64>> {
        if !is_pulse(case) {
            // Refused where what a slab has no use for is.
            return Some(Vec::new());
        }
        let Some((gauges, place)) = self.gauges_asked(&case.observe)? else {
            return Some(Vec::new());
        };
        let (axis, at) = self.need(&gauges.axis, place, "gauges.axis", "x")?;
        if !matches!(axis, file::Axis::X) {
            let message = "waves go through a slab along x, from face to face";
            self.add(Finding::at(at, message).help("write `axis: x`"));
            return None;
        }
        self.gauges_at(&gauges, place, specimen.length.map(|(length, _)| length))
    }
}
