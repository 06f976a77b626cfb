//! A crack cut on purpose: bonds across it are severed for good, and its faces only push.

mod ends;

pub use ends::{NotchEnd, WantedEnd};

use super::Mesh;
use crate::lattice::triangular;

/// A crack from the left edge as it is wanted, in units of the lattice spacing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crack {
    pub length: f64,
    /// Where among the elements it is to end; `None`: at this length.
    pub end: Option<WantedEnd>,
}

/// A straight cut between two lattice rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// The cut runs between lattice rows `row - 1` and `row`.
    pub row: i32,
    /// It reaches from `from` to `to` in lattice x, in units of the lattice spacing.
    pub from: f64,
    pub to: f64,
}

impl Crack {
    /// A crack that ends where its length says.
    pub fn of_length(length: f64) -> Self {
        Self { length, end: None }
    }

    /// The cut in a mesh that has none yet.
    pub(super) fn cut(self, mesh: &Mesh) -> Cut {
        let left = mesh.sites.left();
        let to = left + self.length;
        Cut {
            row: mesh.sites.middle_row(),
            from: left - 1.0,
            to: self.end.map_or(to, |end| end.nearest(mesh, to)),
        }
    }
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

    /// Where it ends among the elements of its mesh.
    pub fn end(&self, mesh: &Mesh) -> NotchEnd {
        ends::judge(mesh, self.to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pair_is_severed_where_its_line_crosses_the_cut_and_only_there() {
        let cut = Cut {
            row: 10,
            from: -10.0,
            to: 20.0,
        };
        assert!(cut.severs([0, 9], [0, 10]));
        assert!(cut.severs([0, 10], [0, 9]), "in either order");
        assert!(!cut.severs([0, 9], [1, 9]) && !cut.severs([3, 10], [3, 11]));
        assert!(!cut.severs([16, 9], [16, 10]), "ahead of the tip");
        assert!(cut.severs([14, 8], [13, 11]), "through the cut between far rows");
    }
}
