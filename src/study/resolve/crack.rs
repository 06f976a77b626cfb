//! The notch: where it lies, and whether it fits into its specimen.

use super::{At, Check, nanometres, specimen::SpecimenAt};
use crate::study::{
    case::{Crack, Edge, NotchEnd},
    defaults, file,
    finding::{Finding, Place},
    reader::Given,
};

impl Check<'_> {
    /// The outer `None` is a mistake, the inner one the absence of a crack.
    pub fn crack(&self, given: &Given<file::Crack>, specimen: &SpecimenAt) -> Option<Option<At<Crack>>> {
        let (values, place) = match given {
            Given::Absent => return Some(None),
            Given::Wrong(_) => return None,
            Given::Right(values, place) => (values, *place),
        };
        let edge = self.edge(values, place);
        let end = self.notch_end(values);
        let (length, at) = self.size(&values.length, place, "crack.length")?;
        let (edge, end) = (edge?, end?);
        let fits = match edge {
            Edge::Left | Edge::Right => self.is_shorter(length, at, specimen),
            Edge::None { center } => self.is_inside(center, length, at, specimen),
        };
        fits.then_some(Some((Crack { edge, length, end }, at)))
    }

    fn edge(&self, values: &file::Crack, section: Place) -> Option<Edge> {
        let edge = match &values.edge {
            Given::Absent => defaults::EDGE,
            Given::Wrong(_) => return None,
            Given::Right(file::Edge::Left, _) => Edge::Left,
            Given::Right(file::Edge::Right, _) => Edge::Right,
            Given::Right(file::Edge::None, _) => {
                let (center, _) = self.size(&values.center, section, "crack.center")?;
                return Some(Edge::None { center });
            }
        };
        let Some(place) = values.center.place() else {
            return Some(edge);
        };
        let name = if edge == Edge::Right { "right" } else { "left" };
        let message = format!("`crack.center` is for a notch inside, and this one begins at the {name} edge");
        let finding = Finding::at(place, message);
        let finding = match values.edge.place() {
            Some(given) => finding.with(given, "here"),
            None => finding,
        };
        self.add(finding.help("write `edge: none` for a notch inside, or leave `center` out"));
        None
    }

    /// The outer `None` is a mistake.
    fn notch_end(&self, values: &file::Crack) -> Option<Option<NotchEnd>> {
        let (end, place) = match &values.end {
            Given::Absent => return Some(None),
            Given::Wrong(_) => return None,
            Given::Right(file::NotchEnd::Corner, place) => (NotchEnd::Corner, *place),
            Given::Right(file::NotchEnd::MidEdge, place) => (NotchEnd::MidEdge, *place),
        };
        if let Given::Right(file::Edge::None, given) = values.edge {
            let message = "`crack.end` moves the end of a notch from an edge, and a notch inside has two";
            let finding = Finding::at(place, message).with(given, "it lies inside");
            self.add(finding.help(
                "leave it out, also in what the case starts from: the notch ends where `center` and `length` say",
            ));
            return None;
        }
        Some(Some(end))
    }

    fn is_shorter(&self, length: f64, at: Place, specimen: &SpecimenAt) -> bool {
        let Some((whole, given)) = specimen.length.filter(|(whole, _)| length >= *whole) else {
            return true;
        };
        let compared = if length > whole { "longer than" } else { "as long as" };
        let message = format!(
            "the crack ({}) is {compared} the specimen ({})",
            nanometres(length),
            nanometres(whole)
        );
        let help = "shorten the crack or lengthen the specimen";
        self.add(Finding::at(at, message).with(given, "the specimen").help(help));
        false
    }

    fn is_inside(&self, center: f64, length: f64, at: Place, specimen: &SpecimenAt) -> bool {
        let [from, to] = [center - 0.5 * length, center + 0.5 * length];
        let too_far_left = from <= 0.0;
        let too_far_right = specimen.length.filter(|(whole, _)| to >= *whole);
        if !too_far_left && too_far_right.is_none() {
            return true;
        }
        let edges = match (too_far_left, too_far_right) {
            (true, Some(_)) => "both edges",
            (true, None) => "the left edge",
            (false, _) => "the right edge",
        };
        let message = format!(
            "a notch of {} around {} reaches {edges} of the specimen",
            nanometres(length),
            nanometres(center)
        );
        let finding = Finding::at(at, message);
        let finding = match too_far_right {
            Some((_, given)) => finding.with(given, "the specimen"),
            None => finding,
        };
        self.add(finding.help("shorten it or move `center`; a crack from an edge is `edge: left` or `edge: right`"));
        false
    }
}
