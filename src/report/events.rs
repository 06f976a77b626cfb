//! What happens to a crack, as columns and tables: its first bond, its joins, when it leaves its plane, every broken bond.

use polars::prelude::Column;

use super::Analysed;
use super::tables::Rows;
use crate::analysis::history::LeavesPlane;
use crate::analysis::path;

/// Columns of the table `summary`, beside those of initiation and branch.
pub fn columns(rows: &Rows<&Analysed>) -> Vec<Column> {
    vec![
        rows.number("first_bond_strain", |case| {
            case.findings.first_bond.map(|bond| bond.strain)
        }),
        rows.number("first_bond_time_ps", |case| {
            case.findings.first_bond.map(|bond| bond.time)
        }),
        rows.number("speed_share", |case| case.findings.speed_share),
        rows.count("joins", |case| {
            case.findings.initiation.map(|_| case.findings.joins.len() as u64)
        }),
        rows.number("leaves_plane_time_ps", |case| {
            case.findings.leaves_plane.map(|left| left.time)
        }),
        rows.number("leaves_plane_strain", |case| {
            case.findings.leaves_plane.map(|left| left.strain)
        }),
        rows.number("parted_elsewhere_strain", |case| {
            case.findings.parted_elsewhere.map(|band| band.strain)
        }),
    ]
}

/// Columns of the table `first_branch`, beside those of the branch.
pub fn leaving_columns(rows: &Rows<&Analysed>) -> Vec<Column> {
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

/// The table `joins`: where the tip was and stands now, and what parted the two cracks.
pub fn joins(cases: &[Analysed]) -> Vec<Column> {
    let joins = |case: &'_ Analysed| case.findings.joins.clone();
    let rows = cases
        .iter()
        .flat_map(|case| joins(case).into_iter().map(move |join| (case, join)));
    let rows = Rows(rows.collect());
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

/// The table `path`: every bond that broke, its middle and its direction.
pub fn path(cases: &[Analysed]) -> Vec<Column> {
    let bonds = |case: &Analysed| {
        let setting = case.result.setting.as_ref();
        setting.map_or_else(Vec::new, |setting| path::broken_bonds(&case.result.series, setting))
    };
    let rows = cases
        .iter()
        .flat_map(|case| bonds(case).into_iter().map(move |bond| (case, bond)));
    let rows = Rows(rows.collect());
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
