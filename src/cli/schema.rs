use super::{CliError, terminal};
use crate::study;

/// `cgaft schema`
pub fn schema() -> Result<u8, CliError> {
    let text = serde_json::to_string_pretty(&study::schema()).expect("a schema has a JSON form");
    terminal::print(&format!("{text}\n"))?;
    Ok(0)
}
