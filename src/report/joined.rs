//! One table of many studies: their rows below each other, with the study and what was chosen for each case before them.

use std::collections::BTreeSet;
use std::io::Cursor;

use polars::prelude::*;

use super::ReportError;
use crate::plan::{Swept, SweptValue};

/// The table of one study.
pub struct Part {
    pub study: String,
    /// As its CSV file.
    pub text: String,
    /// The cases whose choices are known, with all of them: `crack.length`, `56 nm`.
    pub choices: Vec<(String, Vec<(String, String)>)>,
}

/// Columns and rows; an empty cell is absent.
#[derive(Debug, PartialEq)]
pub struct Joined {
    pub columns: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

/// A row while columns are not yet known: names and cells.
type Row = Vec<(String, String)>;

impl Joined {
    /// Puts the tables together. What differs between the cases of all of them becomes a column.
    pub fn of(table: &'static str, parts: &[Part]) -> Result<Joined, ReportError> {
        let differing = differing(parts);
        let mut rows: Vec<[Row; 3]> = Vec::new();
        for part in parts {
            for cells in rows_of(table, &part.text)? {
                let case = cells
                    .iter()
                    .find(|(column, _)| column == "case")
                    .map(|(_, name)| name.clone());
                let known = part.choices.iter().find(|(name, _)| Some(name) == case.as_ref());
                let chosen = known.map_or_else(Vec::new, |(_, choices)| parameters(choices, &differing));
                let (mut head, mut own): (Row, Row) = cells.into_iter().partition(|(column, _)| column == "case");
                // A swept key has its column in the table already.
                own.retain(|(column, _)| !chosen.iter().any(|(name, _)| name == column));
                head.insert(0, ("study".to_owned(), part.study.clone()));
                rows.push([head, chosen, own]);
            }
        }
        let mut columns: Vec<String> = Vec::new();
        for place in 0..3 {
            for (column, _) in rows.iter().flat_map(|row| &row[place]) {
                if !columns.contains(column) {
                    columns.push(column.clone());
                }
            }
        }
        let cell = |row: &[Row; 3], column: &String| {
            let found = row.iter().flatten().find(|(name, _)| name == column);
            found.map_or_else(String::new, |(_, cell)| cell.clone())
        };
        let rows = rows
            .iter()
            .map(|row| columns.iter().map(|column| cell(row, column)).collect());
        Ok(Joined {
            rows: rows.collect(),
            columns,
        })
    }

    /// The same without columns that say nothing.
    pub fn without_empty_columns(self) -> Joined {
        let is_said = |column: usize| self.rows.iter().any(|row| !row[column].is_empty());
        let kept: Vec<usize> = (0..self.columns.len()).filter(|column| is_said(*column)).collect();
        let of = |cells: &[String]| kept.iter().map(|column| cells[*column].clone()).collect();
        Joined {
            columns: of(&self.columns),
            rows: self.rows.iter().map(|row| of(row)).collect(),
        }
    }

    /// As a CSV file.
    pub fn csv(&self) -> Result<String, ReportError> {
        let column = |(place, name): (usize, &String)| {
            let cells: Vec<Option<&str>> = self.rows.iter().map(|row| Some(row[place].as_str())).collect();
            let cells: Vec<Option<&str>> = cells
                .into_iter()
                .map(|cell| cell.filter(|cell| !cell.is_empty()))
                .collect();
            Column::new(name.as_str().into(), cells)
        };
        let columns = self.columns.iter().enumerate().map(column).collect();
        let mut bytes = Vec::new();
        DataFrame::new_infer_height(columns)
            .and_then(|mut frame| CsvWriter::new(&mut bytes).finish(&mut frame))
            .map_err(|error| failed("joined", &error))?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }
}

/// The keys that do not have one value in all cases; those that only some cases have are among them.
fn differing(parts: &[Part]) -> BTreeSet<String> {
    let cases = || parts.iter().flat_map(|part| &part.choices).map(|(_, choices)| choices);
    let keys: BTreeSet<&String> = cases().flatten().map(|(key, _)| key).collect();
    let value = |choices: &Vec<(String, String)>, key: &str| {
        let found = choices.iter().find(|(name, _)| name == key);
        found.map(|(_, value)| value.clone())
    };
    let varies = |key: &&String| {
        let values: BTreeSet<Option<String>> = cases().map(|choices| value(choices, key)).collect();
        values.len() > 1
    };
    keys.into_iter().filter(varies).cloned().collect()
}

/// What was chosen for a case, as columns with the unit in their name.
fn parameters(choices: &[(String, String)], differing: &BTreeSet<String>) -> Row {
    let wanted = choices.iter().filter(|(key, _)| differing.contains(key));
    let cell = |(key, value): &(String, String)| {
        let read = Swept::read(key, value);
        let cell = match &read.value {
            SweptValue::Number { value, .. } => value.to_string(),
            SweptValue::Word(word) => word.clone(),
        };
        (read.column(), cell)
    };
    wanted.map(cell).collect()
}

/// The rows of a CSV file.
fn rows_of(table: &'static str, text: &str) -> Result<Vec<Row>, ReportError> {
    let frame = CsvReadOptions::default()
        .with_infer_schema_length(Some(0))
        .into_reader_with_file_handle(Cursor::new(text.as_bytes()))
        .finish()
        .map_err(|error| failed(table, &error))?;
    let cell = |column: &Column, row: usize| {
        let text = column.get(row).ok().and_then(|cell| cell.get_str().map(str::to_owned));
        (column.name().to_string(), text.unwrap_or_default())
    };
    let rows = (0..frame.height()).map(|row| frame.columns().iter().map(|column| cell(column, row)).collect());
    Ok(rows.collect())
}

fn failed(table: &'static str, error: &PolarsError) -> ReportError {
    ReportError::Table {
        table,
        reason: error.to_string(),
    }
}
