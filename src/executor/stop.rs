use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::iterator::Signals;

/// How often the user has asked to stop: once is a request, twice is an order.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<AtomicUsize>);

impl Stop {
    /// Counts Ctrl-C and SIGTERM of this process from now on.
    pub fn on_signals() -> io::Result<Stop> {
        let stop = Stop::default();
        let counter = stop.clone();
        let mut signals = Signals::new([SIGINT, SIGTERM])?;
        thread::spawn(move || signals.forever().for_each(|_| counter.request()));
        Ok(stop)
    }

    pub fn request(&self) {
        self.0.fetch_add(1, Ordering::SeqCst);
    }

    pub fn requested(&self) -> bool {
        self.0.load(Ordering::SeqCst) > 0
    }

    pub fn insisted(&self) -> bool {
        self.0.load(Ordering::SeqCst) > 1
    }
}
