//! How a table is made of rows, written to a file and shown on the page. Absent values are empty, never 0.

use std::path::Path;

use polars::prelude::*;

use super::numbers::{self, round_significant};
use super::{Analysed, ReportError, save};

/// Digits of a number in a file: more than any of them means, few enough to be read.
const DIGITS: usize = 9;

/// Digits of a number on the page.
const SHOWN_DIGITS: usize = 4;

/// A named table.
pub struct Table {
    pub name: &'static str,
    frame: DataFrame,
}

impl Table {
    pub fn new(name: &'static str, columns: Vec<Column>) -> Result<Table, ReportError> {
        match DataFrame::new_infer_height(columns) {
            Ok(frame) => Ok(Table { name, frame }),
            Err(error) => Err(ReportError::Table {
                table: name,
                reason: error.to_string(),
            }),
        }
    }

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
pub fn collect<'a, T, I: Iterator<Item = T>>(cases: &'a [Analysed<'a>], of: impl Fn(&'a Analysed<'a>) -> I) -> Rows<T> {
    Rows(cases.iter().flat_map(of).collect())
}
