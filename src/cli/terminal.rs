//! The only place that prints.

use std::io::{self, IsTerminal, Write};

use super::CliError;

/// Where words for people go: standard output, or standard error when programs read the former, or nowhere.
#[derive(Clone, Copy, Debug, Default)]
pub struct Terminal {
    pub quiet: bool,
    pub json: bool,
}

impl Terminal {
    /// Something for people, a line each.
    pub fn say(&self, text: &str) {
        if self.quiet {
            return;
        }
        if self.json {
            warn(text);
        } else {
            // A reader that has gone away (`cgaft … | head`) must not end a computation.
            let _ = writeln!(io::stdout().lock(), "{text}");
        }
    }

    /// The result of a command: JSON if that was asked for, else the words.
    pub fn result(&self, json: &serde_json::Value, words: impl FnOnce() -> String) -> Result<(), CliError> {
        if self.json {
            let text = serde_json::to_string_pretty(json).expect("a JSON value has a JSON form");
            return print(&format!("{text}\n"));
        }
        if self.quiet { Ok(()) } else { print(&words()) }
    }
}

/// Something a person must see even when quiet.
pub fn warn(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// Writes to standard output. A reader that has seen enough is no error.
pub fn print(text: &str) -> Result<(), CliError> {
    let mut output = io::stdout().lock();
    match output.write_all(text.as_bytes()).and_then(|()| output.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(CliError::Output {
            what: "to standard output".to_owned(),
            source: error,
        }),
        _ => Ok(()),
    }
}

/// Whether messages may be coloured.
pub fn color() -> bool {
    io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none()
}
