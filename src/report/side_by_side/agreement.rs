//! Whether cases agree, where a study says how near they must come.

use super::quantity::{Quantity, signed};
use super::{Panel, Side};
use crate::report::Analysed;
use crate::report::numbers::{signed_percent, tick};
use crate::report::units::PERCENT;

/// What may be asked for.
const ASKED: [Quantity; 2] = [Quantity::InitiationStrain, Quantity::BranchTime];

/// So that what is allowed is still allowed however it was rounded.
const ROUNDING: f64 = 1.0 + 1e-9;

impl Panel<'_> {
    /// How far a case may be from the first: of the strain at initiation a share, of the first branch a time in ps.
    pub(super) fn allowed(&self, quantity: Quantity) -> Option<f64> {
        match quantity {
            Quantity::InitiationStrain => self.set?.initiation_strain,
            Quantity::BranchTime => self.set?.first_branch,
            _ => None,
        }
    }

    /// Whether a case is that near to the first; `None` where nothing is asked or nothing can be told. Cracks that run to
    /// the end and do not branch agree in that.
    pub(super) fn agrees(&self, quantity: Quantity, side: &Side) -> Option<bool> {
        let allowed = self.allowed(quantity)?;
        let cases = [side.case, self.first()];
        let has_ended = |case: &Analysed| case.result.manifest.state == "done" && case.findings.initiation.is_some();
        match cases.map(|case| quantity.value(case)) {
            [Some(own), Some(first)] => Some(distance(quantity, own, first).abs() <= allowed * ROUNDING),
            [None, None] if quantity == Quantity::BranchTime => {
                cases.iter().all(|case| has_ended(case)).then_some(true)
            }
            _ => cases.iter().all(|case| has_ended(case)).then_some(false),
        }
    }

    /// A sentence for each case and each thing that is asked.
    pub fn verdicts(&self) -> Vec<String> {
        let others = self.sides.iter().skip(1);
        let all = others.flat_map(|side| ASKED.map(|quantity| self.verdict(quantity, side)));
        all.flatten().collect()
    }

    /// `D2 beside D, strain at initiation: +0.4 %, within 2 %: passes.`
    fn verdict(&self, quantity: Quantity, side: &Side) -> Option<String> {
        let allowed = self.allowed(quantity)?;
        let (what, allowed) = match quantity {
            Quantity::BranchTime => ("first branch", format!("{} ps", tick(allowed))),
            _ => ("strain at initiation", format!("{} %", tick(allowed * PERCENT))),
        };
        let [own, first] = [side.case, self.first()].map(|case| quantity.value(case));
        let found = match (own, first) {
            (Some(own), Some(first)) if quantity == Quantity::BranchTime => signed(own - first, "ps"),
            (Some(own), Some(first)) => signed_percent(own / first - 1.0),
            (None, None) => "in neither".to_owned(),
            (Some(_), None) => format!("in {} alone", side.case.name()),
            (None, Some(_)) => format!("in {} alone", self.first().name()),
        };
        let verdict = match self.agrees(quantity, side) {
            Some(true) => "passes",
            Some(false) => "fails",
            None => "cannot be told",
        };
        let [own, first] = [side.case.name(), self.first().name()];
        Some(format!(
            "{own} beside {first}, {what}: {found}; {allowed} allowed: {verdict}."
        ))
    }
}

/// How far a value is from that of the first, as it is asked for.
fn distance(quantity: Quantity, own: f64, first: f64) -> f64 {
    match quantity {
        Quantity::BranchTime => own - first,
        _ => own / first - 1.0,
    }
}
