//! Elements that become atoms on the way, and what that asks of the run.

use super::{At, Check};
use crate::study::{
    case::{Refine, Run, Summation},
    defaults, file,
    finding::Finding,
    reader::Given,
};

/// More layers of elements than any specimen has use for.
const MOST_LAYERS: u32 = 1000;

impl Check<'_> {
    /// What becomes atoms on the way; the outer `None` is a mistake.
    pub fn refine(&self, given: &Given<file::Refine>, element: Option<At<u32>>) -> Option<Option<Refine>> {
        let (values, place) = match given {
            Given::Absent => return Some(None),
            Given::Wrong(_) => return None,
            Given::Right(values, place) => (values, *place),
        };
        if let Some((1, element)) = element {
            let message = "single atoms cannot be refined";
            let finding = Finding::at(place, message).with(element, "all are atoms");
            self.add(finding.help("leave `refine` out, or write a larger `element`"));
            return None;
        }
        let to = match &values.to {
            Given::Right(to, place) if *to != 1 => {
                let message = format!("elements become single atoms, and not elements of {to} atoms per edge");
                self.add(Finding::at(*place, message).help("write `to: 1` or leave it out"));
                None
            }
            Given::Wrong(_) => None,
            _ => Some(()),
        };
        let error = self.size_if_given(&values.error, "refine.error");
        let error = error.map(|given| given.map_or(defaults::REFINE_ERROR, |(error, _)| error));
        let ahead = match &values.ahead {
            Given::Right(layers, place) if *layers > MOST_LAYERS => {
                let message = format!("{layers} layers are more than any specimen has use for");
                self.add(Finding::at(*place, message).help("write `ahead: 2`, or single atoms with `element: 1`"));
                None
            }
            layers => self.choice(layers, defaults::REFINE_AHEAD),
        };
        to?;
        Some(Some(Refine {
            error: error?,
            ahead: ahead?,
        }))
    }

    /// The run of a mesh that is refined on the way, with the mass and the sum over bonds under which refining loses nothing.
    pub fn run_of_refined(&self, run: Run, given: &Given<file::Run>) -> Option<Run> {
        let values = given.right();
        let mass = values.map_or(&Given::Absent, |values| &values.mass);
        let is_right = match mass.place() {
            Some(place) if run.mass != defaults::MASS_OF_REFINED => {
                let message = "lumped masses of an element that becomes atoms lose kinetic energy and angular momentum";
                self.add(Finding::at(place, message).help("with `refine` write `mass: consistent` or leave it out"));
                false
            }
            _ => true,
        };
        let summation = values.and_then(|values| values.summation.place());
        if let Some(place) = summation.filter(|_| run.summation != Summation::Exact) {
            let message =
                "the energy of an element that becomes atoms is that of its atoms only if every bond is summed";
            self.add(Finding::at(place, message).help("with `refine` write `summation: exact` or leave it out"));
            return None;
        }
        let mass = match mass {
            Given::Absent => defaults::MASS_OF_REFINED,
            _ => run.mass,
        };
        let run: Run = Run { mass, ..run };
        is_right.then_some(run)
    }
}
