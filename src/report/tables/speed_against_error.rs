//! Speed against error: what every case costs beside how far it is from the finest of the same specimen.

use polars::prelude::Column;

use crate::plan::Comparison;
use crate::report::chart::scatter::{Mark, Point, Scatter};
use crate::report::chart::{Chart, Content};
use crate::report::table::Rows;
use crate::report::units::PERCENT;
use crate::report::{Analysed, Difference, overview};

const MEBIBYTE: f64 = 1_048_576.0;

/// Fewer cases than this besides the reference are no study of economies; the comparison side by side says it all.
const FEWEST: usize = 4;

/// Errors below this (in percent) count as this, and those of moments that one probe resolves as what a probe is of them.
const LEAST_PERCENT: f64 = 0.01;

/// The column that holds the cost.
pub const COST: &str = "core_seconds_per_ps";

/// What a case may be wrong in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    Stress,
    Initiation,
    Speed,
    Arrival,
    StressIntensity,
}

impl Quantity {
    pub const ALL: [Self; 5] = [
        Self::Stress,
        Self::Initiation,
        Self::Speed,
        Self::Arrival,
        Self::StressIntensity,
    ];

    /// Relative, without sign.
    pub fn error(self, difference: &Difference) -> Option<f64> {
        let error = match self {
            Self::Stress => difference.stress,
            Self::Initiation => difference.initiation_strain,
            Self::Speed => difference.speed,
            Self::Arrival => difference.arrival,
            Self::StressIntensity => difference.stress_intensity,
        };
        error.map(f64::abs)
    }

    pub fn column(self) -> &'static str {
        match self {
            Self::Stress => "stress_error",
            Self::Initiation => "initiation_strain_error",
            Self::Speed => "crack_speed_error",
            Self::Arrival => "wave_arrival_error",
            Self::StressIntensity => "k_ic_error",
        }
    }

    pub fn words(self) -> &'static str {
        match self {
            Self::Stress => "stress before initiation",
            Self::Initiation => "strain at initiation",
            Self::Speed => "crack speed",
            Self::Arrival => "wave arrival",
            Self::StressIntensity => "K at initiation",
        }
    }
}

/// A case that is measured against another, or others against it.
pub struct Row<'a> {
    /// Its number in the figures.
    pub number: u64,
    pub case: &'a Analysed<'a>,
    pub reference: &'a Analysed<'a>,
    pub cost: f64,
}

impl Row<'_> {
    pub fn error(&self, quantity: Quantity) -> Option<f64> {
        quantity.error(&self.case.difference)
    }

    /// The error in percent as far as it can be told, which is never nothing.
    fn resolved_percent(&self, quantity: Quantity) -> Option<f64> {
        let least = (self.probe(quantity) * PERCENT).max(LEAST_PERCENT);
        Some((self.error(quantity)? * PERCENT).max(least))
    }

    /// What a probe is of the quantity: a smaller error cannot be told from none.
    pub fn probe(&self, quantity: Quantity) -> f64 {
        let probe = match quantity {
            Quantity::Initiation | Quantity::StressIntensity => overview::between_probes(self.case, self.reference),
            Quantity::Arrival => overview::between_arrivals(self.reference),
            Quantity::Stress | Quantity::Speed => None,
        };
        probe.unwrap_or(0.0)
    }

    /// Number of the reference among the rows: cases of one specimen have the same.
    fn group(&self, rows: &[Row]) -> usize {
        let references = rows.iter().filter(|row| std::ptr::eq(row.case, row.reference));
        references
            .into_iter()
            .position(|row| std::ptr::eq(row.case, self.reference))
            .unwrap_or_default()
    }

    /// Whether no other case of the specimen is at least as cheap and nearer, or cheaper and as near.
    pub fn is_best(&self, rows: &[Row], quantity: Quantity) -> bool {
        let Some(error) = self.resolved_percent(quantity) else {
            return false;
        };
        // The reference has no error.
        let reference = rows.iter().find(|row| std::ptr::eq(row.case, self.reference));
        if reference.is_some_and(|reference| reference.cost <= self.cost) {
            return false;
        }
        let beats = |other: &Row| {
            std::ptr::eq(other.reference, self.reference)
                && other.resolved_percent(quantity).is_some_and(|theirs| {
                    theirs <= error && other.cost <= self.cost && (theirs < error || other.cost < self.cost)
                })
        };
        !rows.iter().any(beats)
    }
}

/// The cases that have a reference and a cost, the references among them; empty where there are too few to learn from.
pub fn rows<'a>(cases: &'a [Analysed<'a>]) -> Vec<Row<'a>> {
    // What repeats differ by is chance, and no error of what they were computed with.
    let single = cases.iter().filter(|case| case.result.repeat_of.is_none());
    let measured = single.filter_map(|case| Some((case, &cases[case.reference?], case.core_seconds_a_picosecond()?)));
    let rows: Vec<Row> = measured
        .zip(1..)
        .map(|((case, reference, cost), number)| Row {
            number,
            case,
            reference,
            cost,
        })
        .collect();
    let others = rows.iter().filter(|row| !std::ptr::eq(row.case, row.reference));
    if others.count() < FEWEST { Vec::new() } else { rows }
}

/// A chart for each quantity in which some case differs.
pub fn charts(cases: &[Analysed], comparisons: &[Comparison]) -> Vec<Chart> {
    let rows = rows(cases);
    let chart = |quantity: Quantity| {
        let points: Vec<Point> = rows
            .iter()
            .filter_map(|row| {
                Some(Point {
                    name: row.case.name().to_owned(),
                    x: row.cost,
                    y: row.resolved_percent(quantity)?,
                    group: row.group(&rows),
                    is_best: row.is_best(&rows, quantity),
                })
            })
            .collect();
        (!points.is_empty()).then(|| Chart {
            id: format!("speed-against-error-{}", quantity.column().trim_end_matches("_error").replace('_', "-")),
            detail: false,
            table: "speed_against_error",
            title: format!("Speed against error: {}", quantity.words()),
            caption: format!(
                "Error of the {} against the cost of a case. Filled and joined are the cases that no other one beats in \
                 both; others have a name where there is room, all are in the table. Errors that the probes cannot tell are \
                 drawn at what they can. Each material has its own colour, outline and \
                 reference. Below, where there is no error: the reference itself, and other programs that compute the same \
                 atoms by the same bonds.",
                quantity.words()
            ),
            x: "cost (core-seconds per simulated ps)".to_owned(),
            y: format!("error of {} (%)", quantity.words()),
            content: Content::Points(Scatter {
                points,
                marks: marks(&rows, comparisons),
            }),
        })
    };
    Quantity::ALL.into_iter().filter_map(chart).collect()
}

/// The references, and what files to compare with say of their cost.
fn marks(rows: &[Row], comparisons: &[Comparison]) -> Vec<Mark> {
    let references = rows.iter().filter(|row| std::ptr::eq(row.case, row.reference));
    let mut marks: Vec<Mark> = references
        .enumerate()
        .map(|(group, row)| Mark {
            name: row.case.name().to_owned(),
            x: row.cost,
            group: Some(group),
        })
        .collect();
    for comparison in comparisons {
        let costs = comparison.values.iter().filter(|expected| expected.column == COST);
        marks.extend(costs.map(|expected| Mark {
            name: comparison.name.clone(),
            x: expected.value,
            group: None,
        }));
    }
    marks
}

/// Errors are relative.
pub fn columns(rows: Vec<Row>) -> Vec<Column> {
    let rows = Rows(rows);
    let mut columns = vec![
        rows.count("number", |row| Some(row.number)),
        rows.text("case", |row| row.case.name()),
        rows.text("reference", |row| row.reference.name()),
        rows.number(COST, |row| row.cost),
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
