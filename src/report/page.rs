//! The page: everything a reader needs, in one file that asks nothing of the network.

mod text;

use super::chart::{Chart, Drawing};
use super::overview::{self, Group, Row};
use super::picture::{Gallery, Picture};
use super::side_by_side::Panel;
use super::table::Table;
use super::tables::{cheapest, comparison, specimen, speed_against_error};
use super::{Analysed, CaseResult, ReportError, Study, agreement, method, numbers, scaling, sweep, verdict};
use crate::plan::Comparison;
use crate::units::amounts::duration;
use minijinja::syntax::SyntaxConfig;
use minijinja::{AutoEscape, Environment, Value, context};
use text::{base64, breakable, indented, markdown_cell};

/// Tables longer than this are linked instead of shown.
const SHOWN_ROWS: usize = 60;

/// More cases than this stand one below the other in the comparison.
const MOST_ABREAST: usize = 8;

/// Letters of all columns, each with a gap, that stand beside each other on paper; the others begin again below.
const MOST_LETTERS: usize = 140;
const COLUMN_GAP: usize = 3;

/// More pictures of one kind than this are a grid of small ones.
const MOST_LARGE: usize = 3;

/// What the page is made from.
pub struct Page<'a> {
    pub study: &'a Study,
    pub cases: &'a [Analysed<'a>],
    pub scaling: Option<&'a scaling::Findings>,
    pub tables: &'a [Table],
    pub charts: &'a [Chart],
    pub drawn: &'a [Drawing],
    pub galleries: &'a [Gallery],
    pub panels: &'a [Panel<'a>],
}

impl Page<'_> {
    pub fn html(&self) -> Result<String, ReportError> {
        self.render("report.html", include_str!("templates/report.html"))
    }

    pub fn markdown(&self) -> Result<String, ReportError> {
        self.render("report.md", include_str!("templates/report.md"))
    }

    fn render(&self, name: &'static str, template: &'static str) -> Result<String, ReportError> {
        let mut versions = self.cases.iter().map(|case| case.result.manifest.version.as_str());
        let page = context! {
            title => self.study.title.as_ref().unwrap_or(&self.study.name),
            name => &self.study.name,
            question => self.study.question.as_ref(),
            text => &self.study.text,
            verdict => self.verdict().join(" "),
            sentences => self.verdict(),
            names => list(self.cases, |case| case.name().into()),
            many => self.cases.len() > MOST_ABREAST,
            groups => list(&self.groups(), group),
            specimens => list(&specimen::notes(self.cases), pair),
            agreement => list(&agreement::notes(self.cases, &self.study.comparisons, self.tables), pair),
            scaling => self.scaling.map(|found| gain(self.study, found)),
            economies => self.economies(),
            comparisons => list(&self.study.comparisons, |one| compared(one, self.tables)),
            panels => list(self.panels, panel),
            missing => self.study.others.iter().filter_map(|other| other.missing.clone()).collect::<Vec<String>>(),
            galleries => list(self.galleries, gallery),
            charts => self.charts.iter().zip(self.drawn).map(chart).collect::<Vec<Value>>(),
            tables => list(self.tables, table),
            cases => list(self.cases, |analysed| {
                let mut lines = provenance(analysed.result);
                lines.extend(analysed.findings.speed_window.map(|time| ("speed fitted over", picoseconds(time))));
                case(analysed.result, lines)
            }),
            notes => list(&method::notes(self.cases), pair),
            style => Value::from_safe_string(include_str!("templates/style.css").to_owned()),
            version => versions.find(|version| !version.is_empty()),
        };
        rendered(name, template, page)
    }

    /// Where there are many cases each group is a table of its own.
    fn groups(&self) -> Vec<Group> {
        match self.cases.len() > MOST_ABREAST {
            true => overview::tables(self.cases),
            false => overview::groups(self.cases),
        }
    }

    fn verdict(&self) -> Vec<String> {
        match self.scaling.and_then(scaling::verdict) {
            Some(gain) => vec![format!("{} {gain}", verdict::done(self.cases))],
            None => {
                let advice = cheapest::recommendations(&speed_against_error::rows(self.cases));
                let verdict = verdict::verdict(self.cases);
                // A sweep asks how something depends on its keys, other studies of many meshes which of them to take.
                match sweep::keys(self.cases).is_empty() {
                    true => [advice, verdict].concat(),
                    false => [verdict, advice].concat(),
                }
            }
        }
    }

    /// The cheapest case that is near enough, for each quantity; nothing where there are too few cases.
    fn economies(&self) -> Option<Value> {
        let rows = speed_against_error::rows(self.cases);
        let (heads, lines) = cheapest::shown(&rows);
        (!lines.is_empty()).then(|| context! { heads, rows => lines })
    }
}

/// What the page of a study of solids is made from.
pub struct Solids<'a> {
    pub study: &'a Study,
    pub cases: &'a [&'a CaseResult],
    pub scaling: Option<&'a scaling::Findings>,
    /// Its first sentences.
    pub verdict: Vec<String>,
    pub groups: Vec<Group>,
    /// How its numbers came about.
    pub notes: Vec<(&'static str, String)>,
    pub tables: &'a [Table],
    pub charts: &'a [Chart],
    pub drawn: &'a [Drawing],
    pub galleries: &'a [Gallery],
}

impl Solids<'_> {
    pub fn html(&self) -> Result<String, ReportError> {
        self.render("report.html", include_str!("templates/report.html"))
    }

    pub fn markdown(&self) -> Result<String, ReportError> {
        self.render("report.md", include_str!("templates/report.md"))
    }

    fn render(&self, name: &'static str, template: &'static str) -> Result<String, ReportError> {
        let mut versions = self.cases.iter().map(|case| case.manifest.version.as_str());
        let page = context! {
            title => self.study.title.as_ref().unwrap_or(&self.study.name),
            name => &self.study.name,
            question => self.study.question.as_ref(),
            text => &self.study.text,
            verdict => self.verdict.join(" "),
            sentences => &self.verdict,
            names => list(self.cases, |case| case.name.as_str().into()),
            many => self.cases.len() > MOST_ABREAST,
            groups => list(&self.groups, group),
            scaling => self.scaling.map(|found| gain(self.study, found)),
            comparisons => list(&self.study.comparisons, |one| compared(one, self.tables)),
            galleries => list(self.galleries, gallery),
            charts => self.charts.iter().zip(self.drawn).map(chart).collect::<Vec<Value>>(),
            tables => list(self.tables, table),
            cases => list(self.cases, |result| case(result, provenance(result))),
            notes => list(&self.notes, pair),
            panels => Vec::<Value>::new(),
            style => Value::from_safe_string(include_str!("templates/style.css").to_owned()),
            version => versions.find(|version| !version.is_empty()),
        };
        rendered(name, template, page)
    }
}

/// Times, speedup and efficiency over ranks.
fn gain(study: &Study, found: &scaling::Findings) -> Value {
    let rows: Vec<Vec<String>> = found.rows.iter().map(scaling::cells).collect();
    context! { columns => scaling::HEADS, rows, notes => list(&scaling::notes(study, found), pair) }
}

/// What comes from elsewhere beside what the cases say.
fn compared(comparison: &Comparison, tables: &[Table]) -> Value {
    let lines = comparison::lines(comparison, tables);
    context! {
        name => &comparison.name,
        file => &comparison.file,
        notes => &comparison.notes,
        rows => list(&lines, |line| line.cells().to_vec().into()),
    }
}

fn rendered(name: &'static str, template: &'static str, page: Value) -> Result<String, ReportError> {
    let mut environment = Environment::new();
    environment.set_syntax(SyntaxConfig::builder().trim_blocks(true).lstrip_blocks(true).build()?);
    environment.set_auto_escape_callback(|name| match name.ends_with(".html") {
        true => AutoEscape::Html,
        false => AutoEscape::None,
    });
    environment.add_filter("cell", markdown_cell);
    environment.add_filter("breakable", breakable);
    environment.add_filter("block", indented);
    environment.add_filter("breakable", breakable);
    environment.add_template(name, template)?;
    Ok(environment.get_template(name)?.render(page)?)
}

/// A list for the template.
fn list<T>(items: &[T], view: impl Fn(&T) -> Value) -> Value {
    items.iter().map(view).collect::<Vec<Value>>().into()
}

fn chart((chart, drawing): (&Chart, &Drawing)) -> Value {
    let svg = Value::from_safe_string(drawing.inline.clone());
    context! { id => &chart.id, detail => chart.detail, title => &chart.title, caption => &chart.caption, table => chart.table, svg }
}

fn gallery(gallery: &Gallery) -> Value {
    context! { title => &gallery.title, lead => &gallery.lead, small => gallery.pictures.len() > MOST_LARGE, pictures => list(&gallery.pictures, picture) }
}

fn picture(picture: &Picture) -> Value {
    let data = Value::from_safe_string(format!("data:image/png;base64,{}", base64(&picture.png)));
    context! { file => &picture.file, title => &picture.title, caption => &picture.caption, data }
}

/// Without rows where the table is too long to be shown.
fn table(table: &Table) -> Value {
    let rows = if table.height() <= SHOWN_ROWS {
        table.rows()
    } else {
        Vec::new()
    };
    let columns = table.columns();
    let pieces: Vec<Value> = pieces(&columns, &rows)
        .into_iter()
        .map(|piece| {
            let of_piece = |cells: &[String]| piece.iter().map(|&column| cells[column].clone()).collect::<Vec<_>>();
            context! { columns => of_piece(&columns), rows => rows.iter().map(|row| of_piece(row)).collect::<Vec<_>>() }
        })
        .collect();
    context! { name => table.name, columns, height => table.height(), pieces, is_shown => !rows.is_empty() }
}

/// Which columns stand beside each other: the first in every piece, and each other in one.
fn pieces(columns: &[String], rows: &[Vec<String>]) -> Vec<Vec<usize>> {
    let letters = |column: usize| {
        let cells = rows.iter().map(|row| row[column].chars().count());
        cells.max().unwrap_or(0).max(columns[column].chars().count()) + COLUMN_GAP
    };
    let mut pieces: Vec<Vec<usize>> = Vec::new();
    let mut room = 0;
    for column in 1..columns.len() {
        if room < letters(column) {
            pieces.push(vec![0]);
            room = MOST_LETTERS.saturating_sub(letters(0));
        }
        room = room.saturating_sub(letters(column));
        pieces.last_mut().unwrap_or(&mut Vec::new()).push(column);
    }
    pieces
}

fn group(group: &Group) -> Value {
    context! { title => group.title, rows => list(&group.rows, row) }
}

fn panel(panel: &Panel) -> Value {
    let heads: Vec<Value> = panel.heads().into_iter().map(Value::from).collect();
    let (title, across) = (Value::from(panel.title), panel.is_across_studies());
    context! { title, across, heads, differences => panel.differences(), rows => list(&panel.rows(), row) }
}

fn row(row: &Row) -> Value {
    context! { label => &row.label, cells => row.cells.clone() }
}

fn case(case: &CaseResult, provenance: Vec<(&'static str, String)>) -> Value {
    let failure = case.failure.as_ref();
    context! {
        name => &case.name,
        resolved => &case.resolved,
        failure => failure.map(|failure| context! { reason => &failure.reason, log => &failure.log_tail }),
        run => list(&provenance, pair),
        files => files(case),
    }
}

/// The files of a published run that a person opens; they stand beside the page.
fn files(case: &CaseResult) -> Vec<&'static str> {
    let mut files = vec!["case.yaml", "manifest.json", "log.txt", "series.h5"];
    files.extend(case.has_pictures().then_some("fields.vtkhdf"));
    files.push("checkpoint.h5");
    match case.manifest.state.as_str() {
        "done" => files,
        _ => Vec::new(),
    }
}

fn pair((label, value): &(&'static str, String)) -> Value {
    vec![Value::from(*label), Value::from(value)].into()
}

/// How and where a case ran; what is not known is left out.
fn provenance(case: &CaseResult) -> Vec<(&'static str, String)> {
    let manifest = &case.manifest;
    let lines = [
        ("state", Some(manifest.state.clone())),
        ("ended because", manifest.end_reason.clone()),
        ("case hash", Some(case.id.clone())),
        ("program", Some(manifest.version.clone())),
        ("commit", manifest.commit.clone()),
        ("host", manifest.host.clone()),
        ("ranks", manifest.ranks.map(|ranks| ranks.to_string())),
        ("threads per rank", manifest.threads.map(|threads| threads.to_string())),
        ("started", manifest.started.clone()),
        ("ended", manifest.ended.clone()),
        ("wall time", manifest.wall_seconds.map(duration)),
        (
            "core-seconds",
            case.core_seconds().map(|seconds| numbers::significant(seconds, 4)),
        ),
        ("time step", manifest.time_step.map(picoseconds)),
        ("stability limit", manifest.stability_limit.map(picoseconds)),
    ];
    let known = lines.into_iter().filter_map(|(label, value)| Some((label, value?)));
    known.filter(|line| !line.1.is_empty()).collect()
}

fn picoseconds(value: f64) -> String {
    format!("{} ps", numbers::significant(value, 4))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wide_tables_are_cut_into_pieces_that_paper_can_hold_each_with_the_names_of_its_rows() {
        let text = |length: usize| "x".repeat(length);
        let columns: Vec<String> = [4, 90, 60, 40, 200, 3].map(text).to_vec();
        let row = vec![text(10); 6];
        let pieces = pieces(&columns, &[row]);
        assert_eq!(pieces, [vec![0, 1], vec![0, 2, 3], vec![0, 4], vec![0, 5]]);
    }
}
