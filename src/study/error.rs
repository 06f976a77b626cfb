//! The answer to a study file that is wrong: every mistake with its place, an excerpt and what to do.

use super::{
    finding::{Finding, MOST_FINDINGS},
    lines::Lines,
};
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, SourceCode};
use serde::Serialize;
use std::{fmt, sync::Arc};

/// What is wrong with a study file, all of it.
#[derive(Clone, thiserror::Error)]
#[error("{}", self.render(false))]
pub struct StudyError {
    lines: Lines,
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
            lines: Lines::new(file, text),
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
        let mut report = String::new();
        for finding in self.findings.iter().take(MOST_SHOWN) {
            let shown = Shown {
                finding,
                lines: &self.lines,
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
        let file = self.lines.file();
        match self.findings.len() {
            1 => format!("1 mistake in {file}; nothing was started"),
            number @ ..=MOST_SHOWN => format!("{number} mistakes in {file}; nothing was started"),
            number => {
                let more = if number < MOST_FINDINGS { "" } else { " or more" };
                format!("{number}{more} mistakes in {file}, of which {MOST_SHOWN} are shown; nothing was started")
            }
        }
    }

    pub fn mistakes(&self) -> Vec<Mistake> {
        self.findings.iter().map(|finding| self.mistake(finding)).collect()
    }

    fn mistake(&self, finding: &Finding) -> Mistake {
        let position = finding.place.map(|place| self.lines.position(place));
        Mistake {
            file: self.lines.file().into(),
            line: position.map(|(line, _)| line),
            column: position.map(|(_, column)| column),
            message: finding.message.clone(),
            help: help(finding),
        }
    }
}

impl fmt::Debug for StudyError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_list().entries(self.mistakes()).finish()
    }
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
    lines: &'a Lines,
}

impl Shown<'_> {
    /// Whether there is a place to show, and all its lines are short enough.
    fn excerpt(&self) -> bool {
        let mut places = self
            .finding
            .place
            .into_iter()
            .chain(self.finding.related.iter().map(|(place, _)| *place));
        self.finding.place.is_some() && places.all(|place| self.lines.longest(place) <= LONGEST_EXCERPT)
    }
}

impl std::error::Error for Shown<'_> {}

impl fmt::Debug for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let message = &self.finding.message;
        match self.finding.place.map(|place| self.lines.position(place)) {
            Some((line, column)) if !self.excerpt() => write!(f, "{}:{line}:{column}: {message}", self.lines.file()),
            Some(_) => f.write_str(message),
            None => write!(f, "{}: {message}", self.lines.file()),
        }
    }
}

impl Diagnostic for Shown<'_> {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        help(self.finding).map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.excerpt().then_some(self.lines as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let place = self.finding.place.filter(|_| self.excerpt())?;
        // Among several labels a caret without a word looks like a slip.
        let word = (!self.finding.related.is_empty()).then(|| "here".to_owned());
        let main = LabeledSpan::new_primary_with_span(word, place.range());
        let related = self.finding.related.iter();
        let others = related.map(|(place, what)| LabeledSpan::new_with_span(Some(what.clone()), place.range()));
        Some(Box::new(std::iter::once(main).chain(others)))
    }
}
