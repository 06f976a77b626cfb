/// Something that is due at equal intervals of simulated time, and once more at the end of a run.
///
/// The number taken so far decides what is due next, so that a restart goes on where the schedule was.
#[derive(Clone, Debug, PartialEq)]
pub struct Schedule {
    every: f64,
    taken: u64,
    /// Whether the present step has been served.
    served: bool,
}

impl Schedule {
    /// With the time between two, ps.
    pub fn new(every: f64) -> Self {
        Self {
            every,
            taken: 0,
            served: false,
        }
    }

    pub fn taken(&self) -> u64 {
        self.taken
    }

    /// Whether it is due at this time, within half a step.
    pub fn is_due(&self, time: f64, time_step: f64) -> bool {
        self.taken == 0 || time + 0.5 * time_step >= self.taken as f64 * self.every
    }

    /// Whether it is due; then it counts as taken. At the end of a run it is due unless the same moment has been served
    /// before.
    pub fn take(&mut self, time: f64, time_step: f64, at_end: bool) -> bool {
        if at_end && self.served {
            return false;
        }
        self.served = at_end || self.is_due(time, time_step);
        self.taken += u64::from(self.served);
        self.served
    }

    /// Goes back to a step between two calls.
    pub fn restore(&mut self, taken: u64, step: u64) {
        self.taken = taken;
        self.served = taken > 0 && step == 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_due_every_interval_and_once_at_the_end() {
        let mut schedule = Schedule::new(1.0);
        let due: Vec<bool> = (0..25).map(|k| schedule.take(f64::from(k) * 0.1, 0.1, false)).collect();
        let taken: Vec<usize> = (0..25).filter(|&k| due[k]).collect();
        assert_eq!(taken, [0, 10, 20]);
        assert!(schedule.take(2.4, 0.1, true));
        assert!(!schedule.take(2.4, 0.1, true), "never twice in one moment");
        assert_eq!(schedule.taken(), 4);
    }
}
