//! Exit codes of the solver and what they mean.

use std::os::unix::process::ExitStatusExt;
use std::process::ExitStatus;

pub const BAD_INPUT: u8 = 2;
pub const MISSING_ENVIRONMENT: u8 = 3;
pub const PHYSICS_FAILED: u8 = 4;
pub const OUTPUT_FAILED: u8 = 5;
/// Stopped on request, with a checkpoint.
pub const INTERRUPTED: u8 = 130;

/// Rust's own exit code after a panic.
const PANICKED: i32 = 101;
const SIGNAL_KILL: i32 = 9;

/// An ending in words, and what to do about it.
pub fn meaning(status: ExitStatus) -> String {
    const CODES: [(u8, &str); 5] = [
        (BAD_INPUT, "the case was refused"),
        (
            MISSING_ENVIRONMENT,
            "something is missing on this machine; `cgaft doctor` tells what",
        ),
        (
            PHYSICS_FAILED,
            "the physics failed; the log tells the step, the place and what to try",
        ),
        (OUTPUT_FAILED, "the output could not be written"),
        (INTERRUPTED, "interrupted"),
    ];
    match (status.code(), status.signal()) {
        (Some(PANICKED), _) => "the solver has a bug and gave up (exit code 101); please report its log".to_owned(),
        (Some(code), _) => match CODES.iter().find(|(known, _)| i32::from(*known) == code) {
            Some((_, words)) => format!("{words} (exit code {code})"),
            None => format!("the solver ended with exit code {code}"),
        },
        (None, Some(SIGNAL_KILL)) => "the solver was killed (signal 9); perhaps the memory was full".to_owned(),
        (None, Some(signal)) => format!("the solver was ended by signal {signal}"),
        (None, None) => "the solver ended in an unknown way".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_ending_has_words() {
        assert_eq!(
            meaning(ExitStatus::from_raw(4 << 8)).split(';').next(),
            Some("the physics failed")
        );
        assert_eq!(
            meaning(ExitStatus::from_raw(77 << 8)),
            "the solver ended with exit code 77"
        );
        assert!(meaning(ExitStatus::from_raw(9)).contains("memory"));
        assert!(meaning(ExitStatus::from_raw(11)).contains("signal 11"));
    }
}
