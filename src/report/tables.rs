//! The tables of a study: absent values are empty, never 0.

use std::path::Path;

use polars::prelude::*;

use super::numbers::{self, round_significant};
use super::precision::{self, Quantity};
use super::side_by_side::{self, Panel};
use super::units::{GIGAPASCAL, MEGAPASCAL_ROOT_METRE, METRE_PER_SECOND};
use super::{Analysed, ReportError, branching, events, expected, save, scaling, specimen, toughness};
use crate::analysis::stress_intensity::Ahead;
use crate::analysis::waves::{Arrival, Face, Wave};
use crate::plan::{Comparison, SCALING};

/// Digits of a number in a file: more than any of them means, few enough to be read.
const DIGITS: usize = 9;

/// Digits of a number on the page.
const SHOWN_DIGITS: usize = 4;

const MEBIBYTE: f64 = 1_048_576.0;

/// A named table.
pub struct Table {
    pub name: &'static str,
    frame: DataFrame,
}

/// All tables, in the order in which they are shown.
pub fn all(
    cases: &[Analysed],
    comparisons: &[Comparison],
    panels: &[Panel],
    scaling: Option<&scaling::Findings>,
) -> Result<Vec<Table>, ReportError> {
    let own = [
        ("summary", summary(cases)),
        ("specimen", specimen::columns(cases)),
        ("crack_speed", crack_speed(cases)),
        ("stress_profile", stress_profile(cases)),
        ("stress_strain", stress_strain(cases)),
        ("wave_arrival", wave_arrival(cases, comparisons)),
        ("k_ic", toughness::columns(cases, comparisons)),
        ("branches", branches(cases)),
        ("first_branch", branching::columns(cases, comparisons)),
        ("joins", events::joins(cases)),
        ("path", events::path(cases)),
        ("cost", cost(cases)),
    ];
    let precision = precision::rows(cases);
    let make = |(table, columns)| match DataFrame::new_infer_height(columns) {
        Ok(frame) => Ok(Table { name: table, frame }),
        Err(error) => Err(ReportError::Table {
            table,
            reason: error.to_string(),
        }),
    };
    let mut tables = own.into_iter().map(make).collect::<Result<Vec<_>, _>>()?;
    if !precision.is_empty() {
        tables.push(make(("speed_against_error", speed_against_error(precision)))?);
    }
    if let Some(scaling) = scaling {
        tables.push(make((SCALING, scaling::columns(scaling)))?);
    }
    if !comparisons.is_empty() {
        tables.push(make(("comparison", expected::columns(comparisons, &tables)))?);
    }
    if !panels.is_empty() {
        tables.push(make(("side_by_side", side_by_side::columns(panels)))?);
    }
    Ok(tables)
}

impl Table {
    /// Writes `<name>.csv` into a folder, and `<name>.parquet` where that is built in.
    pub fn write(&mut self, folder: &Path) -> Result<(), ReportError> {
        let table = self.name;
        let failed = |error: PolarsError| ReportError::Table {
            table,
            reason: error.to_string(),
        };
        let path = |ending: &str| folder.join(format!("{table}.{ending}"));
        // In memory first: what goes wrong on the disk is then told as such.
        let mut bytes = Vec::new();
        CsvWriter::new(&mut bytes).finish(&mut self.frame).map_err(failed)?;
        save(&path("csv"), &bytes)?;
        #[cfg(feature = "parquet")]
        {
            bytes.clear();
            ParquetWriter::new(&mut bytes).finish(&mut self.frame).map_err(failed)?;
            save(&path("parquet"), &bytes)?;
        }
        Ok(())
    }

    pub fn columns(&self) -> Vec<String> {
        self.frame
            .get_column_names()
            .iter()
            .map(std::string::ToString::to_string)
            .collect()
    }

    /// The number in a column of the row of a case that has these words in these columns.
    pub fn value(&self, case: &str, keys: &[(&str, String)], column: &str) -> Option<f64> {
        let holds = |row: usize, column: &str, word: &str| {
            let cell = self
                .frame
                .column(column)
                .and_then(|column| column.get(row).map(AnyValue::into_static));
            matches!(cell, Ok(cell) if cell.get_str() == Some(word))
        };
        let mut rows = 0..self.height();
        let row = rows.find(|&row| holds(row, "case", case) && keys.iter().all(|(key, word)| holds(row, key, word)))?;
        match self.frame.column(column).ok()?.get(row).ok()? {
            AnyValue::Float64(value) => Some(value),
            AnyValue::UInt64(value) => Some(value as f64),
            _ => None,
        }
    }

    pub fn height(&self) -> usize {
        self.frame.height()
    }

    /// The cells as a person reads them, row by row.
    pub fn rows(&self) -> Vec<Vec<String>> {
        let cell = |column: &Column, row| match column.get(row) {
            Ok(AnyValue::String(text)) => text.to_owned(),
            Ok(AnyValue::Float64(value)) => numbers::significant(value, SHOWN_DIGITS),
            Ok(AnyValue::UInt64(value)) => numbers::count(value),
            Ok(AnyValue::Boolean(value)) => if value { "yes" } else { "no" }.to_owned(),
            _ => numbers::ABSENT.to_owned(),
        };
        (0..self.height())
            .map(|row| self.frame.columns().iter().map(|column| cell(column, row)).collect())
            .collect()
    }
}

/// Rows of one kind, from which columns are made.
pub struct Rows<T>(pub Vec<T>);

impl<T> Rows<T> {
    pub fn text(&self, name: &str, of: impl Fn(&T) -> &str) -> Column {
        Column::new(name.into(), self.0.iter().map(of).collect::<Vec<&str>>())
    }

    /// Empty where there is none.
    pub fn word(&self, name: &str, of: impl Fn(&T) -> Option<&str>) -> Column {
        Column::new(name.into(), self.0.iter().map(of).collect::<Vec<Option<&str>>>())
    }

    pub fn number<N: Into<Option<f64>>>(&self, name: &str, of: impl Fn(&T) -> N) -> Column {
        let finite = |row| of(row).into().filter(|value: &f64| value.is_finite());
        let values = self
            .0
            .iter()
            .map(finite)
            .map(|value| value.map(|value| round_significant(value, DIGITS)));
        Column::new(name.into(), values.collect::<Vec<Option<f64>>>())
    }

    pub fn count<N: Into<Option<u64>>>(&self, name: &str, of: impl Fn(&T) -> N) -> Column {
        Column::new(
            name.into(),
            self.0.iter().map(|row| of(row).into()).collect::<Vec<Option<u64>>>(),
        )
    }

    pub fn flag(&self, name: &str, of: impl Fn(&T) -> Option<bool>) -> Column {
        Column::new(name.into(), self.0.iter().map(of).collect::<Vec<Option<bool>>>())
    }
}

/// The rows of all cases, one case after the other.
fn collect<'a, T, I: Iterator<Item = T>>(cases: &'a [Analysed<'a>], of: impl Fn(&'a Analysed<'a>) -> I) -> Rows<T> {
    Rows(cases.iter().flat_map(of).collect())
}

fn summary(cases: &[Analysed]) -> Vec<Column> {
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
    columns.extend(events::columns(&rows));
    columns
}

/// Errors are relative.
fn speed_against_error(rows: Vec<precision::Row>) -> Vec<Column> {
    let rows = Rows(rows);
    let mut columns = vec![
        rows.count("number", |row| Some(row.number)),
        rows.text("case", |row| row.case.name()),
        rows.text("reference", |row| row.reference.name()),
        rows.number(precision::COST, |row| row.cost),
        rows.count("nodes", |row| {
            row.case.result.setting.as_ref().map(|setting| setting.nodes)
        }),
        rows.number("peak_memory_mib", |row| {
            row.case.result.manifest.peak_memory.map(|bytes| bytes / MEBIBYTE)
        }),
    ];
    for quantity in Quantity::ALL {
        columns.push(rows.number(quantity.column(), |row| row.error(quantity)));
    }
    let best: Vec<Option<String>> = rows
        .0
        .iter()
        .map(|row| {
            let best = Quantity::ALL
                .into_iter()
                .filter(|&quantity| row.is_best(&rows.0, quantity));
            let names: Vec<&str> = best.map(Quantity::column).collect();
            (!names.is_empty()).then(|| names.join(" "))
        })
        .collect();
    columns.push(Column::new("unbeaten_in".into(), best));
    columns
}

fn crack_speed(cases: &[Analysed]) -> Vec<Column> {
    let rows = collect(cases, |case| {
        let rows = case
            .result
            .series
            .probes
            .iter()
            .zip(&case.findings.tips)
            .zip(&case.findings.speeds);
        rows.map(move |((probe, tip), speed)| (case, probe, tip, *speed))
    });
    vec![
        rows.text("case", |row| &row.0.result.name),
        rows.number("time_ps", |row| row.1.time),
        rows.number("strain", |row| row.1.strain),
        rows.number("tip_x_nm", |row| row.2.x),
        rows.number("tip_y_nm", |row| row.2.y),
        rows.number("arc_length_nm", |row| row.2.arc_length),
        rows.number("speed_m_per_s", |row| row.3.map(|speed| speed.value * METRE_PER_SECOND)),
        rows.number("speed_over_c_r", |row| Some(row.3?.value / row.0.rayleigh_speed()?)),
        rows.number("speed_error_m_per_s", |row| {
            row.3.map(|speed| speed.error * METRE_PER_SECOND)
        }),
    ]
}

fn stress_profile(cases: &[Analysed]) -> Vec<Column> {
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

fn stress_strain(cases: &[Analysed]) -> Vec<Column> {
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
    ]
}

fn wave_arrival(cases: &[Analysed], comparisons: &[Comparison]) -> Vec<Column> {
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
            expected::value(comparisons, "wave_arrival", row.0.name(), &keys)
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

/// The main crack has no parent; it is born at initiation, at the end of the notch.
fn branches(cases: &[Analysed]) -> Vec<Column> {
    let rows = collect(cases, |case| {
        let started = case.findings.initiation.map(|_| &case.findings.branches);
        started
            .into_iter()
            .flatten()
            .zip(0..)
            .map(move |(branch, index)| (case, branch, index))
    });
    let start = |row: &(&Analysed, _, u64)| row.0.findings.initiation.filter(|_| row.2 == 0);
    let notch = |row: &(&Analysed, _, u64)| row.0.findings.tips.first().filter(|_| row.2 == 0).copied();
    vec![
        rows.text("case", |row| &row.0.result.name),
        rows.count("branch", |row| row.2),
        rows.count("parent", |row| row.1.parent.map(|parent| parent as u64)),
        rows.number("time_ps", |row| start(row).map_or(row.1.time, |start| start.time)),
        rows.number("strain", |row| start(row).map_or(row.1.strain, |start| start.strain)),
        rows.number("x_nm", |row| notch(row).map_or(row.1.x, |tip| tip.x)),
        rows.number("y_nm", |row| notch(row).map_or(row.1.y, |tip| tip.y)),
        rows.number("angle_deg", |row| row.1.parent.map(|_| row.1.angle)),
        rows.flag("arrested", |row| Some(row.1.arrested)),
    ]
}

fn cost(cases: &[Analysed]) -> Vec<Column> {
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
