//! `stress_profile`: the stress ahead of the tip when the crack starts. `stress_strain`: mean stress and energies at every probe.

use polars::prelude::Column;

use crate::analysis::stress_intensity::Ahead;
use crate::report::Analysed;
use crate::report::table::collect;
use crate::report::units::GIGAPASCAL;

pub fn profile(cases: &[Analysed]) -> Vec<Column> {
    let rows = collect(cases, |case| case.findings.ahead.iter().map(move |row| (case, row)));
    let stress = |component: usize| move |row: &(&Analysed, &Ahead)| row.1.stress[component] * GIGAPASCAL;
    let traction = |axis: usize| move |row: &(&Analysed, &Ahead)| Some(row.1.traction?[axis] * GIGAPASCAL);
    vec![
        rows.text("case", |row| &row.0.result.name),
        rows.number("time_ps", |row| row.1.time),
        rows.number("distance_nm", |row| row.1.distance),
        rows.number("sigma_xx_gpa", stress(0)),
        rows.number("sigma_yy_gpa", stress(1)),
        rows.number("sigma_xy_gpa", stress(2)),
        rows.number("traction_x_gpa", traction(0)),
        rows.number("traction_y_gpa", traction(1)),
    ]
}

pub fn against_strain(cases: &[Analysed]) -> Vec<Column> {
    let rows = collect(cases, |case| {
        case.result.series.probes.iter().map(move |probe| (case, probe))
    });
    vec![
        rows.text("case", |row| &row.0.result.name),
        rows.number("time_ps", |row| row.1.time),
        rows.number("strain", |row| row.1.strain),
        rows.number("sigma_xx_gpa", |row| row.1.sigma_xx * GIGAPASCAL),
        rows.number("sigma_yy_gpa", |row| row.1.sigma_yy * GIGAPASCAL),
        rows.number("kinetic_energy_ev", |row| row.1.kinetic),
        rows.number("potential_energy_ev", |row| row.1.potential),
        rows.number("work_ev", |row| row.1.work),
        rows.number("cutoff_release_ev", |row| row.1.cutoff_release),
        rows.number("temperature_k", |row| row.1.temperature),
        rows.number("refined_energy_ev", |row| row.1.refined_energy),
        rows.number("nodes", |row| row.1.nodes),
        rows.number("outruns", |row| row.1.outruns),
    ]
}
