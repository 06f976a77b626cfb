//! `wave_arrival`: when each wave is back at the tip.

use polars::prelude::Column;

use crate::analysis::waves::{AFTER_SHARE, Arrival, BEFORE_SHARE, Face, LEAST_RIVALS, LEAST_SCATTERS, WINDOW, Wave};
use crate::plan::{Comparison, reference};
use crate::report::Analysed;
use crate::report::numbers::{mean, signed_percent, significant};
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

/// Why there may be no measured arrival.
pub fn not_measured(cases: &[Analysed]) -> Option<String> {
    let arrivals: Vec<_> = cases.iter().flat_map(|case| &case.findings.arrivals).collect();
    let missing = arrivals.iter().filter(|arrival| arrival.measured.is_none()).count();
    (missing > 0).then(|| {
        format!(
            "{missing} of {}: there no front stands out at the gauges from what the running crack sends past them, by the rule \
             under Method.",
            arrivals.len()
        )
    })
}

/// How far predicted and measured arrivals are from the source's.
pub fn agreement(cases: &[Analysed], comparisons: &[Comparison]) -> Option<String> {
    let mut offs = [const { Vec::new() }; 3];
    for case in cases {
        for arrival in &case.findings.arrivals {
            let keys = [wave_name(arrival), path_name(arrival)];
            let Some(known) = reference(comparisons, "wave_arrival", "reference_ps", case.name(), &keys) else {
                continue;
            };
            offs[0].push(arrival.predicted / known - 1.0);
            offs[1].extend(arrival.at_running_tip.map(|time| time / known - 1.0));
            offs[2].extend(arrival.measured.map(|measured| measured / known - 1.0));
        }
    }
    let largest = |offs: &[f64]| offs.iter().fold(0.0, |largest: f64, off| largest.max(off.abs()));
    let line = |kind: &str, offs: &[f64]| {
        format!(
            "{kind}: off the source's by {} on average and {} % at most, of {}",
            signed_percent(mean(offs)),
            significant(100.0 * largest(offs), 2),
            offs.len()
        )
    };
    let kinds = [
        "predicted at the end of the notch",
        "predicted at the running tip",
        "measured",
    ]
    .into_iter()
    .zip(&offs);
    let lines: Vec<String> = kinds
        .filter(|(_, offs)| !offs.is_empty())
        .map(|(kind, offs)| line(kind, offs))
        .collect();
    (!lines.is_empty()).then(|| format!("{}.", lines.join("; ")))
}

/// How arrivals are predicted and measured.
pub fn method() -> Vec<(&'static str, String)> {
    let percent = |share: f64| significant(share * 100.0, 3);
    vec![(
        "Waves",
        format!(
            "Arrivals at the tip, counted from initiation. Predicted: straight paths at the speeds of long waves, to a \
                 tip at rest and (at the running tip) to where it is by then. Measured: wave gauges halfway to the grips and \
                 halfway along the notch to its edge record the mean velocity v and stress σ of a patch; σ ± ρcv is what a plane wave brings back towards the tip, and is \
                 untouched by what leaves it. Where it bends most, where its mean over the next {} % of the predicted \
                 time lies farthest off its line over the {} % before, the wave is at the gauge, and the way from there \
                 is added. It is known to a probe, and comes late by up to half of the time in which the front rises. \
                 Absent where this bend is not {LEAST_SCATTERS} times the scatter before initiation and {LEAST_RIVALS} \
                 times any before it, or \
                 comes {} % before the prediction or {} % after it; behind cracks longer than half of the height, where other waves \
                 come first; and for Rayleigh waves, which have no plane front.",
            percent(AFTER_SHARE),
            percent(BEFORE_SHARE),
            percent(AFTER_SHARE),
            percent(WINDOW)
        ),
    )]
}
