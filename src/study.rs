//! The study file: what a person types, checked with line and column.
//!
//! A text becomes a tree in which everything knows its place (`tree`), the tree becomes typed values that keep their
//! places (`reader`, `file`), and a case with all its changes laid over the base (`overlay`) becomes a
//! [`case::Case`] once it makes sense (`resolve`). Mistakes are collected on the way and told all at once.

pub mod case;
pub mod cluster;
mod defaults;
mod error;
mod file;
mod finding;
mod lines;
mod named;
mod overlay;
mod quantity;
mod reader;
mod refusal;
mod resolve;
mod schema;
mod source;
mod tree;

pub(crate) use defaults::SEED;
pub use error::{Mistake, StudyError};
pub use file::Growth;
pub(crate) use file::{CaseFile, Noise, Repeats, Run, SideBySideFile, StudyFile};
pub(crate) use finding::{Finding, Findings, Place, alternatives, nearest, suggestion};
pub(crate) use named::{Name, Sweep};
pub(crate) use overlay::Overlay;
pub(crate) use reader::{Given, read as read_tree};
pub use refusal::{Refusal, Subject};
pub use resolve::Table;
pub(crate) use resolve::resolve;
pub use schema::schema;
pub use source::{SHIPPED, Shipped};
pub(crate) use tree::{Node, Value};

use std::sync::Arc;

/// Version of the study file that this program reads.
const FORMAT: u32 = 1;

/// A study file as read. Mistakes in it do not stop the reading: `plan::plan` tells them together with its own.
#[derive(Clone, Debug)]
pub struct Study {
    pub(crate) file: String,
    pub(crate) text: Arc<str>,
    /// Where the study begins, after all comments: the place of what is missing from it.
    pub(crate) start: Place,
    pub(crate) content: StudyFile,
    pub(crate) findings: Findings,
    /// Where it came with the program.
    shipped: Option<&'static Shipped>,
}

/// Read a study file, or the shipped study of that name where there is no such file.
pub fn read(path: &str) -> Result<Study, StudyError> {
    let (text, shipped) = source::text(path).map_err(|finding| StudyError::new(path, "".into(), vec![finding]))?;
    let study = read_text(path, &text)?;
    Ok(Study { shipped, ..study })
}

/// Read the text of a study; `file` is what messages call it.
pub fn read_text(file: &str, text: &str) -> Result<Study, StudyError> {
    let findings = Findings::default();
    let text: Arc<str> = text.into();
    let fail = |finding: Finding| StudyError::new(file, Arc::clone(&text), vec![finding]);
    let root = tree::parse(&text, &findings).map_err(fail)?;
    check_root(&root).map_err(fail)?;
    let mut content = match read_tree(&root, &findings) {
        Given::Right(content, _) => content,
        _ => StudyFile::default(),
    };
    if let Given::Absent = content.base {
        content.base = Given::Right(CaseFile::default(), root.place);
    }
    Ok(Study {
        file: file.into(),
        text,
        start: root.place,
        content,
        findings,
        shipped: None,
    })
}

impl Study {
    /// The text of a file that the study names, in its own folder; the error tells what is wrong with it.
    pub(crate) fn beside(&self, name: &str) -> Result<String, String> {
        source::beside(&self.file, self.shipped, name)
    }

    /// What was found in it, as an error.
    pub(crate) fn error(&self, findings: &Findings) -> StudyError {
        StudyError::new(&self.file, Arc::clone(&self.text), findings.sorted())
    }
}

/// What is no study at all, or of a later format, is not read further: every message about it would mislead.
fn check_root(root: &Node) -> Result<(), Finding> {
    if !matches!(root.value, Value::Map(_)) {
        let message = "this is not a study, which begins with `study: name` and has `base` and `cases`";
        return Err(Finding::at(root.place, message).help("`cgaft new NAME` writes a commented study to start from"));
    }
    let Some(node) = root.get("cgaft") else { return Ok(()) };
    match node.text().parse::<u32>() {
        Ok(FORMAT) => Ok(()),
        Ok(other) if other > FORMAT => Err(Finding::at(
            node.place,
            format!("this study is written in format {other}; this cgaft reads format {FORMAT}"),
        )
        .help("install a newer cgaft")),
        _ => {
            Err(Finding::at(node.place, "this is not a format of study files").help(format!("write `cgaft: {FORMAT}`")))
        }
    }
}
