//! `summary`: a row a case.

use polars::prelude::Column;

use crate::report::Analysed;
use crate::report::table::Rows;
use crate::report::units::MEGAPASCAL_ROOT_METRE;

pub fn columns(cases: &[Analysed]) -> Vec<Column> {
    let rows = Rows(cases.iter().collect());
    let setting = |case: &&Analysed| case.result.setting.clone();
    let root_metre = |value: f64| value * MEGAPASCAL_ROOT_METRE;
    let mut columns = vec![
        rows.text("case", |case| &case.result.name),
        rows.count("nodes", |case| setting(case).map(|setting| setting.nodes)),
        rows.count("elements", |case| setting(case).map(|setting| setting.elements)),
        rows.count("represented_atoms", |case| {
            setting(case).map(|setting| setting.represented_atoms)
        }),
        rows.count("steps", |case| case.result.manifest.steps),
        rows.number("time_step_ps", |case| case.result.manifest.time_step),
        rows.number("wall_s", |case| case.result.manifest.wall_seconds),
        rows.number("atom_steps_per_s", |case| case.atom_steps_a_second()),
        rows.number("energy_error_relative", |case| case.result.manifest.energy_error),
        rows.number("closest_approach_spacings", |case| {
            case.result.manifest.closest_approach
        }),
        rows.number("cutoff_release_ev", |case| {
            case.result.series.probes.last().map(|row| row.cutoff_release)
        }),
        rows.number("initiation_strain", |case| {
            case.findings.initiation.map(|start| start.strain)
        }),
        rows.number("initiation_time_ps", |case| {
            case.findings.initiation.map(|start| start.time)
        }),
        rows.number("k_ic_near_tip_mpa_sqrt_m", |case| {
            case.findings.near_tip.map(|fit| root_metre(fit.value))
        }),
        rows.number("k_ic_j_integral_mpa_sqrt_m", |case| {
            case.findings.from_j.map(|j| root_metre(j.value))
        }),
        rows.number("k_griffith_mpa_sqrt_m", |case| case.findings.griffith.map(root_metre)),
        rows.number("peak_speed_over_c_r", |case| case.peak_speed_over_rayleigh()),
        rows.number("first_branch_time_ps", |case| {
            case.findings.first_branch().map(|branch| branch.time)
        }),
        rows.number("first_branch_strain", |case| {
            case.findings.first_branch().map(|branch| branch.strain)
        }),
    ];
    columns.extend(of_events(&rows));
    columns
}

/// What happens to the crack beside its start and its branches.
fn of_events(rows: &Rows<&Analysed>) -> Vec<Column> {
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
