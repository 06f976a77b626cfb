use std::time::Instant;

/// How fast a case goes, measured from the first progress it reports, so that a resumed case is not thought fast.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    start: Instant,
    /// Percent at the start of the measurement.
    from: f64,
}

impl Pace {
    pub fn starting_at(percent: f64) -> Pace {
        Pace {
            start: Instant::now(),
            from: percent,
        }
    }

    /// Seconds until the end; `None` before there is anything to judge by, and at the end. The time before the first gain
    /// does not count.
    pub fn seconds_left(&mut self, percent: f64) -> Option<f64> {
        if percent <= self.from {
            self.start = Instant::now();
        }
        remaining(self.start.elapsed().as_secs_f64(), percent - self.from, 100.0 - percent)
    }
}

fn remaining(elapsed: f64, gained: f64, missing: f64) -> Option<f64> {
    (gained > 0.0 && elapsed > 0.0 && missing > 0.0).then(|| elapsed * missing / gained)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_resumed_case_is_judged_by_what_it_gains() {
        assert_eq!(remaining(10.0, 5.0, 50.0), Some(100.0));
        assert_eq!(remaining(10.0, 0.0, 50.0), None);
        assert_eq!(remaining(10.0, 50.0, 0.0), None, "at the end nothing is left");
    }
}
