//! `arrivals`: when a pulse passed each gauge, and its speed from the one before it, beside that of long waves.

use polars::prelude::Column;

use super::Analysed;
use crate::analysis::passage;
use crate::report::table::Rows;
use crate::report::units::{METRE_PER_SECOND, PERCENT};

/// A gauge of a case: where it stands, nm, when the pulse passed it, ps, and the same of the gauge before it.
pub struct Arrival<'a> {
    case: &'a Analysed<'a>,
    gauge: (f64, Option<f64>),
    before: Option<(f64, Option<f64>)>,
}

impl Arrival<'_> {
    /// nm/ps
    fn speed(&self) -> Option<f64> {
        let before = self.before?;
        passage::speed([(before.0, before.1?), (self.gauge.0, self.gauge.1?)])
    }

    fn of_long_waves(&self) -> Option<f64> {
        self.case.solid.specimen.wave_speed
    }
}

pub fn rows<'a>(cases: &'a [Analysed<'a>]) -> Vec<Arrival<'a>> {
    let of_case = |case: &'a Analysed<'a>| {
        let passages = &case.findings.passages;
        (0..passages.len()).map(move |place| Arrival {
            case,
            gauge: passages[place],
            before: place.checked_sub(1).map(|before| passages[before]),
        })
    };
    cases.iter().flat_map(of_case).collect()
}

pub fn columns(arrivals: Vec<Arrival>) -> Vec<Column> {
    let rows = Rows(arrivals);
    vec![
        rows.text("case", |row| row.case.name()),
        rows.number("at_nm", |row| row.gauge.0),
        rows.number("arrival_ps", |row| row.gauge.1),
        rows.number("from_nm", |row| row.before.map(|before| before.0)),
        rows.number("speed_m_per_s", |row| row.speed().map(|speed| speed * METRE_PER_SECOND)),
        rows.number("speed_of_long_waves_m_per_s", |row| {
            row.of_long_waves().map(|speed| speed * METRE_PER_SECOND)
        }),
        rows.number("difference_percent", |row| {
            Some(PERCENT * (row.speed()? / row.of_long_waves()? - 1.0))
        }),
    ]
}
