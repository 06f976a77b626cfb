//! When the crack first branches, and which waves are back at its tip by then.

use polars::prelude::Column;

use super::tables::{Rows, path_name, wave_name};
use super::{Analysed, events};
use crate::analysis::waves::Arrival;
use crate::plan::Comparison;

/// Time of the first branch after the crack has started, ps.
pub fn after_start(case: &Analysed) -> Option<f64> {
    Some(case.findings.first_branch()?.time - case.findings.initiation?.time)
}

/// Between which times the source of a comparison saw it, ps after the start.
pub fn reference(case: &Analysed, comparisons: &[Comparison]) -> [Option<f64>; 2] {
    ["reference_from_ps", "reference_to_ps"].map(|column| {
        let all = comparisons
            .iter()
            .filter(|comparison| comparison.table == "first_branch");
        let mut values = all.flat_map(|comparison| &comparison.values);
        let found = values.find(|expected| expected.case == case.name() && expected.column == column)?;
        Some(found.value)
    })
}

/// The waves that come back to the running tip while the run lasts, and when, ps after the start.
pub fn at_running_tip<'a>(case: &'a Analysed) -> impl Iterator<Item = (&'a Arrival, f64)> {
    let arrivals = case.findings.arrivals.iter();
    arrivals.filter_map(|arrival| Some((arrival, arrival.at_running_tip?)))
}

/// The waves that by their speeds are back at the tip before it branches, in order of time: `longitudinal from the top and
/// bottom faces (174 ps)`.
pub fn waves_before(case: &Analysed) -> Vec<String> {
    let Some(branch) = after_start(case) else {
        return Vec::new();
    };
    let mut arrivals: Vec<_> = at_running_tip(case).collect();
    arrivals.retain(|(_, time)| *time <= branch);
    arrivals.sort_by(|a, b| a.1.total_cmp(&b.1));
    let name = |(arrival, time): &(&Arrival, f64)| {
        let [wave, path] = [wave_name(arrival), path_name(arrival)];
        format!("{wave} from the {path} ({time:.0} ps)")
    };
    arrivals.iter().map(name).collect()
}

pub fn columns(cases: &[Analysed], comparisons: &[Comparison]) -> Vec<Column> {
    let rows = Rows(cases.iter().collect());
    let branch = |case: &&Analysed| case.findings.first_branch().cloned();
    let mut columns = vec![
        rows.text("case", |case: &&Analysed| case.name()),
        rows.number("time_ps", |case| branch(case).map(|branch| branch.time)),
        rows.number("strain", |case| branch(case).map(|branch| branch.strain)),
        rows.number("x_nm", |case| branch(case).map(|branch| branch.x)),
        rows.number("y_nm", |case| branch(case).map(|branch| branch.y)),
        rows.number("angle_deg", |case| branch(case).map(|branch| branch.angle)),
        rows.number("after_start_ps", |case| after_start(case)),
        rows.number("reference_from_ps", |case| reference(case, comparisons)[0]),
        rows.number("reference_to_ps", |case| reference(case, comparisons)[1]),
    ];
    columns.extend(events::leaving_columns(&rows));
    columns
}
