//! What ranks gain: times, speedup and efficiency, measured and predicted, beside those of another program.

mod figures;
mod words;

pub use figures::charts;
pub use words::{notes, verdict};

use polars::prelude::Column;

use super::numbers::{ABSENT, count, significant};
use super::table::Rows;
use super::{CaseResult, Study};
use crate::analysis::scaling::{OneProcessor, Times, predicted};
use crate::domain::MessageCost;
use crate::plan::Comparison;

/// Of what a row tells.
#[derive(Clone, Debug, PartialEq)]
pub enum Of {
    /// A case that has run.
    Case(String),
    Prediction,
    /// What it is compared with, by its name in the study.
    Other(String),
}

/// Times of one number of ranks, and what follows from them.
pub struct Row {
    pub of: Of,
    pub elements: Option<u64>,
    pub times: Times,
    pub speedup: f64,
    pub efficiency: f64,
    /// By Amdahl's law from the serial share of one processor.
    pub ideal_speedup: f64,
}

/// A study of scaling, evaluated.
pub struct Findings {
    pub rows: Vec<Row>,
    /// What a message cost where this was measured.
    pub messages: Option<MessageCost>,
    /// The run of one rank that the prediction starts from, if there is one.
    pub one: Option<Times>,
}

impl Row {
    fn new(of: Of, elements: Option<u64>, times: Times, one: &OneProcessor, growth: f64) -> Self {
        Self {
            of,
            elements,
            speedup: times.speedup(one, growth),
            efficiency: times.efficiency(one, growth),
            ideal_speedup: one.ideal_speedup(times.ranks),
            times,
        }
    }

    fn of(&self) -> &str {
        match &self.of {
            Of::Case(_) => "measured",
            Of::Prediction => "prediction",
            Of::Other(name) => name,
        }
    }

    fn case(&self) -> Option<&str> {
        match &self.of {
            Of::Case(name) => Some(name),
            _ => None,
        }
    }
}

/// `None` where the study does not ask for it.
pub fn findings(study: &Study) -> Option<Findings> {
    let scaling = study.scaling.as_ref()?;
    let growth = |ranks: u32| scaling.growth.with(ranks);
    let mut measured: Vec<(&CaseResult, Times)> = study
        .cases
        .iter()
        .filter_map(|case| times(case).map(|times| (case, times)))
        .collect();
    measured.sort_by_key(|(_, times)| times.ranks);
    let elements = |case: &CaseResult| match &case.solid {
        Some(solid) => solid.specimen.blocks.or(Some(solid.specimen.elements)),
        None => case.setting.as_ref().map(|setting| setting.elements),
    };
    let mut rows = Vec::new();
    if let Some((_, fewest)) = measured.first() {
        let one = fewest.on_one(growth(fewest.ranks));
        rows.extend(measured.iter().map(|(case, times)| {
            let of = Of::Case(case.name.clone());
            Row::new(of, elements(case), *times, &one, growth(times.ranks))
        }));
    }
    let one = measured.iter().find(|(_, times)| times.ranks == 1);
    let messages = measured.iter().find_map(|(case, _)| case.manifest.messages);
    if let Some(((case, one), messages)) = one.zip(messages) {
        let ideal = one.on_one(1.0);
        rows.extend(scaling.burdens.iter().map(|burden| {
            let growth = growth(burden.ranks);
            let times = predicted(one, growth, burden, &messages);
            let elements = elements(case).map(|elements| (elements as f64 * growth) as u64);
            Row::new(Of::Prediction, elements, times, &ideal, growth)
        }));
    }
    for comparison in &scaling.compared {
        let times = times_of(comparison);
        let Some((first, _)) = times.first() else { continue };
        let one = first.on_one(growth(first.ranks));
        rows.extend(times.iter().map(|(times, elements)| {
            let of = Of::Other(comparison.name.clone());
            Row::new(of, *elements, *times, &one, growth(times.ranks))
        }));
    }
    Some(Findings {
        rows,
        messages,
        one: one.map(|(_, times)| *times),
    })
}

/// The phases of a run as the steps of the source; `None` where it is not done.
fn times(case: &CaseResult) -> Option<Times> {
    let manifest = &case.manifest;
    let known = |name: &str| {
        let phase = manifest.cost.iter().find(|phase| phase.name == name);
        phase.map(|phase| phase.seconds)
    };
    let seconds = |name: &str| known(name).unwrap_or(0.0);
    let steps = manifest.steps.filter(|&steps| steps > 0)? as f64;
    let exchange = seconds("exchange") / steps;
    Some(Times {
        ranks: manifest.ranks?,
        steps,
        input: seconds("mesh") + seconds("set-up"),
        map: known("cut"),
        lists: seconds("neighbours"),
        exchange,
        solve: exchange + (seconds("forces") + seconds("motion") + seconds("stability")) / steps,
        output: seconds("output") + seconds("publishing"),
    })
}

/// The rows of a file by rising ranks, with their elements; those that lack a time are left out.
fn times_of(comparison: &Comparison) -> Vec<(Times, Option<u64>)> {
    let mut ranks: Vec<u32> = comparison
        .values
        .iter()
        .filter_map(|value| value.case.parse().ok())
        .collect();
    ranks.sort_unstable();
    ranks.dedup();
    let row = |ranks: u32| {
        let value = |column: &str| {
            let mut of_row = comparison.values.iter().filter(|value| value.case.parse() == Ok(ranks));
            Some(of_row.find(|value| value.column == column)?.value)
        };
        let times = Times {
            ranks,
            steps: value("steps")?,
            input: value("inp_s")?,
            map: value("getm_s"),
            lists: value("elist_s")?,
            exchange: value("exc_s_per_step")?,
            solve: value("solv_s_per_step")?,
            output: value("out_s")?,
        };
        Some((times, value("elements").map(|elements| elements as u64)))
    };
    ranks.into_iter().filter_map(row).collect()
}

/// The columns of its table.
pub fn columns(findings: &Findings) -> Vec<Column> {
    let rows = Rows(findings.rows.iter().collect::<Vec<&Row>>());
    vec![
        rows.text("of", |row| row.of()),
        rows.word("case", |row| row.case()),
        rows.count("ranks", |row| u64::from(row.times.ranks)),
        rows.count("elements", |row| row.elements),
        rows.count("steps", |row| row.times.steps as u64),
        rows.number("inp_s", |row| row.times.input),
        rows.number("getm_s", |row| row.times.map),
        rows.number("elist_s", |row| row.times.lists),
        rows.number("exc_s_per_step", |row| row.times.exchange),
        rows.number("solv_s_per_step", |row| row.times.solve),
        rows.number("out_s", |row| row.times.output),
        rows.number("total_s", |row| row.times.total()),
        rows.number("speedup", |row| row.speedup),
        rows.number("efficiency", |row| row.efficiency),
        rows.number("ideal_speedup", |row| row.ideal_speedup),
    ]
}

/// Heads of the table on the page.
pub const HEADS: [&str; 14] = [
    "",
    "ranks",
    "elements",
    "N",
    "INP (s)",
    "GETM (s)",
    "ELIST (s)",
    "EXC (ms)",
    "SOLV (ms)",
    "OUT (s)",
    "total (s)",
    "speedup",
    "efficiency",
    "ideal",
];

/// A row of the table on the page.
pub fn cells(row: &Row) -> Vec<String> {
    let Times {
        ranks,
        steps,
        input,
        map,
        lists,
        exchange,
        solve,
        output,
    } = row.times;
    let whole = |number: Option<u64>| number.map_or_else(|| ABSENT.to_owned(), count);
    let mut cells = vec![row.of().to_owned()];
    cells.extend([Some(u64::from(ranks)), row.elements, Some(steps as u64)].map(whole));
    let milli = |seconds: f64| Some(1e3 * seconds);
    let numbers = [
        Some(input),
        map,
        Some(lists),
        milli(exchange),
        milli(solve),
        Some(output),
        Some(row.times.total()),
        Some(row.speedup),
        Some(row.efficiency),
        Some(row.ideal_speedup),
    ];
    cells.extend(numbers.map(|value| value.map_or_else(|| ABSENT.to_owned(), number)));
    cells
}

/// A number for a sentence.
fn number(value: f64) -> String {
    significant(value, 3)
}
