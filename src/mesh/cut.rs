//! A crack cut on purpose: bonds across it are severed for good, and its faces only push.

use crate::lattice::triangular;

/// A straight cut between two lattice rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// The cut runs between lattice rows `row - 1` and `row`.
    pub row: i32,
    /// It reaches from `from` to `to` in lattice x, in units of the lattice spacing.
    pub from: f64,
    pub to: f64,
}

impl Cut {
    /// Whether the straight line between two reference sites crosses the cut. Such a pair never bonds.
    #[inline(always)]
    pub fn severs(&self, a: [i32; 2], b: [i32; 2]) -> bool {
        if (a[1] < self.row) == (b[1] < self.row) {
            return false;
        }
        let height = f64::from(self.row) - 0.5;
        let [xa, xb] = [a, b].map(|site| triangular::position(site)[0]);
        let share = (height - f64::from(a[1])) / f64::from(b[1] - a[1]);
        let x = xa + share * (xb - xa);
        self.from <= x && x < self.to
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pair_is_severed_where_its_line_crosses_the_cut_and_only_there() {
        let cut = Cut { row: 10, from: -10.0, to: 20.0 };
        assert!(cut.severs([0, 9], [0, 10]));
        assert!(cut.severs([0, 10], [0, 9]), "in either order");
        assert!(!cut.severs([0, 9], [1, 9]) && !cut.severs([3, 10], [3, 11]));
        assert!(!cut.severs([16, 9], [16, 10]), "ahead of the tip");
        assert!(cut.severs([14, 8], [13, 11]), "through the cut between far rows");
    }
}
