//! The tables of a study: each has a file with its columns, its rows, and what is said of them elsewhere on the page.

mod branches;
pub mod cheapest;
pub mod comparison;
mod cost;
mod crack_speed;
pub mod first_branch;
mod joins;
pub mod k_ic;
mod path;
mod repeats;
pub mod specimen;
pub mod speed_against_error;
mod stress;
mod summary;
pub mod wave_arrival;

use super::side_by_side::{self, Panel};
use super::sweep;
use super::table::Table;
use super::{Analysed, ReportError, scaling};
use crate::plan::{Comparison, SCALING};

/// The table of the cheapest choices.
const CHEAPEST: &str = "cheapest_choice";

/// All tables, in the order in which they are shown.
pub fn all(
    cases: &[Analysed],
    comparisons: &[Comparison],
    panels: &[Panel],
    scaling: Option<&scaling::Findings>,
) -> Result<Vec<Table>, ReportError> {
    let own = [
        ("summary", summary::columns(cases)),
        ("specimen", specimen::columns(cases)),
        ("crack_speed", crack_speed::columns(cases)),
        ("stress_profile", stress::profile(cases)),
        ("stress_strain", stress::against_strain(cases)),
        ("wave_arrival", wave_arrival::columns(cases, comparisons)),
        ("k_ic", k_ic::columns(cases, comparisons)),
        ("branches", branches::columns(cases)),
        ("first_branch", first_branch::columns(cases, comparisons)),
        ("joins", joins::columns(cases)),
        ("path", path::columns(cases)),
        ("cost", cost::columns(cases)),
    ];
    let make = |(name, columns)| Table::new(name, sweep::with_keys(columns, cases));
    let mut tables = own.into_iter().map(make).collect::<Result<Vec<_>, _>>()?;
    if cases.iter().any(|case| case.result.repeat_of.is_some()) {
        tables.push(Table::new("repeats", repeats::columns(cases))?);
        tables.push(Table::new("together", repeats::together(cases))?);
    }
    let precision = speed_against_error::rows(cases);
    if !precision.is_empty() {
        tables.push(make((CHEAPEST, cheapest::columns(&precision)))?);
        tables.push(make(("speed_against_error", speed_against_error::columns(precision)))?);
    }
    if let Some(scaling) = scaling {
        tables.push(make((SCALING, scaling::columns(scaling)))?);
    }
    if !comparisons.is_empty() {
        tables.push(make(("comparison", comparison::columns(comparisons, &tables)))?);
    }
    if !panels.is_empty() {
        tables.push(make(("side_by_side", side_by_side::columns(panels)))?);
    }
    Ok(tables)
}
