use super::{CliError, terminal};
use crate::study;

/// The JSON Schema of a study file.
pub fn text() -> String {
    serde_json::to_string_pretty(&study::schema()).expect("a schema has a JSON form") + "\n"
}

/// `cgaft schema`
pub fn schema() -> Result<u8, CliError> {
    terminal::print(&text())?;
    Ok(0)
}
