//! `compare`: values from elsewhere to set beside those of the cases.
//!
//! A CSV file with a column `case`, and columns of one table of the report. A row of a case that a sweep varies is
//! meant for all that come of it. In place of `case` there may be columns of swept keys, as the tables have them: a row is
//! meant for all cases with these values. Times of another program on several processors have a column `ranks` instead.

use super::compared::{CASE, COMPARED, Compared, RANKS};
use super::draft::Draft;
use crate::study::{Finding, Findings, Place, Study, alternatives, suggestion};
use serde::Serialize;

/// A file to compare with.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Its key in `compare`.
    pub name: String,
    pub file: String,
    /// What its comment lines say; empty where there are none.
    pub notes: String,
    /// Table of the report that has its columns.
    pub table: &'static str,
    pub values: Vec<Expected>,
}

/// One value of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Expected {
    /// Name of a case, or a number of ranks.
    pub case: String,
    /// Columns that tell the rows of one case apart, and the words in them.
    pub keys: Vec<(&'static str, String)>,
    pub column: &'static str,
    pub value: f64,
}

/// The value that comparisons give in a column of a table for the row of a case that has these words, if any does.
pub fn reference(comparisons: &[Comparison], table: &str, column: &str, case: &str, words: &[&str]) -> Option<f64> {
    let alike = comparisons.iter().filter(|comparison| comparison.table == table);
    let mut values = alike.flat_map(|comparison| &comparison.values);
    let is_it = |expected: &&Expected| {
        let keys = expected.keys.iter().map(|key| key.1.as_str());
        expected.case == case && expected.column == column && keys.eq(words.iter().copied())
    };
    Some(values.find(is_it)?.value)
}

/// Reads every file that the study compares with; what is wrong goes to `findings`.
pub fn read(study: &Study, drafts: &[Draft], findings: &Findings) -> Vec<Comparison> {
    if drafts.is_empty() {
        // What is wrong with the cases has been noted; every row would only repeat it.
        return Vec::new();
    }
    let named = study
        .content
        .compare
        .right()
        .map_or([].as_slice(), |compare| &compare.0);
    let given = named
        .iter()
        .filter_map(|(name, file)| Some((name, file.right()?, file.place()?)));
    let comparison = |(name, file, place): (&crate::study::Name, &String, Place)| {
        let text = study.beside(file).map_err(|why| {
            findings.add(Finding::at(place, why).help("name a CSV file in the folder of this study"));
        });
        let sheet = Sheet {
            file,
            place,
            drafts,
            findings,
        };
        let text = text.ok()?;
        let (table, values) = sheet.read(&text)?;
        Some(Comparison {
            name: name.text.clone(),
            file: file.clone(),
            notes: notes(&text),
            table: table.table,
            values,
        })
    };
    given.filter_map(comparison).collect()
}

/// The comment lines of a file as one paragraph.
fn notes(text: &str) -> String {
    let lines = text.lines().filter_map(|line| line.trim_start().strip_prefix('#'));
    lines.map(str::trim).collect::<Vec<_>>().join(" ")
}

/// A file as it is read.
struct Sheet<'a> {
    file: &'a str,
    /// Where the study names it.
    place: Place,
    drafts: &'a [Draft],
    findings: &'a Findings,
}

impl Sheet<'_> {
    /// The table it speaks of and what it says; `None` where that cannot be told.
    fn read(&self, text: &str) -> Option<(&'static Compared, Vec<Expected>)> {
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let head = self.parsed(reader.headers().cloned())?;
        let table = self.table(&head)?;
        let mut values = Vec::new();
        for record in reader.records() {
            let Some(record) = self.parsed(record) else {
                continue;
            };
            let cells: Vec<(&str, &str)> = head.iter().zip(&record).collect();
            self.row(
                table,
                &cells,
                record.position().map_or(0, csv::Position::line),
                &mut values,
            );
        }
        Some((table, values))
    }

    fn parsed<T>(&self, record: csv::Result<T>) -> Option<T> {
        let told = |error: csv::Error| {
            let message = match error.kind() {
                csv::ErrorKind::UnequalLengths {
                    pos: Some(position),
                    expected_len,
                    len,
                } => format!(
                    "{}, line {}: {len} cells, and the head line has {expected_len}",
                    self.file,
                    position.line()
                ),
                _ => format!("{} is no CSV file: {error}", self.file),
            };
            self.add(
                message,
                "write a head line, and rows of as many cells, with a comma between them",
            );
        };
        record.map_err(told).ok()
    }

    fn table(&self, head: &csv::StringRecord) -> Option<&'static Compared> {
        let by_case = head.iter().any(|column| column == CASE || column == RANKS);
        if !by_case && !head.iter().any(|column| self.is_swept(column)) {
            let message = format!("{} has no column `{CASE}`", self.file);
            let help = match head.iter().any(|cell| cell.contains([';', '\t'])) {
                true => "put commas between the cells, in place of semicolons or tabs",
                false => "name the case of every row in it: the first line names the columns",
            };
            self.add(message, help);
            return None;
        }
        let has = |table: &Compared, column: &str| {
            let is_row = column == table.row || !by_case && table.row == CASE && self.is_swept(column);
            is_row || table.values.contains(&column) || table.keys.iter().any(|key| key.0 == column)
        };
        let fits = |table: &&Compared| {
            head.iter().all(|column| has(table, column))
                && head
                    .iter()
                    .any(|column| column == table.row || !by_case && table.row == CASE && self.is_swept(column))
                && head.iter().any(|column| table.values.contains(&column))
                && table.keys.iter().all(|key| head.iter().any(|column| column == key.0))
        };
        if let Some(table) = COMPARED.iter().find(fits) {
            return Some(table);
        }
        let unknown = head
            .iter()
            .filter(|column| COMPARED.iter().all(|table| !has(table, column)));
        let unknown: Vec<&str> = unknown.collect();
        let mut values: Vec<&str> = Vec::new();
        for value in COMPARED.iter().flat_map(|table| table.values) {
            if !values.contains(value) {
                values.push(value);
            }
        }
        for column in &unknown {
            self.add(
                format!("{} has a column `{column}`, which no table has", self.file),
                suggestion(column, &values),
            );
        }
        if unknown.is_empty() {
            let columns: Vec<String> = COMPARED.iter().map(Compared::columns).collect();
            self.add(
                format!("the columns of {} are not those of one table", self.file),
                format!("write {}", columns.join(", or ")),
            );
        }
        None
    }

    fn row(&self, table: &'static Compared, cells: &[(&str, &str)], line: u64, values: &mut Vec<Expected>) {
        let cell = |column: &str| cells.iter().find(|cell| cell.0 == column).map_or("", |cell| cell.1);
        let by_case = cells.iter().any(|cell| cell.0 == table.row);
        let cases = match by_case {
            true => self.rows_of(table, cell(table.row), line),
            false => self.swept_to(cells, line),
        };
        let Some(cases) = cases else { return };
        let mut keys = Vec::new();
        for (key, words) in table.keys {
            if !words.contains(&cell(key)) {
                let message = format!("{}, line {line}: `{}` is no {key}", self.file, cell(key));
                self.add(message, suggestion(cell(key), words));
                return;
            }
            keys.push((*key, cell(key).to_owned()));
        }
        for column in table.values.iter().copied().filter(|column| !cell(column).is_empty()) {
            match cell(column).parse::<f64>() {
                Ok(value) if value.is_finite() => values.extend(cases.iter().map(|case| Expected {
                    case: (*case).to_owned(),
                    keys: keys.clone(),
                    column,
                    value,
                })),
                _ => self.add(
                    format!("{}, line {line}: `{}` is no number", self.file, cell(column)),
                    format!(
                        "write a plain number: the column `{column}` tells its unit; leave empty what is not known"
                    ),
                ),
            }
        }
    }

    /// The cases that a row is meant for, or the number of ranks that it is of.
    fn rows_of<'a>(&'a self, table: &Compared, wanted: &'a str, line: u64) -> Option<Vec<&'a str>> {
        if table.row == RANKS {
            if wanted.parse::<u32>().is_ok_and(|ranks| ranks > 0) {
                return Some(vec![wanted]);
            }
            let message = format!("{}, line {line}: `{wanted}` is no number of ranks", self.file);
            self.add(message, "write a whole number of at least 1");
            return None;
        }
        let meant = self
            .drafts
            .iter()
            .filter(|draft| draft.name == wanted || draft.origin == wanted);
        let cases: Vec<&str> = meant.map(|draft| draft.name.as_str()).collect();
        if !cases.is_empty() {
            return Some(cases);
        }
        let mut names: Vec<&str> = self.drafts.iter().map(|draft| draft.origin.as_str()).collect();
        names.dedup();
        let message = format!("{}, line {line}: the study has no case `{wanted}`", self.file);
        self.add(
            message,
            format!("its cases are {}", alternatives(&names).replace(" or ", " and ")),
        );
        None
    }

    /// Whether tables have a column of this name for a swept key.
    fn is_swept(&self, column: &str) -> bool {
        let mut swept = self.drafts.iter().flat_map(|draft| &draft.swept);
        swept.any(|swept| swept.column() == column)
    }

    /// The cases whose swept keys have the values of a row.
    fn swept_to(&self, cells: &[(&str, &str)], line: u64) -> Option<Vec<&str>> {
        let wanted = || cells.iter().filter(|(column, _)| self.is_swept(column));
        let has = |draft: &&Draft| {
            wanted().all(|(column, text)| {
                let mut swept = draft.swept.iter();
                swept.any(|swept| swept.column() == *column && swept.is(text))
            })
        };
        let cases: Vec<&str> = self
            .drafts
            .iter()
            .filter(has)
            .map(|draft| draft.name.as_str())
            .collect();
        if !cases.is_empty() {
            return Some(cases);
        }
        let values: Vec<String> = wanted().map(|(column, text)| format!("{column} {text}")).collect();
        self.add(
            format!(
                "{}, line {line}: the sweep makes no case of {}",
                self.file,
                values.join(", ")
            ),
            "write values that the sweep has, or leave the row out",
        );
        None
    }

    fn add(&self, message: String, help: impl Into<String>) {
        self.findings.add(Finding::at(self.place, message).help(help));
    }
}
