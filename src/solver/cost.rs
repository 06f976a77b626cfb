//! Where the time goes.

use std::time::Instant;

/// What a run spends its time on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Mesh, neighbours and first forces; the source's INP.
    SetUp,
    /// Who computes what, at first and whenever some rank has had more to do than others; the source's GETMAP.
    Cut,
    /// Neighbour search; the source's ELIST.
    Neighbours,
    /// What ranks send each other in every step, and how long they wait; the source's EXCHANGE.
    Exchange,
    /// Forces; the source's FORCE and SOLV.
    Forces,
    /// Central differences; the source's CENTRAL.
    Motion,
    /// Bound of the highest frequency.
    Stability,
    /// Probes, snapshots and checkpoints; the source's OUT.
    Output,
    /// Finer meshes, and looks whether there must be one.
    Refinement,
}

impl Phase {
    pub const ALL: [Self; 9] = [
        Self::SetUp,
        Self::Cut,
        Self::Neighbours,
        Self::Exchange,
        Self::Forces,
        Self::Motion,
        Self::Stability,
        Self::Output,
        Self::Refinement,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Self::SetUp => "set-up",
            Self::Cut => "cut",
            Self::Neighbours => "neighbours",
            Self::Exchange => "exchange",
            Self::Forces => "forces",
            Self::Motion => "motion",
            Self::Stability => "stability",
            Self::Output => "output",
            Self::Refinement => "refinement",
        }
    }
}

/// Calls and seconds of every phase, on the wall, and what the processors worked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cost {
    /// Of all ranks and threads, when it was last told, s.
    pub core_seconds: f64,
    spent: [(u64, f64); Phase::ALL.len()],
}

impl Cost {
    /// Books the time since `start`, which becomes now.
    pub fn book(&mut self, phase: Phase, start: &mut Instant) {
        let now = Instant::now();
        self.add(phase, 1, (now - *start).as_secs_f64());
        *start = now;
    }

    /// Takes calls, with their seconds, out of the time of one phase and books them as another.
    pub fn rebook(&mut self, from: Phase, to: Phase, (calls, seconds): (u64, f64)) {
        self.add(from, 0, -seconds);
        self.add(to, calls, seconds);
    }

    fn add(&mut self, phase: Phase, calls: u64, seconds: f64) {
        let (sum_calls, sum_seconds) = &mut self.spent[phase as usize];
        *sum_calls += calls;
        *sum_seconds += seconds;
    }

    pub fn seconds(&self, phase: Phase) -> f64 {
        self.spent[phase as usize].1
    }

    /// Phase, calls, seconds.
    pub fn rows(&self) -> impl Iterator<Item = (Phase, u64, f64)> + '_ {
        Phase::ALL.into_iter().map(|phase| {
            let (calls, seconds) = self.spent[phase as usize];
            (phase, calls, seconds)
        })
    }
}
