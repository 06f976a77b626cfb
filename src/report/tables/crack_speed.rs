//! `crack_speed`: tip and speed at every probe.

use polars::prelude::Column;

use crate::report::Analysed;
use crate::report::table::collect;
use crate::report::units::METRE_PER_SECOND;

pub fn columns(cases: &[Analysed]) -> Vec<Column> {
    let rows = collect(cases, |case| {
        let rows = case
            .result
            .series
            .probes
            .iter()
            .zip(&case.findings.tips)
            .zip(&case.findings.speeds);
        rows.map(move |((probe, tip), speed)| (case, probe, tip, *speed))
    });
    vec![
        rows.text("case", |row| &row.0.result.name),
        rows.number("time_ps", |row| row.1.time),
        rows.number("strain", |row| row.1.strain),
        rows.number("tip_x_nm", |row| row.2.x),
        rows.number("tip_y_nm", |row| row.2.y),
        rows.number("arc_length_nm", |row| row.2.arc_length),
        rows.number("speed_m_per_s", |row| row.3.map(|speed| speed.value * METRE_PER_SECOND)),
        rows.number("speed_over_c_r", |row| Some(row.3?.value / row.0.rayleigh_speed()?)),
        rows.number("speed_error_m_per_s", |row| {
            row.3.map(|speed| speed.error * METRE_PER_SECOND)
        }),
    ]
}
