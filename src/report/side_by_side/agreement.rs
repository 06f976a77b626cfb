//! How far cases are from each other, beside how near a study would have them.
//!
//! Small differences grow in a running crack. What single runs differ by is told as such, and judged by nobody until the
//! scatter between repeats is known.

use super::quantity::{Quantity, signed};
use super::{Panel, Side};
use crate::report::numbers::{signed_percent, tick};
use crate::report::units::PERCENT;

/// What may be asked for.
const ASKED: [Quantity; 2] = [Quantity::InitiationStrain, Quantity::BranchTime];

impl Panel<'_> {
    /// How near a case is to come to the first: of the strain at initiation a share, of the first branch a time in ps.
    pub(super) fn asked(&self, quantity: Quantity) -> Option<f64> {
        match quantity {
            Quantity::InitiationStrain => self.set?.initiation_strain,
            Quantity::BranchTime => self.set?.first_branch,
            _ => None,
        }
    }

    /// A sentence for each case and each thing that is asked.
    pub fn differences(&self) -> Vec<String> {
        let others = self.sides.iter().skip(1);
        let all = others.flat_map(|side| ASKED.map(|quantity| self.difference(quantity, side)));
        all.flatten().collect()
    }

    /// `D2 beside D, strain at initiation: differs by +0.4 %; within 2 % was asked for.`
    fn difference(&self, quantity: Quantity, side: &Side) -> Option<String> {
        let asked = self.asked(quantity)?;
        let (what, asked) = match quantity {
            Quantity::BranchTime => ("first branch", format!("{} ps", tick(asked))),
            _ => ("strain at initiation", format!("{} %", tick(asked * PERCENT))),
        };
        let [own, first] = [side.case, self.first()].map(|case| quantity.value(case));
        let found = match (own, first) {
            (Some(own), Some(first)) if quantity == Quantity::BranchTime => {
                format!("differs by {}", signed(own - first, "ps"))
            }
            (Some(own), Some(first)) => format!("differs by {}", signed_percent(own / first - 1.0)),
            (None, None) => "in neither".to_owned(),
            (Some(_), None) => format!("in {} alone", side.case.name()),
            (None, Some(_)) => format!("in {} alone", self.first().name()),
        };
        let [own, first] = [side.case.name(), self.first().name()];
        Some(format!(
            "{own} beside {first}, {what}: {found}; within {asked} was asked for."
        ))
    }
}
