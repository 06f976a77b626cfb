use std::fs::File;
use std::io::{self, Write};

use clap::Args;

use super::{CliError, schema, terminal};
use crate::plan;

#[derive(Args, Debug)]
pub struct Arguments {
    /// Name of the study; NAME.yaml is written into the current folder
    pub name: String,
}

/// The schema that the first line of a new study names.
const SCHEMA: &str = "study.schema.json";

/// Writes the schema beside the study; not where there is one.
fn write_schema() -> io::Result<bool> {
    match File::create_new(SCHEMA) {
        Ok(mut file) => file.write_all(schema::text().as_bytes()).map(|()| true),
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok(false),
        Err(error) => Err(error),
    }
}

/// `cgaft new NAME`
pub fn new(arguments: &Arguments) -> Result<u8, CliError> {
    let name = arguments.name.strip_suffix(".yaml").unwrap_or(&arguments.name);
    let plain = |letter: char| letter.is_ascii_alphanumeric() || "-_.".contains(letter);
    if name.is_empty() || name.starts_with('.') || !name.chars().all(plain) {
        return Err(CliError::Input(format!(
            "`{name}` cannot name a study; use letters, digits, `-`, `_` and `.`, such as `my-crack`"
        )));
    }
    let path = format!("{name}.yaml");
    let write = || File::create_new(&path)?.write_all(plan::starter(name).as_bytes());
    match write() {
        Ok(()) => {
            let beside = match write_schema() {
                Ok(true) => format!(" and {SCHEMA}, with which an editor completes and checks it"),
                Ok(false) => String::new(),
                Err(source) => {
                    return Err(CliError::Output {
                        what: SCHEMA.to_owned(),
                        source,
                    });
                }
            };
            terminal::print(&format!(
                "wrote {path}{beside}; look at its size with `cgaft study check {path}`, run it with `cgaft study run {path}`\n"
            ))?;
            Ok(0)
        }
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Err(CliError::Input(format!(
            "{path} exists already; choose another name, or remove it first"
        ))),
        Err(source) => Err(CliError::Output { what: path, source }),
    }
}
