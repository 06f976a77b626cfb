//! `cheapest_choice`: of each specimen the cheapest case that is near enough to the finest, quantity by quantity.

use polars::prelude::Column;

use super::speed_against_error::{COST, Quantity, Row};
use crate::report::numbers::{ABSENT, significant};
use crate::report::overview::ROUNDING;
use crate::report::table::Rows;
use crate::report::units::PERCENT;

/// How near is near enough, percent.
const WITHIN: [f64; 4] = [1.0, 2.0, 5.0, 10.0];

/// What is recommended is within this of the finest in every quantity that is known of it, percent.
const RECOMMENDED: f64 = 5.0;

/// The answer for one quantity and one bound.
pub struct Choice<'a> {
    reference: &'a Row<'a>,
    quantity: Quantity,
    /// Percent.
    within: f64,
    /// The reference itself where nothing cheaper is near enough.
    pub case: &'a Row<'a>,
}

impl Choice<'_> {
    fn times_cheaper(&self) -> f64 {
        self.reference.cost / self.case.cost
    }
}

/// The rows of the finest cases, which others are measured against.
fn references<'a>(rows: &'a [Row<'a>]) -> impl Iterator<Item = &'a Row<'a>> {
    rows.iter().filter(|row| std::ptr::eq(row.case, row.reference))
}

/// The cases of a specimen that are cheaper than its finest.
fn cheaper<'a>(rows: &'a [Row<'a>], reference: &'a Row<'a>) -> impl Iterator<Item = &'a Row<'a>> {
    let of_it = rows.iter().filter(|row| std::ptr::eq(row.reference, reference.case));
    of_it.filter(|row| row.cost < reference.cost)
}

fn cheapest<'a>(of: impl Iterator<Item = &'a Row<'a>>) -> Option<&'a Row<'a>> {
    of.min_by(|a, b| a.cost.total_cmp(&b.cost))
}

/// All answers; none for a quantity in which nothing is known of any case.
pub fn choices<'a>(rows: &'a [Row<'a>]) -> Vec<Choice<'a>> {
    let mut found = Vec::new();
    for reference in references(rows) {
        for quantity in Quantity::ALL {
            if !cheaper(rows, reference).any(|row| row.error(quantity).is_some()) {
                continue;
            }
            for within in WITHIN {
                let is_near = |row: &&Row| row.error(quantity).is_some_and(|error| error * PERCENT <= within);
                found.push(Choice {
                    reference,
                    quantity,
                    within,
                    case: cheapest(cheaper(rows, reference).filter(is_near)).unwrap_or(reference),
                });
            }
        }
    }
    found
}

pub fn columns(rows: &[Row]) -> Vec<Column> {
    let rows = Rows(choices(rows));
    vec![
        rows.text("case", |choice| choice.case.case.name()),
        rows.text("reference", |choice| choice.reference.case.name()),
        rows.text("error", |choice| choice.quantity.column()),
        rows.number("within_percent", |choice| choice.within),
        rows.number(COST, |choice| choice.case.cost),
        rows.number("times_cheaper", Choice::times_cheaper),
    ]
}

/// Heads and rows for the page: a quantity a row, a bound a column, with how many times cheaper the choice is.
pub fn shown(rows: &[Row]) -> (Vec<String>, Vec<Vec<String>>) {
    let mut heads = vec!["quantity".to_owned()];
    heads.extend(WITHIN.map(|within| format!("within {within} %")));
    let several = references(rows).count() > 1;
    let choices = choices(rows);
    let cell = |choice: &Choice| match std::ptr::eq(choice.case, choice.reference) {
        true => ABSENT.to_owned(),
        false => format!(
            "{} ({} times cheaper)",
            choice.case.case.name(),
            significant(choice.times_cheaper(), 2)
        ),
    };
    let line = |choices: &[Choice]| {
        let quantity = choices[0].quantity.words();
        let head = match several {
            true => format!("{quantity}, of {}", choices[0].reference.case.name()),
            false => quantity.to_owned(),
        };
        std::iter::once(head).chain(choices.iter().map(cell)).collect()
    };
    (heads, choices.chunks(WITHIN.len()).map(line).collect())
}

/// `Take mixed: within 5 % of atoms in all that is measured, as far as probes tell, and 3.2 times cheaper.`
pub fn recommendations(rows: &[Row]) -> Vec<String> {
    let of = |reference: &Row| {
        let errors = |row: &Row| {
            let told = |quantity| row.error(quantity).map(|error| (error, row.probe(quantity)));
            Quantity::ALL.map(told)
        };
        let wanted: Vec<bool> = (0..Quantity::ALL.len())
            .map(|index| cheaper(rows, reference).any(|row| errors(row)[index].is_some()))
            .collect();
        let is_near = |row: &&Row| {
            let mut known = errors(row).into_iter().zip(&wanted).filter(|(_, wanted)| **wanted);
            known.all(|(told, _)| {
                told.is_some_and(|(error, probe)| error * PERCENT <= RECOMMENDED || error <= ROUNDING * probe)
            })
        };
        let name = reference.case.name();
        match cheapest(cheaper(rows, reference).filter(is_near)) {
            Some(row) => format!(
                "Take {}: within {RECOMMENDED} % of {name} in all that is measured, as far as probes tell, and {} times \
                 cheaper.",
                row.case.name(),
                significant(reference.cost / row.cost, 2)
            ),
            None => format!("Take {name}: nothing cheaper is within {RECOMMENDED} % of it in all that is measured."),
        }
    };
    references(rows).map(of).collect()
}
