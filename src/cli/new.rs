use std::fs::File;
use std::io::{self, Write};

use clap::Args;

use super::{CliError, terminal};
use crate::plan;

#[derive(Args, Debug)]
pub struct Arguments {
    /// Name of the study; NAME.yaml is written into the current folder
    pub name: String,
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
            terminal::print(&format!(
                "wrote {path}; look at its size with `cgaft study check {path}`, run it with `cgaft study run {path}`\n"
            ))?;
            Ok(0)
        }
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Err(CliError::Input(format!(
            "{path} exists already; choose another name, or remove it first"
        ))),
        Err(source) => Err(CliError::Output { what: path, source }),
    }
}
