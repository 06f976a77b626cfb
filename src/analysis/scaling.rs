//! What more processors gain: time by the steps of the source's program, speedup and efficiency.

mod model;

pub use model::predicted;

/// Where the time of a run went, by the steps of the source, s. `[Deng2011] Table 4-2`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Times {
    pub ranks: u32,
    /// Number of time steps, N.
    pub steps: f64,
    /// INP: everything before the first step.
    pub input: f64,
    /// GETM: cutting the specimen; `None` where it is not known apart from the input.
    pub map: Option<f64>,
    /// ELIST: search for neighbours.
    pub lists: f64,
    /// EXC: what ranks send each other, a step.
    pub exchange: f64,
    /// SOLV: a whole step, the exchange in it.
    pub solve: f64,
    /// OUT
    pub output: f64,
}

/// A run on one processor, of the specimen that one processor has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneProcessor {
    /// s
    pub total: f64,
    /// γ, the share of the total that more processors do not shorten.
    pub serial_share: f64,
}

impl Times {
    /// T_total. `[Deng2011] Eq. (4-1)`
    pub fn total(&self) -> f64 {
        self.serial() + self.lists + self.steps * self.solve
    }

    /// What every processor does for itself, or one for all.
    fn serial(&self) -> f64 {
        self.input + self.map.unwrap_or(0.0) + self.output
    }

    /// A step without what ranks tell each other; one processor has nobody to talk to, and all that it takes is its step.
    fn solve_alone(&self) -> f64 {
        match self.ranks {
            1 => self.solve,
            _ => self.solve - self.exchange,
        }
    }

    /// The run on one processor that follows if processors did their part without loss: exact where this is a run on
    /// one. `growth` is how many times larger the specimen is than that of one processor.
    ///
    /// γ is that of `[Deng2011] Eq. (4-2)`, where T_PUT is printed for T_OUT.
    pub fn on_one(&self, growth: f64) -> OneProcessor {
        let apart = self.lists + self.steps * self.solve_alone();
        let serial = self.serial() / growth;
        let total = serial + f64::from(self.ranks) * apart / growth;
        OneProcessor {
            total,
            serial_share: serial / total,
        }
    }

    /// S(P) = T(1) / T(P), T(1) that of a specimen as large as this one. `[Deng2011] Eq. (4-3)`
    pub fn speedup(&self, one: &OneProcessor, growth: f64) -> f64 {
        growth * one.total / self.total()
    }

    /// E(P) = S(P) / P. `[Deng2011] Eq. (4-4)`
    pub fn efficiency(&self, one: &OneProcessor, growth: f64) -> f64 {
        self.speedup(one, growth) / f64::from(self.ranks)
    }
}

impl OneProcessor {
    /// Amdahl's law: the speedup of so many processors that lose nothing to each other.
    ///
    /// `[Deng2011] Eq. (4-3)` prints γ − (1 − γ)/P below the line. That is negative for any program worth running in
    /// parallel, and not 1 for P = 1; the sum is meant.
    pub fn ideal_speedup(&self, ranks: u32) -> f64 {
        1.0 / (self.serial_share + (1.0 - self.serial_share) / f64::from(ranks))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of sums of a few numbers.
    const ROUNDING: f64 = 1e-12;

    fn row(ranks: u32, [input, map, lists, exchange, solve, output]: [f64; 6]) -> Times {
        Times {
            ranks,
            steps: 1000.0,
            input,
            map: Some(map),
            lists,
            exchange,
            solve,
            output,
        }
    }

    /// First and last row of `[Deng2011] Table 4-2` (fixed size) and `[Deng2011] Table 4-3` (scaled size).
    fn source() -> [[Times; 2]; 2] {
        let fixed = [
            row(4, [2.428, 0.179, 362.16, 0.002, 1.647, 2.488]),
            row(64, [2.510, 0.05, 20.071, 0.006, 0.110, 2.489]),
        ];
        let scaled = [
            row(4, [1.226, 0.04, 163.130, 0.002, 0.814, 1.247]),
            row(64, [19.009, 0.05, 193.587, 0.006, 1.076, 19.684]),
        ];
        [fixed, scaled]
    }

    #[test]
    fn the_total_is_the_sum_of_the_steps_with_n_times_the_solution() {
        // [Deng2011] Eq. (4-1)
        let [[four, _], _] = source();
        assert!((four.total() - (2.428 + 0.179 + 362.16 + 1647.0 + 2.488)).abs() < ROUNDING * 2015.0);
    }

    #[test]
    fn the_serial_share_is_input_cut_and_output_over_the_total_of_one_processor() {
        // [Deng2011] Eq. (4-2)
        let alone = row(1, [2.0, 1.0, 90.0, 0.0, 0.9, 7.0]);
        let one = alone.on_one(1.0);
        assert_eq!([one.total, one.serial_share], [1000.0, 0.01]);
    }

    #[test]
    fn the_ideal_speedup_is_amdahls_and_the_printed_sign_is_not() {
        // [Deng2011] Eq. (4-3)
        let one = OneProcessor {
            total: 100.0,
            serial_share: 0.1,
        };
        let amdahl = [(1, 1.0), (9, 5.0), (u32::MAX, 10.0)];
        for (ranks, speedup) in amdahl {
            assert!((one.ideal_speedup(ranks) - speedup).abs() < 1e-6, "{ranks}");
        }
        let printed = |ranks: f64| 1.0 / (0.1 - 0.9 / ranks);
        assert!(printed(1.0) < 0.0 && printed(8.0) < 0.0);
    }

    #[test]
    fn efficiency_is_speedup_over_processors_and_one_for_one() {
        // [Deng2011] Eq. (4-4)
        let one = row(1, [2.0, 0.0, 90.0, 0.0, 0.9, 7.0]);
        let (alone, two) = (one.on_one(1.0), row(2, [2.0, 0.0, 45.0, 0.0, 0.45, 7.0]));
        assert_eq!(one.efficiency(&alone, 1.0), 1.0);
        assert!((two.speedup(&alone, 1.0) - 999.0 / 504.0).abs() < ROUNDING);
        assert!((two.efficiency(&alone, 1.0) - 999.0 / 1008.0).abs() < ROUNDING);
        assert!(
            (two.speedup(&alone, 1.0) - alone.ideal_speedup(2)).abs() < ROUNDING,
            "nothing is lost"
        );
    }

    #[test]
    fn the_rows_of_the_source_give_the_curves_that_it_describes() {
        // [Deng2011] Table 4-2 and [Deng2011] Table 4-3: close to 1 up to 8 processors, then falling, the scaled one lower.
        let [fixed, scaled] = source();
        let fixed = fixed[1].efficiency(&fixed[0].on_one(1.0), 1.0);
        let scaled = scaled[1].efficiency(&scaled[0].on_one(4.0), 64.0);
        assert!((0.92..0.94).contains(&fixed), "{fixed}");
        assert!((0.74..0.76).contains(&scaled), "{scaled}");
    }
}
