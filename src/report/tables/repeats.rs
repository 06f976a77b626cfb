//! What the repeats of each case scatter by, and how long they stay together.

use polars::prelude::Column;

use crate::analysis::scatter::{Parting, Scatter};
use crate::report::Analysed;
use crate::report::quantity::Quantity;
use crate::report::repeats::{self, TOLD};
use crate::report::table::Rows;

struct Row<'a> {
    case: &'a str,
    amplitude: Option<f64>,
    repeats: u64,
    quantity: Quantity,
    scatter: Option<Scatter>,
}

/// A row for each case and quantity.
pub fn columns(cases: &[Analysed]) -> Vec<Column> {
    let mut rows = Vec::new();
    for repeats in repeats::all(cases) {
        rows.extend(TOLD.map(|quantity| Row {
            case: repeats.name,
            amplitude: repeats.amplitude(),
            repeats: repeats.cases.len() as u64,
            quantity,
            scatter: repeats.scatter(quantity),
        }));
    }
    let rows = Rows(rows);
    let number = |name: &str, of: fn(Scatter) -> f64| rows.number(name, move |row| row.scatter.map(of));
    vec![
        rows.text("case", |row| row.case),
        rows.number("amplitude_spacings", |row| row.amplitude),
        rows.count("repeats", |row| row.repeats),
        rows.text("quantity", |row| row.quantity.column()),
        rows.count("found_in", |row| row.scatter.map(|scatter| scatter.count as u64)),
        rows.flag("is_sampled", |row| row.scatter.map(|scatter| scatter.has_parted())),
        number("median", |scatter| scatter.median),
        number("lower_quartile", |scatter| scatter.lower),
        number("upper_quartile", |scatter| scatter.upper),
        number("least", |scatter| scatter.least),
        number("most", |scatter| scatter.most),
    ]
}

/// A row for each repeat but the first of its case.
pub fn together(cases: &[Analysed]) -> Vec<Column> {
    let all = repeats::all(cases);
    let mut rows: Vec<(&str, &str, Option<Parting>)> = Vec::new();
    for repeats in &all {
        let done = repeats
            .cases
            .iter()
            .filter(|case| !case.result.series.probes.is_empty());
        let others = done.skip(1).zip(repeats.partings());
        rows.extend(others.map(|(case, parting)| (repeats.name, case.name(), parting)));
    }
    let rows = Rows(rows);
    vec![
        rows.text("case", |row| row.0),
        rows.text("repeat", |row| row.1),
        rows.number("together_ps", |row| row.2.map(|parting| parting.time)),
        rows.count("together_steps", |row| row.2.map(|parting| parting.step)),
    ]
}
