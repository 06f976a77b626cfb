use std::collections::HashMap;
use std::time::Duration;

use indicatif::{MultiProgress, ProgressBar, ProgressStyle};

use super::{
    Pace, STOPPING, WAITING, Whole, ending_words, failure_words, progress_words, reached_words, study_words,
    widened_words,
};
use crate::cli::terminal::{Terminal, warn};
use crate::executor::{Ending, Job, Progress, Watcher};
use crate::store::{Reached, Store};

/// A bar a case.
pub struct Bars {
    terminal: Terminal,
    store: Store,
    screen: MultiProgress,
    /// By the id of the case.
    cases: HashMap<String, (ProgressBar, Option<Pace>)>,
    whole: Whole,
    /// Below the cases, where there are several.
    study: Option<ProgressBar>,
}

/// A bar with the name before it and room for words behind it.
pub fn new_bar(name: &str) -> ProgressBar {
    let style = ProgressStyle::with_template("{prefix:12} {bar:24.cyan/dim} {percent:>3} %  {wide_msg}");
    let style = style.expect("the template is right").progress_chars("━━─");
    ProgressBar::new(100).with_style(style).with_prefix(name.to_owned())
}

impl Bars {
    pub fn new(terminal: Terminal, store: Store, whole: Whole) -> Bars {
        let screen = MultiProgress::new();
        let study = whole.is_several().then(|| screen.add(new_bar("study")));
        Bars {
            terminal,
            store,
            screen,
            cases: HashMap::new(),
            whole,
            study,
        }
    }

    fn bar(&mut self, job: &Job) -> &mut (ProgressBar, Option<Pace>) {
        let (screen, below) = (&self.screen, usize::from(self.study.is_some()));
        self.cases.entry(job.id.clone()).or_insert_with(|| {
            let bar = screen.insert_from_back(below, new_bar(&job.name));
            bar.enable_steady_tick(Duration::from_millis(200));
            (bar, None)
        })
    }
}

impl Bars {
    /// `2 of 9 cases ended, about 12 min left of the study`
    fn tell_study(&self) {
        let Some(bar) = &self.study else { return };
        let (ended, total) = (self.whole.ended(), self.whole.total());
        bar.set_position((100 * ended / total) as u64);
        let left = study_words(&self.whole)
            .map(|words| format!(", {words}"))
            .unwrap_or_default();
        bar.set_message(format!("{ended} of {total} cases ended{left}"));
        if ended == total {
            bar.finish_and_clear();
        }
    }
}

impl Watcher for Bars {
    fn submitted(&mut self, job: &Job, id: &str) {
        self.bar(job).0.set_message(format!("Slurm job {id}"));
    }

    fn queued(&mut self, job: &Job, why: &str) {
        self.bar(job).0.set_message(format!("queued ({why})"));
    }

    fn started(&mut self, job: &Job) {
        let count = self.whole.count(job);
        self.bar(job).0.set_message(format!("starting, {count}"));
    }

    fn widened(&mut self, job: &Job, cores: usize) {
        let (bar, pace) = self.bar(job);
        *pace = None;
        bar.set_message(widened_words(cores));
    }

    fn progress(&mut self, job: &Job, progress: &Progress) {
        let (bar, pace) = self.bar(job);
        let pace = pace.get_or_insert_with(|| Pace::starting_at(progress.percent));
        bar.set_position(progress.percent as u64);
        bar.set_message(progress_words(progress, pace));
        self.whole.reach(job, progress.percent);
        self.tell_study();
    }

    fn reached(&mut self, job: &Job, reached: &Reached) {
        let (bar, _) = self.bar(job);
        bar.set_position(reached.percent as u64);
        bar.set_message(reached_words(reached));
    }

    fn waiting(&mut self, job: &Job) {
        self.bar(job).0.set_message(WAITING);
    }

    fn stopping(&mut self) {
        self.screen.suspend(|| warn(STOPPING));
    }

    fn ended(&mut self, job: &Job, ending: &Ending) {
        self.bar(job).0.finish_and_clear();
        self.whole.end(job);
        self.tell_study();
        self.screen.suspend(|| match ending {
            Ending::Failed(failure) => warn(&failure_words(job, failure, &self.store)),
            _ => self.terminal.say(&ending_words(job, ending)),
        });
    }
}
