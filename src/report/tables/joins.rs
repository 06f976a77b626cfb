//! `joins`: where a crack joined one ahead of it.

use polars::prelude::Column;

use crate::report::Analysed;
use crate::report::table::collect;

/// Where the tip was and stands now, and what parted the two cracks.
pub fn columns(cases: &[Analysed]) -> Vec<Column> {
    let rows = collect(cases, |case| case.findings.joins.iter().map(move |join| (case, join)));
    vec![
        rows.text("case", |row| row.0.name()),
        rows.number("time_ps", |row| row.1.time),
        rows.number("strain", |row| row.1.strain),
        rows.number("x_nm", |row| row.1.from.x),
        rows.number("y_nm", |row| row.1.from.y),
        rows.number("to_x_nm", |row| row.1.to.x),
        rows.number("to_y_nm", |row| row.1.to.y),
        rows.number("gap_nm", |row| row.1.gap),
    ]
}
