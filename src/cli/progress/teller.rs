use std::io::{IsTerminal, Write, stderr, stdout};
use std::time::{Duration, Instant};

use clap::ValueEnum;

use super::bars::new_bar;
use super::{Pace, progress_words};
use crate::cli::terminal::warn;
use crate::executor::Progress;

/// How `cgaft-solve` tells how far it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Style {
    /// One JSON object a line on standard output, and now and then a plain line on standard error
    Json,
    /// A progress bar on standard error
    Bar,
    /// A plain line every few seconds on standard error
    Lines,
}

/// Time between two messages of each style.
const JSON_EVERY: Duration = Duration::from_millis(200);
const BAR_EVERY: Duration = Duration::from_millis(100);
const LINE_EVERY: Duration = Duration::from_secs(5);
/// In a log that someone reads afterwards.
const LOG_EVERY: Duration = Duration::from_secs(60);

/// What the solver calls as often as it likes.
pub fn teller(style: Option<Style>, name: &str) -> Box<dyn FnMut(&Progress) + Send> {
    let fitting = if stderr().is_terminal() {
        Style::Bar
    } else {
        Style::Lines
    };
    match style.unwrap_or(fitting) {
        Style::Json => {
            let mut speak = throttled(JSON_EVERY, |progress, _| {
                let line = serde_json::to_string(progress).expect("progress has a JSON form");
                // If nobody listens any more, the closed pipe on the other side says so.
                let _ = writeln!(stdout().lock(), "{line}");
            });
            let mut log = throttled(LOG_EVERY, log_line);
            Box::new(move |progress| {
                speak(progress);
                log(progress);
            })
        }
        Style::Bar => {
            let bar = new_bar(name);
            throttled(BAR_EVERY, move |progress, pace| {
                bar.set_position(progress.percent as u64);
                bar.set_message(progress_words(progress, pace));
            })
        }
        Style::Lines => throttled(LINE_EVERY, log_line),
    }
}

fn log_line(progress: &Progress, pace: &mut Pace) {
    warn(&format!(
        "{:.0} %  {}",
        progress.percent,
        progress_words(progress, pace)
    ));
}

/// Lets the first message through, then one every so often, and at the end the last that was held back, so that
/// whoever listens knows how far it came.
fn throttled(
    every: Duration,
    tell: impl FnMut(&Progress, &mut Pace) + Send + 'static,
) -> Box<dyn FnMut(&Progress) + Send> {
    let mut valve = Valve {
        tell,
        since: None,
        held: None,
    };
    Box::new(move |progress| valve.take(progress, every))
}

/// What stands between many messages and few.
struct Valve<F: FnMut(&Progress, &mut Pace)> {
    tell: F,
    since: Option<(Pace, Instant)>,
    held: Option<(Progress, Pace)>,
}

impl<F: FnMut(&Progress, &mut Pace)> Valve<F> {
    fn take(&mut self, progress: &Progress, every: Duration) {
        let (mut pace, told) = match self.since {
            Some((pace, told)) => (pace, Some(told)),
            None => (Pace::starting_at(progress.percent), None),
        };
        if told.is_none_or(|told| told.elapsed() >= every) {
            (self.tell)(progress, &mut pace);
            self.since = Some((pace, Instant::now()));
            self.held = None;
        } else {
            self.held = Some((*progress, pace));
        }
    }
}

impl<F: FnMut(&Progress, &mut Pace)> Drop for Valve<F> {
    fn drop(&mut self) {
        if let Some((progress, mut pace)) = self.held.take() {
            (self.tell)(&progress, &mut pace);
        }
    }
}
