//! `branches`: the arms of each crack at the end of its run.

use polars::prelude::Column;

use crate::report::Analysed;
use crate::report::table::collect;

/// The main crack has no parent; it is born at initiation, at the end of the notch.
pub fn columns(cases: &[Analysed]) -> Vec<Column> {
    let rows = collect(cases, |case| {
        let started = case.findings.initiation.map(|_| &case.findings.branches);
        started
            .into_iter()
            .flatten()
            .zip(0..)
            .map(move |(branch, index)| (case, branch, index))
    });
    let start = |row: &(&Analysed, _, u64)| row.0.findings.initiation.filter(|_| row.2 == 0);
    let notch = |row: &(&Analysed, _, u64)| row.0.findings.tips.first().filter(|_| row.2 == 0).copied();
    vec![
        rows.text("case", |row| &row.0.result.name),
        rows.count("branch", |row| row.2),
        rows.count("parent", |row| row.1.parent.map(|parent| parent as u64)),
        rows.number("time_ps", |row| start(row).map_or(row.1.time, |start| start.time)),
        rows.number("strain", |row| start(row).map_or(row.1.strain, |start| start.strain)),
        rows.number("x_nm", |row| notch(row).map_or(row.1.x, |tip| tip.x)),
        rows.number("y_nm", |row| notch(row).map_or(row.1.y, |tip| tip.y)),
        rows.number("angle_deg", |row| row.1.parent.map(|_| row.1.angle)),
        rows.flag("arrested", |row| Some(row.1.arrested)),
    ]
}
