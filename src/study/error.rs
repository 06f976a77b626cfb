//! The answer to a study file that is wrong: every mistake with its place, an excerpt and what to do.

use super::finding::{Finding, Place};
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, SourceCode};
use serde::Serialize;
use std::{fmt, sync::Arc};

/// What is wrong with a study file, all of it.
#[derive(Clone, thiserror::Error)]
#[error("{}", self.render(false))]
pub struct StudyError {
    file: String,
    text: Arc<str>,
    findings: Vec<Finding>,
}

/// One mistake, for programs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mistake {
    pub file: String,
    /// From 1; `None` where the file as a whole is wrong.
    pub line: Option<usize>,
    /// In characters, from 1.
    pub column: Option<usize>,
    pub message: String,
    pub help: Option<String>,
}

/// Mistakes that are shown in full; what comes after them is counted.
const MOST_SHOWN: usize = 50;
/// Longest line that is shown as an excerpt, in bytes.
const LONGEST_EXCERPT: usize = 400;
/// Columns of the report.
const WIDTH: usize = 110;

impl StudyError {
    pub(super) fn new(file: &str, text: Arc<str>, findings: Vec<Finding>) -> Self {
        Self {
            file: file.into(),
            text,
            findings,
        }
    }

    /// The report a person reads, with excerpts and carets; for a terminal in colour.
    pub fn render(&self, color: bool) -> String {
        let theme = if color {
            GraphicalTheme::unicode()
        } else {
            GraphicalTheme::unicode_nocolor()
        };
        let handler = GraphicalReportHandler::new_themed(theme)
            .with_width(WIDTH)
            .with_links(false);
        let source = NamedSource::new(&self.file, Arc::clone(&self.text));
        let mut report = String::new();
        for finding in self.findings.iter().take(MOST_SHOWN) {
            let shown = Shown {
                finding,
                source: &source,
                excerpt: self.excerpts(finding),
                file: &self.file,
            };
            // Writing into a String does not fail; a report that cannot be laid out still says what is wrong.
            if handler.render_report(&mut report, &shown).is_err() {
                report += &finding.message;
            }
            report.push('\n');
        }
        report + &self.summary()
    }

    fn summary(&self) -> String {
        let hidden = self.findings.len().saturating_sub(MOST_SHOWN);
        let more = if hidden > 0 {
            format!(" ({hidden} more are not shown)")
        } else {
            String::new()
        };
        match self.findings.len() {
            1 => format!("1 mistake in {}; nothing was started", self.file),
            number => format!("{number} mistakes in {}{more}; nothing was started", self.file),
        }
    }

    pub fn mistakes(&self) -> Vec<Mistake> {
        self.findings.iter().map(|finding| self.mistake(finding)).collect()
    }

    fn mistake(&self, finding: &Finding) -> Mistake {
        let position = finding.place.map(|place| position(&self.text, place));
        Mistake {
            file: self.file.clone(),
            line: position.map(|(line, _)| line),
            column: position.map(|(_, column)| column),
            message: finding.message.clone(),
            help: help(finding),
        }
    }

    /// Whether all lines to be shown are short enough.
    fn excerpts(&self, finding: &Finding) -> bool {
        let short = |place: Place| {
            let (before, after) = self.text.split_at(place.start);
            let start = before.rfind('\n').map_or(0, |at| at + 1);
            let end = place.start + after.find('\n').unwrap_or(after.len());
            end - start <= LONGEST_EXCERPT
        };
        finding.place.is_some_and(short) && finding.related.iter().all(|(place, _)| short(*place))
    }
}

impl fmt::Debug for StudyError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_list().entries(self.mistakes()).finish()
    }
}

/// Line and column of the beginning of a place, in characters, from 1.
fn position(text: &str, place: Place) -> (usize, usize) {
    let before = &text[..place.start];
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    (before.matches('\n').count() + 1, before[start..].chars().count() + 1)
}

/// The help of a finding and the cases it concerns.
fn help(finding: &Finding) -> Option<String> {
    let cases = match finding.cases.as_slice() {
        [] => return finding.help.clone(),
        [case] => format!("(case {case})"),
        [first, second] => format!("(cases {first} and {second})"),
        [first, second, rest @ ..] => format!("(cases {first}, {second} and {} more)", rest.len()),
    };
    Some(
        finding
            .help
            .as_ref()
            .map_or_else(|| cases.clone(), |help| format!("{help} {cases}")),
    )
}

/// One finding as miette lays it out.
struct Shown<'a> {
    finding: &'a Finding,
    source: &'a NamedSource<Arc<str>>,
    excerpt: bool,
    file: &'a str,
}

impl std::error::Error for Shown<'_> {}

impl fmt::Debug for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.finding.place {
            Some(place) if !self.excerpt => {
                let (line, column) = position(self.source.inner(), place);
                write!(f, "{}:{line}:{column}: {}", self.file, self.finding.message)
            }
            Some(_) => f.write_str(&self.finding.message),
            None => write!(f, "{}: {}", self.file, self.finding.message),
        }
    }
}

impl Diagnostic for Shown<'_> {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        help(self.finding).map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.excerpt.then_some(self.source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let place = self.finding.place.filter(|_| self.excerpt)?;
        // Among several labels a caret without a word looks like a slip.
        let word = (!self.finding.related.is_empty()).then(|| "here".to_owned());
        let main = LabeledSpan::new_primary_with_span(word, place.range());
        let others = self
            .finding
            .related
            .iter()
            .map(|(place, what)| LabeledSpan::new_with_span(Some(what.clone()), place.range()));
        Some(Box::new(std::iter::once(main).chain(others)))
    }
}
