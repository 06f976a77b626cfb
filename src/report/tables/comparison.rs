//! Values from elsewhere beside those of the cases.

use polars::prelude::Column;

use super::k_ic::Definition;
use crate::plan::{Comparison, Expected};
use crate::report::numbers::{ABSENT, count, signed_percent, significant};
use crate::report::table::{Rows, Table};

/// Digits of a value on the page.
const SHOWN_DIGITS: usize = 4;

/// A value of a case and the one it is compared with.
pub struct Line<'a> {
    /// File that the other value is from.
    source: &'a str,
    case: &'a str,
    /// Column of the tables.
    pub column: &'a str,
    /// What tells it from other values of the case in that column, such as `longitudinal; left face`.
    of: Option<String>,
    /// `None` where the case has no such value.
    pub measured: Option<f64>,
    pub reference: f64,
}

impl Line<'_> {
    /// How far the measured value is from the reference, over the reference.
    fn difference(&self) -> Option<f64> {
        self.measured
            .filter(|_| self.reference != 0.0)
            .map(|measured| measured / self.reference - 1.0)
    }

    /// Case, quantity, measured, reference, difference, as a person reads them.
    pub fn cells(&self) -> [String; 5] {
        let quantity = match &self.of {
            None => self.column.to_owned(),
            Some(of) => format!("{} ({of})", self.column),
        };
        let absent = || ABSENT.to_owned();
        [
            self.case.to_owned(),
            quantity,
            self.measured.map_or_else(absent, shown),
            shown(self.reference),
            self.difference().map_or_else(absent, signed_percent),
        ]
    }
}

/// Counts in full, other numbers rounded.
pub fn shown(value: f64) -> String {
    match value.fract() == 0.0 && value >= 1.0 {
        true => count(value as u64),
        false => significant(value, SHOWN_DIGITS),
    }
}

/// The lines of a comparison. What is compared with several quantities (of a wave prediction and measurement, of a
/// toughness every definition) stands beside each.
pub fn lines<'a>(comparison: &'a Comparison, tables: &[Table]) -> Vec<Line<'a>> {
    let table = tables.iter().find(|table| table.name == comparison.table);
    let line = |expected: &'a Expected, column: &'a str| Line {
        source: &comparison.file,
        case: &expected.case,
        column,
        of: words(expected),
        measured: table.and_then(|table| table.value(&expected.case, &expected.keys, column)),
        reference: expected.value,
    };
    let columns = |expected: &Expected| match expected.column {
        "reference_ps" => vec!["predicted_ps", "at_running_tip_ps", "measured_ps"],
        "reference_from_ps" | "reference_to_ps" => vec!["after_start_ps", "leaves_plane_after_start_ps"],
        "k_ic_reference_mpa_sqrt_m" => Definition::ALL.map(Definition::column).to_vec(),
        own => vec![own],
    };
    comparison
        .values
        .iter()
        .flat_map(|expected| columns(expected).into_iter().map(move |column| line(expected, column)))
        .collect()
}

fn words(expected: &Expected) -> Option<String> {
    let words: Vec<&str> = expected.keys.iter().map(|(_, word)| word.as_str()).collect();
    (!words.is_empty()).then(|| words.join("; "))
}

/// The columns of the table of all comparisons.
pub fn columns(comparisons: &[Comparison], tables: &[Table]) -> Vec<Column> {
    let rows = Rows(
        comparisons
            .iter()
            .flat_map(|comparison| lines(comparison, tables))
            .collect(),
    );
    vec![
        rows.text("case", |line| line.case),
        rows.text("quantity", |line| line.column),
        rows.word("of", |line| line.of.as_deref()),
        rows.number("measured", |line| line.measured),
        rows.number("reference", |line| line.reference),
        rows.number("relative_difference", Line::difference),
        rows.text("source", |line| line.source),
    ]
}
