//! Finding the text of a study and of the files that it names: files here, or what came with the program.

use super::finding::{Finding, nearest};
use crate::durable;
use std::{
    fs::{self, File},
    io::{ErrorKind, Read},
    path::Path,
};

/// A study that is part of the program.
#[derive(Debug)]
pub struct Shipped {
    /// Name of its file.
    pub name: &'static str,
    pub text: &'static str,
    /// The tables that its `compare` names, and their texts.
    pub tables: &'static [(&'static str, &'static str)],
}

/// A shipped study and the tables beside it.
macro_rules! shipped {
    ($name:literal $(, $table:literal)*) => {
        Shipped {
            name: $name,
            text: include_str!(concat!("../../studies/", $name)),
            tables: &[$(($table, include_str!(concat!("../../studies/", $table)))),*],
        }
    };
}

pub static SHIPPED: [Shipped; 30] = [
    shipped!("quickstart.yaml"),
    shipped!("speed-against-error.yaml", "speed-against-error/lammps.csv"),
    shipped!("case-1.yaml", "case-1/strains.csv"),
    shipped!("case-2.yaml", "case-2/strains.csv", "case-2/branching.csv"),
    shipped!(
        "models-A-E.yaml",
        "models-A-E/table-5-1.csv",
        "models-A-E/strains.csv",
        "models-A-E/table-5-2.csv",
        "models-A-E/branching.csv",
        "models-A-E/table-5-3.csv"
    ),
    shipped!("models-A-E-small.yaml"),
    shipped!(
        "models-A-E-fine.yaml",
        "models-A-E/strains.csv",
        "models-A-E/table-5-2.csv",
        "models-A-E/branching.csv",
        "models-A-E/table-5-3.csv"
    ),
    shipped!(
        "models-A-E-mixed.yaml",
        "models-A-E/table-5-2.csv",
        "models-A-E/branching.csv",
        "models-A-E/table-5-3.csv"
    ),
    shipped!(
        "models-A-E-refined.yaml",
        "models-A-E/table-5-2.csv",
        "models-A-E/branching.csv",
        "models-A-E/table-5-3.csv"
    ),
    shipped!(
        "models-A-E-atoms.yaml",
        "models-A-E/table-5-2.csv",
        "models-A-E/branching.csv",
        "models-A-E/table-5-3.csv"
    ),
    shipped!("branching-control.yaml"),
    shipped!("convergence-D.yaml"),
    shipped!("repeats-small.yaml"),
    shipped!("chaos-small.yaml"),
    shipped!("scaling-fixed.yaml", "scaling/table-4-2.csv"),
    shipped!("scaling-scaled.yaml", "scaling/table-4-3.csv"),
    shipped!("scaling-fixed-3d.yaml", "scaling/table-4-2.csv"),
    shipped!("scaling-scaled-3d.yaml", "scaling/table-4-3.csv"),
    shipped!("quickstart-3d.yaml"),
    shipped!("wave-bar.yaml", "wave-bar/lammps.csv"),
    shipped!("wave-slab.yaml"),
    shipped!("speed-against-error-3d.yaml", "speed-against-error-3d/lammps.csv"),
    shipped!("film-3d.yaml"),
    shipped!("film-3d-small.yaml"),
    shipped!("mixed-mode.yaml"),
    shipped!("mixed-mode-small.yaml"),
    shipped!("impact.yaml"),
    shipped!("impact-small.yaml"),
    shipped!("crack-surface.yaml"),
    shipped!("crack-surface-small.yaml"),
];

/// Largest file that is read, in bytes; a study of a thousand cases is a hundredth of it.
const LARGEST: u64 = 1_000_000;

/// The text of a study file, or the shipped study of that name where there is no such file.
pub fn text(path: &str) -> Result<(String, Option<&'static Shipped>), Finding> {
    if Path::new(path).is_dir() {
        return Err(Finding::whole("this is a folder, not a file").help("name the study file in it"));
    }
    match durable::open(Path::new(path)) {
        Ok(file) => read(file).map(|text| (text, None)),
        Err(error) if error.kind() == ErrorKind::NotFound => {
            shipped(path).map(|shipped| (shipped.text.into(), Some(shipped)))
        }
        Err(error) => Err(unreadable(&error)),
    }
}

/// The text of a file that a study names, in the folder of the study; the error tells what is wrong with it.
pub fn beside(study: &str, shipped: Option<&Shipped>, name: &str) -> Result<String, String> {
    if let Some(shipped) = shipped {
        let found = shipped.tables.iter().find(|(table, _)| *table == name);
        return found
            .map(|(_, text)| (*text).to_owned())
            .ok_or_else(|| format!("{name} does not come with this study"));
    }
    let path = Path::new(study).parent().unwrap_or(Path::new("")).join(name);
    let mut text = String::new();
    match durable::open(&path).and_then(|file| file.take(LARGEST + 1).read_to_string(&mut text)) {
        Ok(bytes) if bytes as u64 > LARGEST => Err(format!("{name} is larger than 1 MB")),
        Ok(_) => Ok(text),
        Err(error) => Err(format!("{name} cannot be read: {error}")),
    }
}

fn read(file: File) -> Result<String, Finding> {
    let mut bytes = Vec::new();
    // A file may grow while it is read, so no more than this is ever read.
    file.take(LARGEST + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| unreadable(&error))?;
    if bytes.len() as u64 > LARGEST {
        return Err(Finding::whole("the file is larger than 1 MB")
            .help("describe many cases by a sweep over lists or ranges; is this really a study file?"));
    }
    String::from_utf8(bytes).map_err(|error| {
        let line = error.as_bytes()[..error.utf8_error().valid_up_to()]
            .iter()
            .filter(|byte| **byte == b'\n')
            .count()
            + 1;
        Finding::whole(format!("the file is not UTF-8 text (line {line})"))
            .help("save it as UTF-8; is this really a study file?")
    })
}

fn shipped(path: &str) -> Result<&'static Shipped, Finding> {
    let parent = Path::new(path).parent().unwrap_or(Path::new(""));
    let name = Path::new(path).file_name().and_then(|name| name.to_str()).unwrap_or("");
    let found = SHIPPED.iter().find(|shipped| shipped.name == name);
    match found.filter(|_| parent == Path::new("") || parent == Path::new("studies")) {
        Some(shipped) => Ok(shipped),
        None => {
            Err(Finding::whole("there is no such file, and no shipped study of that name").help(instead(parent, name)))
        }
    }
}

/// What may have been meant by a name that is not there.
fn instead(folder: &Path, name: &str) -> String {
    let shipped = SHIPPED.each_ref().map(|shipped| shipped.name);
    let here = if folder == Path::new("") {
        Path::new(".")
    } else {
        folder
    };
    let entries = fs::read_dir(here).into_iter().flatten().flatten();
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    let own: Vec<String> = names
        .filter(|name| name.ends_with(".yaml") || name.ends_with(".yml"))
        .collect();
    let known: Vec<&str> = own.iter().map(String::as_str).chain(shipped).collect();
    match nearest(name, &known) {
        Some(near) if own.iter().any(|own| own == near) => format!("did you mean `{}`?", folder.join(near).display()),
        Some(near) => format!("did you mean `{near}`?"),
        None => {
            let shipped = shipped.join(", ");
            format!("shipped studies: {shipped}; `cgaft new NAME` writes a study to start from")
        }
    }
}

fn unreadable(error: &std::io::Error) -> Finding {
    Finding::whole(format!("the file cannot be read: {error}")).help("check its name and permissions")
}
