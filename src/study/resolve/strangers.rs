//! Keys that only a specimen of the other kind has.

use super::{Check, run::CrackStops};
use crate::study::{
    file::{CaseFile, Lattice, Loading, Observe, Region},
    finding::{Finding, Place},
    reader::Given,
};

/// Whether a case speaks of a solid: by its lattice, or where that says nothing by its sizes.
pub fn is_solid(case: &CaseFile) -> bool {
    let Some(specimen) = case.specimen.right() else {
        return false;
    };
    match &specimen.lattice {
        Given::Right(lattice, _) => matches!(lattice, Lattice::Fcc),
        Given::Wrong(_) => specimen.blocks.place().or(specimen.size.place()).is_some(),
        Given::Absent => false,
    }
}

impl Check<'_> {
    fn refuse(&self, place: Option<Place>, message: &str, help: &str) {
        if let Some(place) = place {
            self.add(Finding::at(place, message).help(help));
        }
    }

    pub fn refuse_what_a_slab_has_not(&self, case: &CaseFile) {
        const LATTICE: &str = "write `lattice: fcc` for a solid, or leave it out";
        if let Some(specimen) = case.specimen.right() {
            let keys = [
                ("blocks", specimen.blocks.place()),
                ("size", specimen.size.place()),
                ("orientation", specimen.orientation.place()),
            ];
            for (key, place) in keys {
                let message = format!("`specimen.{key}` is for a solid, and the triangular lattice makes a slab");
                self.refuse(place, &message, LATTICE);
            }
        }
        let notch = "`notch` is for a solid, and the triangular lattice makes a slab";
        self.refuse(case.notch.place(), notch, "cut a slab with `crack`");
        let held = "`held` is for a solid: a slab is held by its grips";
        self.refuse(case.held.place(), held, "leave it out");
        if let Given::Right(loading, place) = &case.loading
            && !matches!(loading, Loading::StrainRate(_) | Loading::Pulse(_))
        {
            let message = "this loading is for a solid, and the triangular lattice makes a slab";
            let help =
                "write `loading: {strain-rate: {mode: I, rate: 4.6e6 /s}}` or a `pulse`, or `lattice: fcc` for a solid";
            self.refuse(Some(*place), message, help);
        }
        for (region, place) in regions(case) {
            if matches!(region, Region::Slab(_) | Region::Ball(_) | Region::Cylinder(_)) {
                let message = "this region is for a solid, and the triangular lattice makes a slab";
                self.refuse(Some(place), message, "write a `band`, a `box` or a `disc`");
            }
        }
        for item in case.observe.right().into_iter().flatten() {
            if let Given::Right(Observe::Gauges(_), place) = item
                && !matches!(case.loading.right(), Some(Loading::Pulse(_)))
            {
                let message =
                    "`gauges` are for a pulse or a solid: those of a pulled slab stand where its waves are told from";
                self.refuse(Some(*place), message, "leave them out, or write `wave-arrival`");
            }
        }
    }

    pub fn refuse_what_a_solid_has_not(&self, case: &CaseFile, stops: Option<CrackStops>) {
        if let Some(material) = case.material.right() {
            let message = "`material.thickness` is for a slab: the stress of a solid needs none";
            self.refuse(material.thickness.place(), message, "leave it out");
        }
        if let Some(specimen) = case.specimen.right() {
            let keys = [
                (
                    "length",
                    specimen.length.place(),
                    "write `blocks: [4, 4, 40]` or `size: [10 nm, 20 nm, 2 nm]`",
                ),
                (
                    "width",
                    specimen.width.place(),
                    "write `blocks: [4, 4, 40]` or `size: [10 nm, 20 nm, 2 nm]`",
                ),
                ("grips", specimen.grips.place(), "write `held: {faces: [a2-low]}`"),
            ];
            for (key, place, help) in keys {
                let message = format!("`specimen.{key}` is for a slab, and the FCC lattice makes a solid");
                self.refuse(place, &message, help);
            }
        }
        if let Some(resolution) = case.resolution.right() {
            let message = "elements of a solid cannot become atoms on the way yet";
            let help = "put single atoms where something will break: `regions: [{slab: {…, element: 1}}]`";
            self.refuse(resolution.refine.place(), message, help);
        }
        let crack = "`crack` is for a slab: in a solid no crack is followed along a line";
        let help = "cut a solid with `notch: {plane: {normal: a2, at: 40 nm, from: a1-low, depth: 20 nm}}`";
        self.refuse(case.crack.place(), crack, help);
        if let Given::Right(Loading::StrainRate(_), place) = &case.loading {
            let message = "`strain-rate` pulls a slab by its grips, and a solid has none";
            let help = "write `loading: {velocity: {face: a2-high, speed: 20 m/s}}` and `held: {faces: [a2-low]}`";
            self.refuse(Some(*place), message, help);
        }
        for (region, place) in regions(case) {
            if matches!(region, Region::Band(_) | Region::Disc(_)) {
                let message = "this region is for a slab, and the FCC lattice makes a solid";
                self.refuse(
                    Some(place),
                    message,
                    "write a `box`, a `slab`, a `ball` or a `cylinder`",
                );
            }
        }
        for item in case.observe.right().into_iter().flatten() {
            let (what, place) = match item {
                Given::Right(Observe::Crack, place) => ("crack", place),
                Given::Right(Observe::StressProfile, place) => ("stress-profile", place),
                Given::Right(Observe::WaveArrival, place) => ("wave-arrival", place),
                _ => continue,
            };
            let message = format!("`{what}` is for a slab, whose crack runs along a line");
            let help = "leave it out; a solid has `average-stress`, `snapshots` and `gauges`";
            self.refuse(Some(*place), &message, help);
        }
        for place in stops.into_iter().flat_map(CrackStops::places) {
            let message = "this waits for a crack along a line, and in a solid none is followed";
            self.refuse(Some(place), message, "stop at a strain or a time");
        }
        if let Some(run) = case.run.right() {
            let strain = run.relax.right().and_then(|relax| relax.strain.right());
            if strain.is_some_and(|strain| strain.value != 0.0) {
                let message = "a solid comes to rest under what its loading is at the start, without strain";
                let help = "write `relax: {strain: 0 %}`; under a traction at once it comes to rest stretched";
                self.refuse(run.relax.place(), message, help);
            }
        }
    }
}

fn regions(case: &CaseFile) -> impl Iterator<Item = (&Region, Place)> {
    let regions = case.resolution.right().and_then(|values| values.regions.right());
    let given = regions.into_iter().flatten();
    given.filter_map(|region| match region {
        Given::Right(region, place) => Some((region, *place)),
        _ => None,
    })
}
