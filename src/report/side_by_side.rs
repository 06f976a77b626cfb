//! Cases side by side: those of one name in several studies, and those of this study that it sets side by side.

mod agreement;

use polars::prelude::Column;

use super::numbers::ABSENT;
use super::overview::{self, Row};
use super::quantity::Quantity;
use super::repeats::{self, Repeats};
use super::table::Rows;
use super::{Analysed, CaseResult, Study};
use crate::analysis::scatter::Scatter;
use crate::plan::SideBySide;

/// Cases side by side; the others are measured against the first.
pub struct Panel<'a> {
    /// The name of all of them, or what the study sets them side by side for.
    pub title: &'a str,
    sides: Vec<Side<'a>>,
    /// `None` where the cases are those of one name in several studies.
    set: Option<&'a SideBySide>,
}

/// One of them, and where it is repeated with noise all repeats, of which it is the first.
struct Side<'a> {
    study: &'a str,
    case: &'a Analysed<'a>,
    repeats: Option<Repeats<'a>>,
}

impl Side<'_> {
    fn name(&self) -> &str {
        self.repeats.as_ref().map_or(self.case.name(), |repeats| repeats.name)
    }

    /// Of repeats the median.
    fn value(&self, quantity: Quantity) -> Option<f64> {
        match &self.repeats {
            None => quantity.value(self.case),
            Some(_) => Some(self.scatter(quantity)?.median),
        }
    }

    fn scatter(&self, quantity: Quantity) -> Option<Scatter> {
        self.repeats.as_ref()?.scatter(quantity)
    }
}

/// The cases of this study that stand in others too, and the sets of cases that it names; `others` are the cases of
/// `study.others`.
pub fn panels<'a>(study: &'a Study, cases: &'a [Analysed<'a>], others: &'a [Vec<Analysed<'a>>]) -> Vec<Panel<'a>> {
    let side = |study, case| Side {
        study,
        case,
        repeats: None,
    };
    let named = |cases: &'a [Analysed<'a>], name: &str| cases.iter().find(|case| case.name() == name);
    // A case without a result of its own is measured against nothing.
    let computed = cases.iter().filter(|case| case.result.setting.is_some());
    let across = computed.map(|case| {
        let elsewhere = study.others.iter().zip(others);
        let elsewhere = elsewhere.filter_map(|(other, cases)| Some(side(&other.name, named(cases, case.name())?)));
        Panel {
            title: case.name(),
            sides: std::iter::once(side(&study.name, case)).chain(elsewhere).collect(),
            set: None,
        }
    });
    let within = study.side_by_side.iter().map(|set| {
        let mut sides: Vec<Side> = Vec::new();
        for case in set.cases.iter().filter_map(|name| named(cases, name)) {
            let name = case.result.repeat_of.as_deref();
            let repeats = repeats::all(cases)
                .into_iter()
                .find(|repeats| Some(repeats.name) == name);
            // Of a case and its repeats one side.
            if name.is_none() || !sides.iter().any(|side| Some(side.name()) == name) {
                sides.push(Side {
                    repeats,
                    ..side(&study.name, case)
                });
            }
        }
        Panel {
            title: &set.name,
            sides,
            set: Some(set),
        }
    });
    across.chain(within).filter(|panel| panel.sides.len() > 1).collect()
}

impl Panel<'_> {
    /// Whether the cases are those of one name in several studies.
    pub fn is_across_studies(&self) -> bool {
        self.set.is_none()
    }

    pub fn heads(&self) -> Vec<&str> {
        let sides = self.sides.iter();
        match self.set {
            None => sides.map(|side| side.study).collect(),
            Some(_) => sides.map(Side::name).collect(),
        }
    }

    /// What differs between the cases, and what comes out; in brackets how far from the first.
    pub fn rows(&self) -> Vec<Row> {
        let results: Vec<&CaseResult> = self.sides.iter().map(|side| side.case.result).collect();
        let mut rows = overview::differing(&results);
        let cells = |quantity: Quantity| {
            let first = self.first().value(quantity);
            let cell = |(index, side): (usize, &Side)| match side.value(quantity) {
                None => ABSENT.to_owned(),
                Some(value) => quantity.shown(value, first.filter(|_| index > 0)),
            };
            self.sides.iter().enumerate().map(cell).collect::<Vec<String>>()
        };
        rows.extend(Quantity::all().into_iter().map(|quantity| Row {
            label: quantity.label(),
            cells: cells(quantity),
        }));
        rows.retain(|row| row.cells.iter().any(|cell| cell != ABSENT));
        rows
    }

    fn first(&self) -> &Side<'_> {
        &self.sides[0]
    }
}

/// The columns of the table of all panels.
pub fn columns(panels: &[Panel]) -> Vec<Column> {
    let rows = panels.iter().flat_map(|panel| {
        let others = panel.sides.iter().skip(1);
        others.flat_map(move |side| Quantity::all().into_iter().map(move |quantity| (panel, side, quantity)))
    });
    let rows = Rows(rows.collect());
    let value = |row: &(&Panel, &Side, Quantity)| row.1.value(row.2);
    let first = |row: &(&Panel, &Side, Quantity)| row.0.first().value(row.2);
    vec![
        rows.text("set", |row| row.0.title),
        rows.text("first_study", |row| row.0.sides[0].study),
        rows.text("first_case", |row| row.0.first().name()),
        rows.text("study", |row| row.1.study),
        rows.text("case", |row| row.1.name()),
        rows.text("quantity", |row| row.2.column()),
        rows.number("first", first),
        rows.number("value", value),
        rows.number("difference", |row| Some(row.2.difference(value(row)?, first(row)?))),
        rows.number("relative_difference", |row| {
            row.2.relative_difference(value(row)?, first(row)?)
        }),
        rows.number("scatter", |row| row.0.scatter(row.1, row.2)),
        rows.number("asked", |row| row.0.asked(row.2)),
    ]
}
