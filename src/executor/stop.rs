use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag::register_conditional_shutdown;
use signal_hook::iterator::Signals;

use super::exit;

/// How often the user has asked to stop: once is a request, twice is an order.
#[derive(Clone, Debug, Default)]
pub struct Stop {
    asked: Arc<AtomicUsize>,
    /// Nothing is at work that would have to be stopped with care.
    idle: Arc<AtomicBool>,
}

impl Stop {
    /// Counts Ctrl-C and SIGTERM of this process from now on; outside [`Stop::with_care`] they end it at once.
    pub fn on_signals() -> io::Result<Stop> {
        let stop = Stop {
            idle: Arc::new(AtomicBool::new(true)),
            ..Stop::default()
        };
        for signal in [SIGINT, SIGTERM] {
            register_conditional_shutdown(signal, i32::from(exit::INTERRUPTED), stop.idle.clone())?;
        }
        let counter = stop.clone();
        let mut signals = Signals::new([SIGINT, SIGTERM])?;
        thread::spawn(move || signals.forever().for_each(|_| counter.request()));
        Ok(stop)
    }

    /// Does work that looks at [`Stop::requested`] by itself.
    pub fn with_care<T>(&self, work: impl FnOnce() -> T) -> T {
        self.idle.store(false, Ordering::SeqCst);
        let result = work();
        self.idle.store(true, Ordering::SeqCst);
        result
    }

    /// Asks once more.
    pub fn request(&self) {
        self.asked.fetch_add(1, Ordering::SeqCst);
    }

    /// Stop, and lose nothing.
    pub fn requested(&self) -> bool {
        self.asked.load(Ordering::SeqCst) > 0
    }

    /// Stop now.
    pub fn insisted(&self) -> bool {
        self.asked.load(Ordering::SeqCst) > 1
    }
}
