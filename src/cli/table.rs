use std::path::{Path, PathBuf};

use clap::Args;

use super::{CliError, choices, format, terminal};
use crate::durable;
use crate::report::{Joined, Part};
use crate::store::{State, Store};

#[derive(Args, Debug)]
pub struct Arguments {
    /// Name of the table, such as summary
    pub table: String,
    /// Folders of results, one per study: results/*
    #[arg(required = true, value_name = "RESULTS")]
    pub folders: Vec<PathBuf>,
    /// Print CSV, with every column
    #[arg(long)]
    pub csv: bool,
}

/// `cgaft table NAME RESULTS…`: the same table of several studies, with what differs between their cases as columns.
pub fn table(arguments: &Arguments) -> Result<u8, CliError> {
    let name = &arguments.table;
    let mut parts = Vec::new();
    for folder in &arguments.folders {
        match durable::read_to_string(&file(folder, name)) {
            Ok(text) => parts.push(part(folder, text)?),
            Err(error) => terminal::warn(&format!(
                "warning: {} is left out: {}: {error}; `cgaft study report` writes its tables",
                folder.display(),
                file(folder, name).display()
            )),
        }
    }
    if parts.is_empty() {
        let there = names(&arguments.folders);
        let there = match there.is_empty() {
            true => "none of them has tables: name folders of results, such as results/*".to_owned(),
            false => format!("there are {}", there.join(", ")),
        };
        return Err(CliError::Input(format!("no folder has a table `{name}`; {there}")));
    }
    let joined = Joined::of("joined", &parts)?;
    terminal::print(&match arguments.csv {
        true => joined.csv()?,
        false => {
            let Joined { columns, rows } = joined.without_empty_columns();
            let lines: Vec<Vec<String>> = std::iter::once(columns).chain(rows).collect();
            format::list(&lines)
        }
    })?;
    Ok(0)
}

fn file(folder: &Path, table: &str) -> PathBuf {
    folder.join("tables").join(format!("{table}.csv"))
}

/// A table, and what was chosen for each case of its study that is done.
fn part(folder: &Path, text: String) -> Result<Part, CliError> {
    let whole = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
    let study = whole.file_name().unwrap_or_default().display().to_string();
    let store = Store::open(whole.parent().unwrap_or(&whole), &study)?;
    let names = text.lines().skip(1).filter_map(|line| line.split(',').next());
    let known = |case: &str| match store.state(&store.linked(case)?) {
        State::Done(manifest) => Some((case.to_owned(), choices::of_case(&manifest.case))),
        _ => None,
    };
    let mut known: Vec<_> = names.filter_map(known).collect();
    known.dedup_by(|a, b| a.0 == b.0);
    Ok(Part {
        study,
        choices: known,
        text,
    })
}

/// The tables that any of the folders has.
fn names(folders: &[PathBuf]) -> Vec<String> {
    let entries = folders
        .iter()
        .filter_map(|folder| std::fs::read_dir(folder.join("tables")).ok());
    let files = entries
        .flatten()
        .flatten()
        .filter_map(|entry| entry.file_name().into_string().ok());
    let mut names: Vec<String> = files
        .filter_map(|file| Some(file.strip_suffix(".csv")?.to_owned()))
        .collect();
    names.sort();
    names.dedup();
    names
}
