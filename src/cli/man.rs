use std::fs;
use std::path::PathBuf;

use clap::{Args, CommandFactory};

use super::{Cgaft, CliError, solve, terminal};

#[derive(Args, Debug)]
pub struct Arguments {
    /// Folder for the pages, made if it is missing
    #[arg(value_name = "DIR")]
    pub into: PathBuf,
}

/// `cgaft man DIR`: a page for each program and each command.
pub fn man(arguments: &Arguments) -> Result<u8, CliError> {
    let into = &arguments.into;
    let written = fs::create_dir_all(into)
        .and_then(|()| clap_mangen::generate_to(Cgaft::command(), into))
        .and_then(|()| clap_mangen::generate_to(solve::command(), into));
    written.map_err(|source| CliError::Output {
        what: into.display().to_string(),
        source,
    })?;
    terminal::print(&format!(
        "wrote the pages into {0}; read one with `man {0}/cgaft-study-run.1`\n",
        into.display()
    ))?;
    Ok(0)
}
