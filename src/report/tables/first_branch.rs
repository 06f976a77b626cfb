//! When the crack first branches, and which waves are back at its tip by then.

use polars::prelude::Column;

use super::wave_arrival::{path_name, wave_name};
use crate::analysis::crack::leaving::LEAVES_PLANE_SPACINGS;
use crate::analysis::crack::{SPUR_ELEMENTS, SPUR_SPACINGS};
use crate::analysis::history::LeavesPlane;
use crate::analysis::initiation::ARREST_SPEED;
use crate::analysis::waves::Arrival;
use crate::plan::{self, Comparison};
use crate::report::Analysed;
use crate::report::numbers::significant;
use crate::report::table::Rows;

/// Time of the first branch after the crack has started, ps.
pub fn after_start(case: &Analysed) -> Option<f64> {
    Some(case.findings.first_branch()?.time - case.findings.initiation?.time)
}

/// Between which times the source of a comparison saw it, ps after the start.
pub fn reference(case: &Analysed, comparisons: &[Comparison]) -> [Option<f64>; 2] {
    ["reference_from_ps", "reference_to_ps"]
        .map(|column| plan::reference(comparisons, "first_branch", column, case.name(), &[]))
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
    columns.extend(leaving_columns(&rows));
    columns
}

/// When the crack leaves its plane.
fn leaving_columns(rows: &Rows<&Analysed>) -> Vec<Column> {
    let left = |case: &&Analysed| case.findings.leaves_plane;
    vec![
        rows.number("leaves_plane_time_ps", |case| left(case).map(|left| left.time)),
        rows.number("leaves_plane_after_start_ps", |case| leaves_after_start(case)),
        rows.number("leaves_plane_strain", |case| left(case).map(|left| left.strain)),
        rows.number("leaves_plane_x_nm", |case| left(case).map(|left| left.x)),
        rows.number("leaves_plane_y_nm", |case| left(case).map(|left| left.y)),
        rows.number("first_off_plane_after_start_ps", |case| {
            after(case, |left| left.first_off_time)
        }),
    ]
}

/// Time after the start of the crack at which it leaves its plane, ps.
pub fn leaves_after_start(case: &Analysed) -> Option<f64> {
    after(case, |left| left.time)
}

fn after(case: &Analysed, time: fn(LeavesPlane) -> f64) -> Option<f64> {
    Some(time(case.findings.leaves_plane?) - case.findings.initiation?.time)
}

/// The first branches beside those of the source.
pub fn agreement(cases: &[Analysed], comparisons: &[Comparison]) -> Option<String> {
    beside_the_pictures(cases, comparisons, after_start, "no branch up to the end of the run")
}

/// The source calls branching what it sees in its pictures, and a crack that turns aside looks alike there.
pub fn leaving_the_plane(cases: &[Analysed], comparisons: &[Comparison]) -> Option<String> {
    beside_the_pictures(
        cases,
        comparisons,
        leaves_after_start,
        "in its plane up to the end of the run",
    )
}

/// When something happens to each crack, ps after its start, beside the pictures between which the source saw it branch.
fn beside_the_pictures(
    cases: &[Analysed],
    comparisons: &[Comparison],
    after_start: impl Fn(&Analysed) -> Option<f64>,
    never: &str,
) -> Option<String> {
    let line = |case: &Analysed| {
        let [Some(from), Some(to)] = reference(case, comparisons) else {
            return None;
        };
        case.findings.initiation?;
        let source = format!("the source between {from:.0} and {to:.0} ps");
        Some(match after_start(case) {
            Some(time) => {
                let order = match time {
                    _ if time < from => "earlier than",
                    _ if time > to => "later than",
                    _ => "as in",
                };
                let time = significant(time, 3);
                format!("{}: {time} ps after the crack starts, {order} {source}", case.name())
            }
            None => format!("{}: {never}; {source}", case.name()),
        })
    };
    let lines: Vec<String> = cases.iter().filter_map(line).collect();
    (!lines.is_empty()).then(|| format!("{}.", lines.join("; ")))
}

/// The waves that are back at the tip when it branches.
pub fn waves(cases: &[Analysed]) -> Option<String> {
    let line = |case: &Analysed| {
        after_start(case)?;
        let waves = waves_before(case);
        Some(match waves.is_empty() {
            true => format!("{}: none", case.name()),
            false => format!("{}: {}", case.name(), waves.join(", ")),
        })
    };
    let lines: Vec<String> = cases.iter().filter_map(line).collect();
    (!lines.is_empty()).then(|| {
        format!(
            "By their speeds and the path of the tip are back at it by then: {}.",
            lines.join("; ")
        )
    })
}

/// What branching and leaving the plane mean here.
pub fn method() -> Vec<(&'static str, String)> {
    vec![
        (
            "Leaves the plane",
            format!(
                "When a broken path from the notch first reaches {LEAVES_PLANE_SPACINGS} spacings from the crack plane, and where; beside \
                 it when the first bond of that path off the plane broke. A crack that joins one that has opened ahead of it \
                 is told in the table joins: that is neither a speed nor a branch."
            ),
        ),
        (
            "Branches",
            format!(
                "Side paths of at least {SPUR_SPACINGS} spacings (and {SPUR_ELEMENTS} element edges) that end at least \
                 half of that away from the others. The angle is that of their first stretch, from the x axis. \
                 Arrested means slower than {ARREST_SPEED} c_R over the last such length."
            ),
        ),
    ]
}
