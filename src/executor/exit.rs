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
const SIGNAL_FILE_SIZE: i32 = 25;

/// What `mpirun` ends with where it has no better word.
const OF_MPIRUN: i32 = 1;
/// A shell, and `mpirun`, add a signal to this.
const SIGNALLED: i32 = 128;
const LAST_SIGNAL: i32 = 64;
/// What Open MPI says of a rank that has aborted the others, before the code.
const ABORTED_WITH: &str = "with errorcode ";

/// How a solver ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    With(i32),
    BySignal(i32),
    /// `mpirun` tells no more than that.
    ByMpirun,
    Unknown,
}

impl Ended {
    pub fn of(status: ExitStatus) -> Ended {
        match (status.code(), status.signal()) {
            (Some(code), _) => Ended::With(code),
            (None, Some(signal)) => Ended::BySignal(signal),
            (None, None) => Ended::Unknown,
        }
    }

    /// How the ranks of a solver ended, from what their `mpirun` ended with and the log says.
    pub fn of_ranks(status: ExitStatus, log: &[String]) -> Ended {
        let aborted = |line: &String| line.split_once(ABORTED_WITH)?.1.trim_end_matches('.').parse().ok();
        match Ended::of(status) {
            Ended::With(OF_MPIRUN) => log.iter().rev().find_map(aborted).map_or(Ended::ByMpirun, Ended::With),
            Ended::With(code) if code != i32::from(INTERRUPTED) && (1..=LAST_SIGNAL).contains(&(code - SIGNALLED)) => {
                Ended::BySignal(code - SIGNALLED)
            }
            other => other,
        }
    }

    /// `None` if a signal has ended it.
    pub fn code(self) -> Option<i32> {
        match self {
            Ended::With(code) => Some(code),
            Ended::ByMpirun => Some(OF_MPIRUN),
            Ended::BySignal(_) | Ended::Unknown => None,
        }
    }

    pub fn is_interruption(self) -> bool {
        self == Ended::With(i32::from(INTERRUPTED))
    }

    /// The ending in words, and what to do about it.
    pub fn meaning(self) -> String {
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
        match self {
            Ended::With(PANICKED) => {
                "the solver has a bug and gave up (exit code 101); please report its log".to_owned()
            }
            Ended::ByMpirun => {
                "`mpirun` could not start the ranks, or has ended them (exit code 1); the log tells why".to_owned()
            }
            Ended::With(code) => match CODES.iter().find(|(known, _)| i32::from(*known) == code) {
                Some((_, words)) => format!("{words} (exit code {code})"),
                None => format!("the solver ended with exit code {code}"),
            },
            Ended::BySignal(SIGNAL_KILL) => "the solver was killed (signal 9); perhaps the memory was full".to_owned(),
            Ended::BySignal(SIGNAL_FILE_SIZE) => {
                "a file became larger than this shell allows (signal 25); `ulimit -f` tells how large".to_owned()
            }
            Ended::BySignal(signal) => format!("the solver was ended by signal {signal}"),
            Ended::Unknown => "the solver ended in an unknown way".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_ending_has_words() {
        let meaning = |raw: i32| Ended::of(ExitStatus::from_raw(raw)).meaning();
        assert_eq!(meaning(4 << 8).split(';').next(), Some("the physics failed"));
        assert_eq!(meaning(77 << 8), "the solver ended with exit code 77");
        assert!(meaning(9).contains("memory"));
        assert!(meaning(11).contains("signal 11"));
    }

    /// Endings as Open MPI 4.1 was seen to pass them on.
    #[test]
    fn ranks_end_as_the_first_of_them_that_fails() {
        let log = ["MPI_ABORT was invoked on rank 2", "with errorcode 101."].map(str::to_owned);
        let ended = |code: i32, log: &[String]| Ended::of_ranks(ExitStatus::from_raw(code << 8), log);
        for code in [0, 2, 3, 4, 5, 130] {
            assert_eq!(ended(code, &log), Ended::With(code), "{code}");
        }
        assert_eq!(ended(137, &[]), Ended::BySignal(9));
        assert_eq!(ended(139, &[]), Ended::BySignal(11));
        assert_eq!(ended(1, &log), Ended::With(101));
        assert!(ended(1, &[]).meaning().contains("mpirun"));
    }
}
