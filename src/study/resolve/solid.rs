//! A solid: material, specimen, elements, notch, held faces, loading and gauges together.

mod faces;
mod loading;
mod notch;
mod resolution;
mod specimen;

use super::{Check, Table};
/// The types of a resolved solid.
use crate::study::case::solid as case;
use crate::study::{
    case::{Body, Run, Solid, solid::Gauges},
    file::{self, CaseFile, Observe},
    finding::{Finding, Place},
    reader::Given,
};
use specimen::Laid;

impl Check<'_> {
    /// The solid, its run, and the tables that its report shows.
    pub fn solid(&self, case: &CaseFile, place: Place) -> (Option<Body>, Option<Run>, Vec<Table>) {
        let (material, spacing) = match self.section(&case.material, place) {
            Some((values, place)) => self.atoms(&values, place),
            None => (None, None),
        };
        let element = case.resolution.right();
        let element = element.and_then(|values| values.element.right().copied());
        let laid = self.solid_specimen(&case.specimen, place, spacing, element);
        let resolution = self.solid_resolution(&case.resolution, place, &laid);
        let notch = self.solid_notch(&case.notch, &laid);
        let held = self.held(&case.held, &laid);
        let loading = self.solid_loading(&case.loading, place, &laid);
        let (run, stops) = self.run(&case.run, place);
        self.refuse_what_a_solid_has_not(case, stops);
        if let (Some(loading), Some(held)) = (&loading, &held) {
            self.moves_no_held_face(loading, held.as_ref());
            if !matches!(loading.0, case::Loading::Velocity { .. }) {
                self.refuse_strains(case, "speak of a time, such as `200 ps`, or load it with a `velocity`");
            }
        }
        self.rule_of_patches(case);
        let gauges = self.gauges(&case.observe, &laid);
        let solid = || {
            Some(Solid {
                material: material?,
                specimen: laid.specimen?,
                resolution: resolution?,
                notch: notch?,
                held: held?.map(|(held, _)| held),
                loading: loading?.0,
                gauges: gauges?,
            })
        };
        (solid().map(Body::Solid), run, vec![Table::AverageStress])
    }

    /// Planes of which the series tells; the outer `None` is a mistake.
    fn gauges(&self, observe: &Given<Vec<Given<Observe>>>, laid: &Laid) -> Option<Option<Gauges>> {
        let Some((gauges, place)) = self.gauges_asked(observe)? else {
            return Some(None);
        };
        let (axis, _) = self.axis(&gauges.axis, place, "gauges.axis", laid)?;
        let at = self.gauges_at(&gauges, place, laid.thickness(axis))?;
        Some(Some(Gauges { axis, at }))
    }

    /// Patches of bonds have rules of 3 and of 6 points.
    fn rule_of_patches(&self, case: &CaseFile) {
        let Some(file::Summation::Gauss(given)) = case.run.right().and_then(|run| run.summation.right()) else {
            return;
        };
        let points = match given.right() {
            Some(file::Gauss::Points(points)) => given.place().map(|place| (*points, place)),
            Some(file::Gauss::Rule(rule)) => rule.points.right().copied().zip(rule.points.place()),
            None => None,
        };
        if let Some((points, place)) = points.filter(|(points, _)| ![3, 6].contains(points)) {
            let message =
                format!("between the faces of two elements there are rules of 3 and of 6 points, not of {points}");
            self.add(Finding::at(place, message).help("write `summation: {gauss: 6}`, `{gauss: 3}` or `exact`"));
        }
    }
}
