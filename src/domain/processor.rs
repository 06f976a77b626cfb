//! Time on processors, which other programs on the machine do not lengthen as they do the time on the wall.

use rustix::time::{ClockId, Timespec, clock_gettime};

use super::Ranks;

impl Ranks {
    /// What the processors have worked for all ranks since each began, in all their threads, s. Waiting for other ranks
    /// counts as far as MPI looks for messages meanwhile. All ranks must call this together.
    pub fn core_seconds(self) -> f64 {
        self.join(vec![own_seconds()]).iter().sum()
    }
}

/// s
fn own_seconds() -> f64 {
    let Timespec { tv_sec, tv_nsec } = clock_gettime(ClockId::ProcessCPUTime);
    tv_sec as f64 + 1e-9 * tv_nsec as f64
}
