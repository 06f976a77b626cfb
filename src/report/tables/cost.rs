//! `cost`: where the time of each run went.

use polars::prelude::Column;

use crate::report::Analysed;
use crate::report::table::collect;

pub fn columns(cases: &[Analysed]) -> Vec<Column> {
    let rows = collect(cases, |case| {
        case.result.manifest.cost.iter().map(move |phase| (case, phase))
    });
    let steps = |row: &(&Analysed, _)| row.0.result.manifest.steps.filter(|&steps| steps > 0);
    vec![
        rows.text("case", |row| &row.0.result.name),
        rows.count("ranks", |row| row.0.result.manifest.ranks.map(u64::from)),
        rows.count("threads", |row| row.0.result.manifest.threads.map(u64::from)),
        rows.text("phase", |row| &row.1.name),
        rows.count("calls", |row| row.1.calls),
        rows.number("seconds", |row| row.1.seconds),
        rows.number("seconds_per_step", |row| {
            steps(row).map(|steps| row.1.seconds / steps as f64)
        }),
    ]
}
