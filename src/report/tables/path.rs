//! `path`: the broken bonds.

use polars::prelude::Column;

use crate::analysis::path;
use crate::report::Analysed;
use crate::report::table::collect;

/// Every bond that broke, its middle and its direction.
pub fn columns(cases: &[Analysed]) -> Vec<Column> {
    let bonds = |case: &Analysed| {
        let setting = case.result.setting.as_ref();
        setting.map_or_else(Vec::new, |setting| path::broken_bonds(&case.result.series, setting))
    };
    let rows = collect(cases, |case| bonds(case).into_iter().map(move |bond| (case, bond)));
    vec![
        rows.text("case", |row| row.0.name()),
        rows.number("time_ps", |row| row.1.time),
        rows.number("strain", |row| row.1.strain),
        rows.number("x_nm", |row| row.1.x),
        rows.number("y_nm", |row| row.1.y),
        rows.number("direction_deg", |row| row.1.direction),
        rows.flag("closed_again", |row| Some(row.1.closed)),
    ]
}
