//! How far cases are from each other, beside how near a study would have them.
//!
//! Small differences grow in a running crack. What single runs differ by is told as such, and judged by nobody; that
//! of repeats is judged by what they scatter by.

use super::{Panel, Side};
use crate::analysis::scatter::Scatter;
use crate::report::numbers::{signed_percent, significant, tick};
use crate::report::quantity::{Quantity, signed};
use crate::report::repeats::TOLD;
use crate::report::units::PERCENT;

impl Panel<'_> {
    /// How near a case is to come to the first: of the strain at initiation a share, of the first branch a time in ps.
    pub(super) fn asked(&self, quantity: Quantity) -> Option<f64> {
        match quantity {
            Quantity::InitiationStrain => self.set?.initiation_strain,
            Quantity::BranchTime => self.set?.first_branch,
            _ => None,
        }
    }

    /// What half of the repeats of a case scatter by, or those of the first where that is more; `None` where either has no
    /// repeats, or only such as have not parted.
    pub(super) fn scatter(&self, side: &Side, quantity: Quantity) -> Option<f64> {
        let [own, first] = [side, self.first()].map(|side| side.scatter(quantity).filter(Scatter::has_parted));
        Some(own?.width().max(first?.width()))
    }

    /// A sentence for each case and each thing that is asked or has repeats.
    pub fn differences(&self) -> Vec<String> {
        let others = self.sides.iter().skip(1);
        let all = others.flat_map(|side| TOLD.map(|quantity| self.difference(quantity, side)));
        all.flatten().collect()
    }

    /// `D2 beside D, strain at initiation: differs by +0.4 %; within 2 % was asked for.` With repeats it is judged: `late beside
    /// early, first branch: medians differ by +13 ps, scatter 46 ps: no difference seen.`
    fn difference(&self, quantity: Quantity, side: &Side) -> Option<String> {
        let asked = self.asked(quantity);
        let has_repeats = side.repeats.is_some() && self.first().repeats.is_some();
        if asked.is_none() && !has_repeats {
            return None;
        }
        let what = match quantity {
            Quantity::BranchTime if !has_repeats => "first branch".to_owned(),
            Quantity::InitiationStrain if !has_repeats => "strain at initiation".to_owned(),
            _ => quantity.label(),
        };
        let [own, first] = [side, self.first()].map(|side| side.value(quantity));
        let is_time = matches!(
            quantity,
            Quantity::BranchTime | Quantity::InitiationTime | Quantity::ArrestTime
        );
        let found = match (own, first) {
            (Some(own), Some(first)) if has_repeats => self.judged(quantity, side, [own, first]),
            (Some(own), Some(first)) if is_time => format!("differs by {}", signed(own - first, "ps")),
            (Some(own), Some(first)) => format!("differs by {}", signed_percent(own / first - 1.0)),
            (None, None) if has_repeats => return None,
            (None, None) => "in neither".to_owned(),
            (Some(_), None) => format!("in {} alone", side.name()),
            (None, Some(_)) => format!("in {} alone", self.first().name()),
        };
        let asked = asked.map(|asked| match quantity {
            Quantity::BranchTime => format!("; within {} ps was asked for", tick(asked)),
            _ => format!("; within {} % was asked for", tick(asked * PERCENT)),
        });
        let [own, first] = [side.name(), self.first().name()];
        Some(format!(
            "{own} beside {first}, {what}: {found}{}.",
            asked.unwrap_or_default()
        ))
    }

    /// Whether medians differ by more than half of the repeats scatter by.
    fn judged(&self, quantity: Quantity, side: &Side, [own, first]: [f64; 2]) -> String {
        let Some(scatter) = self.scatter(side, quantity) else {
            return "not sampled, as repeats have not parted".to_owned();
        };
        let difference = quantity.difference(own, first);
        let verdict = match difference.abs() > scatter {
            true => "they differ",
            false => "no difference seen",
        };
        let [difference, scatter] = [difference, scatter].map(|value| significant(value, 3));
        format!("medians differ by {difference}, half of the repeats scatter by {scatter}: {verdict}")
    }
}
