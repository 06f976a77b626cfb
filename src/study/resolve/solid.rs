//! A solid: material, specimen, elements, notch, held faces, loading and gauges together.

mod faces;
mod loading;
mod notch;
mod resolution;
mod specimen;

use super::{At, Check, Table};
/// The types of a resolved solid.
use crate::study::case::solid as case;
use crate::study::{
    case::{Body, Run, Solid, solid::Gauges},
    file::{self, CaseFile, Observe},
    finding::{Finding, Place},
    reader::Given,
};
use specimen::Laid;

/// More gauges than this hide what they show.
const MOST_GAUGES: usize = 100;

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
            self.strains(case, &loading.0);
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
        let mut asked = observe.right().into_iter().flatten().filter_map(|item| match item {
            Given::Right(Observe::Gauges(gauges), place) => Some((gauges, *place)),
            _ => None,
        });
        let Some((gauges, place)) = asked.next() else {
            return Some(None);
        };
        if let Some((_, second)) = asked.next() {
            let finding = Finding::at(second, "gauges are asked for twice").with(place, "here first");
            self.add(finding.help("keep one of the two, with all places in its `at`"));
            return None;
        }
        let (axis, _) = self.axis(&gauges.axis, place, "gauges.axis", laid)?;
        let (at, list) = self.need(&gauges.at, place, "gauges.at", "[10 nm, 20 nm]")?;
        if at.is_empty() || at.len() > MOST_GAUGES {
            let message = format!("there are from 1 to {MOST_GAUGES} gauges, and here are {}", at.len());
            self.add(Finding::at(list, message).help("write for example `at: [10 nm, 20 nm]`"));
            return None;
        }
        let mut planes = Vec::new();
        for given in &at {
            let Given::Right(plane, place) = given else { return None };
            planes.push(self.inside(axis, (plane.value, *place), laid)?);
        }
        Some(Some(Gauges { axis, at: planes }))
    }

    /// A place along an axis that is within the specimen.
    fn inside(&self, axis: case::Axis, (at, place): At<f64>, laid: &Laid) -> Option<f64> {
        let thickness = laid.thickness(axis);
        if at > 0.0 && thickness.is_none_or(|thickness| at < thickness) {
            return Some(at);
        }
        let message = match thickness {
            Some(thickness) => format!(
                "this is not inside: from face to face the specimen is {} thick here",
                super::about(thickness)
            ),
            None => "this is not inside: it is measured from the low face of its axis".to_owned(),
        };
        self.add(Finding::at(place, message).help("write a length from the low face that ends before the high one"));
        None
    }

    /// What speaks of a strain needs a loading that makes one.
    fn strains(&self, case: &CaseFile, loading: &case::Loading) {
        if matches!(loading, case::Loading::Velocity { .. }) {
            return;
        }
        const HELP: &str = "speak of a time, such as `200 ps`, or load it with a `velocity`";
        let until = case.run.right().and_then(|run| run.until.right());
        if let Some(place) = until.and_then(|until| until.strain.place()) {
            let message = "this loading makes no strain of its own, at which the run could end";
            self.add(Finding::at(place, message).help(HELP));
        }
        for item in case.observe.right().into_iter().flatten() {
            if let Given::Right(Observe::Snapshots(snapshots), _) = item
                && let Given::Right(file::Interval::Strain(_), place) = snapshots.every
            {
                let message = "this loading makes no strain of its own, by which pictures could be taken";
                self.add(Finding::at(place, message).help(HELP));
            }
        }
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
