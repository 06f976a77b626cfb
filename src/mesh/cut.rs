//! A crack cut on purpose: bonds across it are severed for good, and its faces only push.
//!
//! A bond is severed where its line crosses the plane between the ends of the cut. One that crosses it exactly at an end is
//! whole, at either end.

mod ends;

pub use ends::{NotchEnd, WantedEnd};

use super::Mesh;
use crate::lattice::triangular;

/// Where a notch lies along the crack plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Side {
    /// It begins at the left edge, or at the right edge.
    Left,
    Right,
    /// It reaches neither edge.
    Inside {
        /// Its middle, from the left edge.
        center: f64,
    },
}

/// A crack as it is wanted, in units of the lattice spacing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crack {
    pub side: Side,
    /// From end to end.
    pub length: f64,
    /// Where among the elements it is to end; `None`: at this length.
    pub end: Option<WantedEnd>,
}

/// A straight cut between two lattice rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// The cut runs between lattice rows `row - 1` and `row`.
    pub row: i32,
    /// It reaches from `from` to `to` in lattice x, in units of the lattice spacing. What it severs lies between them, and
    /// where it begins at an edge it reaches beyond.
    pub from: f64,
    pub to: f64,
}

/// How far beyond its edge a cut begins, spacings.
const BEYOND: f64 = 1.0;

impl Crack {
    /// A crack from the left edge that ends where its length says.
    pub fn of_length(length: f64) -> Self {
        Self {
            side: Side::Left,
            length,
            end: None,
        }
    }

    /// The cut in a mesh that has none yet.
    pub(super) fn cut(self, mesh: &Mesh) -> Cut {
        let [left, right] = [mesh.sites.left(), mesh.sites.right()];
        let end = |wanted: f64| self.end.map_or(wanted, |end| end.nearest(mesh, wanted));
        let (from, to) = match self.side {
            Side::Left => (left - BEYOND, end(left + self.length)),
            Side::Right => (end(right - self.length), right + BEYOND),
            Side::Inside { center } => {
                let middle = left + center;
                (end(middle - 0.5 * self.length), end(middle + 0.5 * self.length))
            }
        };
        Cut {
            row: mesh.sites.middle_row(),
            from,
            to,
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
        self.from < x && x < self.to
    }

    /// Where it lies in its mesh.
    pub fn side(&self, mesh: &Mesh) -> Side {
        let left = mesh.sites.left();
        if self.from < left {
            Side::Left
        } else if self.to > mesh.sites.right() {
            Side::Right
        } else {
            let center = 0.5 * (self.from + self.to) - left;
            Side::Inside { center }
        }
    }

    /// How long it is in its mesh, from end to end.
    pub fn length(&self, mesh: &Mesh) -> f64 {
        match self.side(mesh) {
            Side::Left => self.to - mesh.sites.left(),
            Side::Right => mesh.sites.right() - self.from,
            Side::Inside { .. } => self.to - self.from,
        }
    }

    /// Whether a place, lattice x in spacings, lies ahead of the tip that is followed: of a notch inside the right-hand one.
    pub fn is_ahead(&self, mesh: &Mesh, x: f64) -> bool {
        match self.side(mesh) {
            Side::Left | Side::Inside { .. } => x >= self.to,
            Side::Right => x <= self.from,
        }
    }

    /// Where that tip is among the elements of its mesh.
    pub fn end(&self, mesh: &Mesh) -> NotchEnd {
        match self.side(mesh) {
            Side::Left | Side::Inside { .. } => ends::judge(mesh, self.to, 1.0),
            Side::Right => ends::judge(mesh, self.from, -1.0),
        }
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
