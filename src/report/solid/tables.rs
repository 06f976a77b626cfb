//! The tables of solids.

mod arrivals;
mod surfaces;

use polars::prelude::Column;

use super::findings::Moment;
use super::overview::curve_distance;
use super::{Analysed, reference};
use crate::plan::{Comparison, SCALING};
use crate::report::table::{Rows, Table};
use crate::report::tables::comparison;
use crate::report::units::{GIGAPASCAL, METRE_PER_SECOND, PERCENT};
use crate::report::{ReportError, scaling};

/// All tables, in the order in which they are shown.
pub fn all(
    cases: &[Analysed],
    comparisons: &[Comparison],
    scaling: Option<&scaling::Findings>,
) -> Result<Vec<Table>, ReportError> {
    let own = [
        ("summary", summary(cases)),
        ("specimen", specimen(cases)),
        ("speed_against_error", speed_against_error(cases)),
        ("directions", surfaces::directions(cases)),
        ("surfaces", surfaces::surfaces(cases)),
        ("series", series(cases)),
        ("gauges", gauges(cases)),
        ("cost", cost(cases)),
    ];
    let arrivals = arrivals::rows(cases);
    let arrivals = (!arrivals.is_empty()).then(|| ("arrivals", arrivals::columns(arrivals)));
    let made = own
        .into_iter()
        .chain(arrivals)
        .map(|(name, columns)| Table::new(name, columns));
    let mut tables = made.collect::<Result<Vec<_>, _>>()?;
    if let Some(scaling) = scaling {
        tables.push(Table::new(SCALING, scaling::columns(scaling))?);
    }
    if !comparisons.is_empty() {
        tables.push(Table::new("comparison", comparison::columns(comparisons, &tables))?);
    }
    Ok(tables)
}

fn summary(cases: &[Analysed]) -> Vec<Column> {
    let rows = Rows(cases.iter().collect::<Vec<_>>());
    let peak = |case: &Analysed, of: fn(Moment) -> Option<f64>| case.findings.peak.and_then(of);
    let start = |case: &Analysed, of: fn(Moment) -> Option<f64>| case.findings.first_break.and_then(of);
    vec![
        rows.text("case", |case| case.name()),
        rows.count("nodes", |case| case.solid.specimen.nodes),
        rows.count("elements", |case| case.solid.specimen.elements),
        rows.count("represented_atoms", |case| case.solid.specimen.atoms),
        rows.count("steps", |case| case.result.manifest.steps),
        rows.number("time_step_ps", |case| case.result.manifest.time_step),
        rows.number("wall_s", |case| case.result.manifest.wall_seconds),
        rows.number("core_s", |case| case.result.core_seconds()),
        rows.number("atom_steps_per_s", |case| case.atom_steps_a_second()),
        rows.number("energy_error_relative", |case| case.energy_error()),
        rows.number("closest_approach_spacings", |case| {
            case.result.manifest.closest_approach
        }),
        rows.number("modulus_gpa", |case| {
            case.findings.modulus.map(|modulus| modulus * GIGAPASCAL)
        }),
        rows.number("peak_stress_gpa", |case| peak(case, |at| Some(at.stress * GIGAPASCAL))),
        rows.number("peak_time_ps", |case| peak(case, |at| Some(at.time))),
        rows.number("peak_strain", |case| peak(case, |at| at.strain)),
        rows.number("first_break_time_ps", |case| start(case, |at| Some(at.time))),
        rows.number("first_break_strain", |case| start(case, |at| at.strain)),
        rows.number("broken_bonds", |case| case.findings.broken),
        rows.number("period_ps", |case| case.findings.period.map(|period| period.0)),
        rows.number("modulus_at_rest_gpa", |case| {
            case.findings.modulus_at_rest.map(|modulus| modulus * GIGAPASCAL)
        }),
        rows.number("modulus_of_crystal_gpa", |case| {
            case.solid.specimen.bar.map(|bar| bar.young_modulus * GIGAPASCAL)
        }),
        rows.number("bar_period_at_rest_ps", |case| {
            Some(case.solid.specimen.bar?.period(case.findings.modulus_at_rest?))
        }),
        rows.number("wave_speed_m_per_s", |case| {
            case.findings.wave_speed.map(|speed| speed * METRE_PER_SECOND)
        }),
        rows.number("wave_speed_of_crystal_m_per_s", |case| {
            case.solid.specimen.wave_speed.map(|speed| speed * METRE_PER_SECOND)
        }),
    ]
}

fn specimen(cases: &[Analysed]) -> Vec<Column> {
    let rows = Rows(cases.iter().collect::<Vec<_>>());
    let edge = |axis: usize| move |case: &&Analysed| case.solid.specimen.edges.get(axis).map(|edge| edge.1);
    vec![
        rows.text("case", |case| case.name()),
        rows.number("first_edge_nm", edge(0)),
        rows.number("second_edge_nm", edge(1)),
        rows.number("third_edge_nm", edge(2)),
        rows.text("elements_by_kind", |case| &case.solid.specimen.kinds),
        rows.text("notch", |case| &case.solid.specimen.notch),
        rows.text("held", |case| &case.solid.specimen.held),
        rows.text("loading", |case| &case.solid.specimen.loading),
        rows.number("leftover_share", |case| case.solid.specimen.leftover_share),
    ]
}

/// What each case saves against the finest of its experiment, and by how much it is off.
fn speed_against_error(cases: &[Analysed]) -> Vec<Column> {
    let measured = cases.iter().filter_map(|case| Some((case, reference(cases, case)?)));
    let others = measured.filter(|(case, finest)| !std::ptr::eq(*case, *finest));
    let rows = Rows(others.collect::<Vec<_>>());
    let off = |of: fn(&Analysed) -> Option<f64>| {
        move |(case, finest): &(&Analysed, &Analysed)| Some(PERCENT * (of(case)? / of(finest)? - 1.0))
    };
    vec![
        rows.text("case", |row| row.0.name()),
        rows.text("reference", |row| row.1.name()),
        rows.number("core_s", |row| row.0.result.core_seconds()),
        rows.number("speedup", |(case, finest)| {
            Some(finest.result.core_seconds()? / case.result.core_seconds()?)
        }),
        rows.number("modulus_error_percent", off(|case| case.findings.modulus)),
        rows.number(
            "peak_stress_error_percent",
            off(|case| Some(case.findings.peak?.stress)),
        ),
        rows.number(
            "first_break_time_error_percent",
            off(|case| Some(case.findings.first_break?.time)),
        ),
        rows.number("period_error_percent", off(|case| Some(case.findings.period?.0))),
        rows.number("stress_curve_error_percent", |(case, finest)| {
            Some(PERCENT * curve_distance(case, finest)?)
        }),
    ]
}

fn series(cases: &[Analysed]) -> Vec<Column> {
    let probes = cases.iter().filter_map(|case| Some((case, case.series()?)));
    let probes = probes.flat_map(|(case, series)| (0..series.time.len()).map(move |probe| (case, series, probe)));
    let rows = Rows(probes.collect::<Vec<_>>());
    let stress = |part: usize| {
        move |(_, series, probe): &(&Analysed, &super::Series, usize)| series.stress[*probe][part] * GIGAPASCAL
    };
    let force = |axis: usize| move |(_, series, probe): &(&Analysed, &super::Series, usize)| series.force[*probe][axis];
    vec![
        rows.text("case", |row| row.0.name()),
        rows.number("time_ps", |row| row.1.time[row.2]),
        rows.number("strain", |row| row.1.strain[row.2]),
        rows.number("sigma_xx_gpa", stress(0)),
        rows.number("sigma_yy_gpa", stress(1)),
        rows.number("sigma_zz_gpa", stress(2)),
        rows.number("sigma_yz_gpa", stress(3)),
        rows.number("sigma_xz_gpa", stress(4)),
        rows.number("sigma_xy_gpa", stress(5)),
        rows.number("kinetic_energy_ev", |row| row.1.kinetic[row.2]),
        rows.number("potential_energy_ev", |row| row.1.potential[row.2]),
        rows.number("work_ev", |row| row.1.work[row.2]),
        rows.number("cutoff_release_ev", |row| row.1.release[row.2]),
        rows.number("force_x_ev_per_nm", force(0)),
        rows.number("force_y_ev_per_nm", force(1)),
        rows.number("force_z_ev_per_nm", force(2)),
        rows.number("broken_bonds", |row| row.1.broken[row.2]),
        rows.number("open_interfaces", |row| row.1.open_interfaces[row.2]),
        rows.number("temperature_k", |row| row.1.temperature[row.2]),
    ]
}

fn gauges(cases: &[Analysed]) -> Vec<Column> {
    let of_case = |case| {
        let series = Analysed::series(case)?;
        let probes = move |gauge| (0..series.time.len()).map(move |probe| (case, series, gauge, probe));
        Some(series.gauges.iter().flat_map(probes))
    };
    let rows = Rows(cases.iter().filter_map(of_case).flatten().collect::<Vec<_>>());
    type Row<'a> = (&'a Analysed<'a>, &'a super::Series, &'a super::Gauge, usize);
    let velocity = |axis: usize| move |(_, _, gauge, probe): &Row| gauge.velocity[*probe][axis] * METRE_PER_SECOND;
    let stress = |part: usize| move |(_, _, gauge, probe): &Row| gauge.stress[*probe][part] * GIGAPASCAL;
    vec![
        rows.text("case", |row| row.0.name()),
        rows.number("time_ps", |row| row.1.time[row.3]),
        rows.number("at_nm", |row| row.2.at),
        rows.number("velocity_x_m_per_s", velocity(0)),
        rows.number("velocity_y_m_per_s", velocity(1)),
        rows.number("velocity_z_m_per_s", velocity(2)),
        rows.number("sigma_xx_gpa", stress(0)),
        rows.number("sigma_yy_gpa", stress(1)),
        rows.number("sigma_zz_gpa", stress(2)),
        rows.number("sigma_yz_gpa", stress(3)),
        rows.number("sigma_xz_gpa", stress(4)),
        rows.number("sigma_xy_gpa", stress(5)),
    ]
}

fn cost(cases: &[Analysed]) -> Vec<Column> {
    let phases = cases
        .iter()
        .flat_map(|case| case.result.manifest.cost.iter().map(move |phase| (case, phase)));
    let rows = Rows(phases.collect::<Vec<_>>());
    vec![
        rows.text("case", |row| row.0.name()),
        rows.count("ranks", |row| row.0.result.manifest.ranks.map(u64::from)),
        rows.count("threads", |row| row.0.result.manifest.threads.map(u64::from)),
        rows.text("phase", |row| &row.1.name),
        rows.count("calls", |row| row.1.calls),
        rows.number("seconds", |row| row.1.seconds),
    ]
}
