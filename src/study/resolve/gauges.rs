//! Where gauges stand.

use super::{At, Check};
use crate::study::{
    file::{self, Observe},
    finding::{Finding, Place},
    reader::Given,
};

/// More gauges than this hide what they show.
const MOST_GAUGES: usize = 100;

impl Check<'_> {
    /// The gauges asked for; the outer `None` is a mistake.
    pub fn gauges_asked(&self, observe: &Given<Vec<Given<Observe>>>) -> Option<Option<At<file::Gauges>>> {
        let mut asked = observe.right().into_iter().flatten().filter_map(|item| match item {
            Given::Right(Observe::Gauges(gauges), place) => Some((gauges.clone(), *place)),
            _ => None,
        });
        let first = asked.next();
        if let (Some((_, place)), Some((_, second))) = (&first, asked.next()) {
            let finding = Finding::at(second, "gauges are asked for twice").with(*place, "here first");
            self.add(finding.help("keep one of the two, with all places in its `at`"));
            return None;
        }
        Some(first)
    }

    /// Where they stand along their axis, whose specimen is so thick there, nm, if that is known.
    pub fn gauges_at(&self, gauges: &file::Gauges, section: Place, thickness: Option<f64>) -> Option<Vec<f64>> {
        let (at, list) = self.need(&gauges.at, section, "gauges.at", "[10 nm, 20 nm]")?;
        if at.is_empty() || at.len() > MOST_GAUGES {
            let message = format!("there are from 1 to {MOST_GAUGES} gauges, and here are {}", at.len());
            self.add(Finding::at(list, message).help("write for example `at: [10 nm, 20 nm]`"));
            return None;
        }
        let mut planes = Vec::new();
        for given in &at {
            let Given::Right(plane, place) = given else { return None };
            planes.push(self.inside((plane.value, *place), thickness)?);
        }
        Some(planes)
    }

    /// A place along an axis that is within the specimen.
    pub fn inside(&self, (at, place): At<f64>, thickness: Option<f64>) -> Option<f64> {
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
}
