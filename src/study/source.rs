//! Finding the text of a study: a file here, or a study that came with the program.

use super::finding::Finding;
use std::{
    fs::File,
    io::{ErrorKind, Read},
    path::Path,
};

/// Studies that are part of the program, by file name.
pub const SHIPPED: [(&str, &str); 1] = [("quickstart.yaml", include_str!("../../studies/quickstart.yaml"))];

/// Largest file that is read, in bytes; a study of a thousand cases is a hundredth of it.
const LARGEST: u64 = 1_000_000;

/// The text of a study file, or of the shipped study of that name where there is no such file.
pub fn text(path: &str) -> Result<String, Finding> {
    match File::open(path) {
        Ok(file) => read(file, path),
        Err(error) if error.kind() == ErrorKind::NotFound => shipped(path),
        Err(error) => Err(unreadable(&error)),
    }
}

fn read(file: File, path: &str) -> Result<String, Finding> {
    if Path::new(path).is_dir() {
        return Err(Finding::whole("this is a folder, not a file").help("name the study file in it"));
    }
    let mut bytes = Vec::new();
    // The size that a file states need not be true (a pipe), so no more than this is ever read.
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

fn shipped(path: &str) -> Result<String, Finding> {
    let parent = Path::new(path).parent().unwrap_or(Path::new(""));
    let name = Path::new(path).file_name().and_then(|name| name.to_str()).unwrap_or("");
    let found = SHIPPED.iter().find(|(shipped, _)| *shipped == name);
    match found.filter(|_| parent == Path::new("") || parent == Path::new("studies")) {
        Some((_, text)) => Ok((*text).into()),
        None => {
            let names = SHIPPED.map(|(name, _)| name).join(", ");
            Err(
                Finding::whole("there is no such file, and no shipped study of that name").help(format!(
                    "shipped studies: {names}; `cgaft new NAME` writes a study to start from"
                )),
            )
        }
    }
}

fn unreadable(error: &std::io::Error) -> Finding {
    Finding::whole(format!("the file cannot be read: {error}")).help("check its name and permissions")
}
