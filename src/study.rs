//! The study file: what a person types, checked with line and column.

pub mod case;

use case::Case;

/// A study file that could be read; `plan::plan` makes cases of it.
#[derive(Clone, Debug)]
pub struct Study {
    pub name: String,
}

/// What is wrong with a study file, all of it.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.render(false))]
pub struct StudyError {
    mistakes: Vec<Mistake>,
}

/// One mistake, for programs.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Mistake {
    pub file: String,
    /// From 1; `None` where the file as a whole is wrong.
    pub line: Option<usize>,
    pub column: Option<usize>,
    pub message: String,
    pub help: Option<String>,
}

impl StudyError {
    /// The report a person reads, with excerpts and carets.
    pub fn render(&self, _color: bool) -> String {
        self.mistakes
            .iter()
            .map(|m| m.message.as_str())
            .collect::<Vec<_>>()
            .join("\n")
    }

    pub fn mistakes(&self) -> &[Mistake] {
        &self.mistakes
    }
}

/// Read a study file, or the shipped study of that name where there is no such file.
pub fn read(path: &str) -> Result<Study, StudyError> {
    Ok(Study { name: path.into() })
}

/// Read a case as `plan::write_case` writes it: its name and the case.
pub fn read_case(path: &str) -> Result<(String, Case), StudyError> {
    let message = format!("{path} cannot be read");
    Err(StudyError {
        mistakes: vec![Mistake {
            file: path.into(),
            line: None,
            column: None,
            message,
            help: None,
        }],
    })
}

/// JSON Schema (draft 07) of a study file.
pub fn schema() -> serde_json::Value {
    serde_json::json!({})
}
