//! Equal bins along the crack plane.

/// Bins side by side from the left edge of the specimen.
#[derive(Clone, Debug, PartialEq)]
pub struct Bins {
    pub count: usize,
    /// nm
    pub width: f64,
}

impl Bins {
    /// As many bins of at least this width as fit along a length, and no fewer than one, nm.
    pub fn no_narrower_than(least: f64, length: f64) -> Self {
        let count = (length / least).floor().max(1.0) as usize;
        let width = length / count as f64;
        Self { count, width }
    }

    /// nm from the left edge
    pub fn centres(&self) -> Vec<f64> {
        (0..self.count).map(|bin| (bin as f64 + 0.5) * self.width).collect()
    }

    /// The bin of a place, nm from the left edge; what lies beyond an end belongs to the last bin there.
    pub fn at(&self, x: f64) -> usize {
        ((x / self.width).max(0.0) as usize).min(self.count - 1)
    }

    /// The bins on which something falls that stands for a length no longer than a bin around a place, nm, and its share
    /// in each; the same bin twice where it lies within one.
    ///
    /// What stands in a row, each for the distance to the next, then fills every bin alike, however the bins fall on it.
    pub fn spread(&self, x: f64, length: f64) -> [(u32, f64); 2] {
        let first = self.at(x - 0.5 * length);
        let rest = self.at(x + 0.5 * length);
        let border = rest as f64 * self.width;
        let beyond = if rest > first { (x - border) / length + 0.5 } else { 0.0 };
        [(first as u32, 1.0 - beyond), (rest as u32, beyond)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of sums of a few shares.
    const ROUNDING: f64 = 1e-12;

    #[test]
    fn a_row_fills_every_bin_alike_however_the_bins_fall_on_it() {
        for length in [20.04, 21.0, 22.6, 23.99] {
            for offset in [0.0, 0.25, 0.5] {
                let bins = Bins::no_narrower_than(2.0, length);
                let mut sums = vec![0.0; bins.count];
                for place in -1..26 {
                    let shares = bins.spread(f64::from(place) + offset, 1.0);
                    shares.into_iter().for_each(|(bin, share)| sums[bin as usize] += share);
                }
                for sum in &sums[1..bins.count - 1] {
                    assert!((sum - bins.width).abs() < ROUNDING, "{length} {offset}: {sums:?}");
                }
            }
        }
    }

    #[test]
    fn what_reaches_beyond_an_end_counts_there_as_a_whole() {
        let bins = Bins::no_narrower_than(2.0, 10.0);
        let shares = |x: f64| bins.spread(x, 1.0);
        assert_eq!([shares(0.1), shares(9.9)], [[(0, 1.0), (0, 0.0)], [(4, 1.0), (4, 0.0)]]);
        assert_eq!(shares(4.25), [(1, 0.25), (2, 0.75)]);
        assert_eq!(shares(-3.0), [(0, 1.0), (0, 0.0)]);
    }
}
