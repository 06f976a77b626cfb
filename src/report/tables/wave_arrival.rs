//! `wave_arrival`: when each wave is back at the tip.

use polars::prelude::Column;

use crate::analysis::waves::{Arrival, Face, Wave};
use crate::plan::{Comparison, reference};
use crate::report::Analysed;
use crate::report::table::collect;

pub fn columns(cases: &[Analysed], comparisons: &[Comparison]) -> Vec<Column> {
    let rows = collect(cases, |case| {
        case.findings.arrivals.iter().map(move |arrival| (case, arrival))
    });
    vec![
        rows.text("case", |row| &row.0.result.name),
        rows.text("wave", |row| wave_name(row.1)),
        rows.text("path", |row| path_name(row.1)),
        rows.number("predicted_ps", |row| row.1.predicted),
        rows.number("measured_ps", |row| row.1.measured),
        rows.number("reference_ps", |row| {
            let keys = [wave_name(row.1), path_name(row.1)];
            reference(comparisons, "wave_arrival", "reference_ps", row.0.name(), &keys)
        }),
        rows.number("at_running_tip_ps", |row| row.1.at_running_tip),
    ]
}

/// The word of its column.
pub fn wave_name(arrival: &Arrival) -> &'static str {
    match arrival.wave {
        Wave::Longitudinal => "longitudinal",
        Wave::Transverse => "transverse",
        Wave::Rayleigh => "rayleigh",
    }
}

/// The word of its column.
pub fn path_name(arrival: &Arrival) -> &'static str {
    match arrival.face {
        Face::Left => "left face",
        Face::Right => "right face",
        Face::TopAndBottom => "top and bottom faces",
    }
}
