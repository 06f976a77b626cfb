//! A test by the lengths of nearest-neighbour bonds alone: while all of them are moderate, only listed bonds are within
//! the cutoff.

use pulp::Simd;

use super::affine::smallest_stretch;
use crate::lanes::{Lanes, Mask};
use crate::lattice::triangular;

/// Squared lengths between which a nearest-neighbour bond counts as that of a regular lattice, nm^2.
///
/// If no nearest-neighbour bond of a region is shorter or longer, none of its lattice triangles shrinks any vector by
/// more than some factor s: the smallest eigenvalue of a metric is concave in the squares of the three edges, so that it
/// is least at a corner of their ranges. The lattice is then carried by a map, continuous and affine on every lattice
/// triangle, that takes no path to one shorter than s times it, and sites that are X apart in the perfect lattice are at
/// least s X apart unless the straight line between them leaves the region. Nor is that line shorter than s times the
/// distance of one of them from the edge of the region, a polygon through sites, in the perfect lattice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regular {
    least: f64,
    most: f64,
}

impl Regular {
    /// In spacings.
    pub const LEAST: f64 = 0.94;
    const MOST: f64 = 1.1;

    /// `unlisted` in spacings, lengths in nm. `None` where the cutoff leaves no room for it.
    pub fn new(unlisted: f64, cutoff: f64, spacing: f64) -> Option<Self> {
        // A bond as long as the cutoff is broken.
        let most = Self::MOST.min(cutoff / spacing);
        // A little less than what is needed, so that rounding does not matter.
        let stretch = 0.999 * smallest_stretch_of_triangles([Self::LEAST, most]);
        // The edge of a region whose sites are all at least `unlisted` away passes half a spacing beside one.
        let edge = (unlisted * unlisted - 0.25).sqrt();
        let keeps_apart = stretch * edge * spacing >= cutoff;
        keeps_apart.then_some(Self {
            least: (Self::LEAST * spacing).powi(2),
            most: (most * spacing).powi(2),
        })
    }

    /// The ends of the range as lengths, nm.
    pub fn lengths(&self) -> [f64; 2] {
        [self.least.sqrt(), self.most.sqrt()]
    }

    /// Whether the squared length of a bond is in the range; no for what is no number.
    pub fn holds_for(&self, squared: f64) -> bool {
        squared > self.least && squared < self.most
    }

    /// Whether the squared lengths of bonds, from `least` to `most`, are in the range; no for what is no number.
    #[inline(always)]
    pub fn holds<L: Simd>(&self, least: Lanes<L>, most: Lanes<L>) -> Mask<L> {
        least.is_above(self.least).and(most.is_below(self.most))
    }
}

/// Smallest factor by which a lattice triangle with edges in a range (in spacings) stretches any vector.
fn smallest_stretch_of_triangles(range: [f64; 2]) -> f64 {
    let edges = |corner: usize| [0, 1, 2].map(|edge| range[corner >> edge & 1]);
    let stretch = |[base, left, right]: [f64; 3]| {
        // The apex over the base, and from it the gradient of the map from the unit triangle.
        let foot = (base * base + left * left - right * right) / (2.0 * base);
        let height = (left * left - foot * foot).max(0.0).sqrt();
        let across = [foot - 0.5 * base, height].map(|component| component / triangular::ROW_HEIGHT);
        smallest_stretch([[base, 0.0], across])
    };
    (0..8).map(edges).map(stretch).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_with_moderate_edges_shrink_no_vector_much() {
        // The isosceles triangle with two short edges and a long base is lower than the perfect one.
        let found = smallest_stretch_of_triangles([0.9, 1.1]);
        let height = (0.9f64.powi(2) - 0.55f64.powi(2)).sqrt();
        assert!((found - height / triangular::ROW_HEIGHT).abs() < 1e-12);
        let inside = smallest_stretch_of_triangles([0.95, 1.05]);
        assert!(found < inside && inside < 1.0);
    }

    #[test]
    fn cutoffs_just_short_of_what_is_listed_leave_no_room() {
        assert!(Regular::new(3f64.sqrt(), 1.33, 1.0).is_some());
        assert!(Regular::new(3f64.sqrt(), 1.70, 1.0).is_none());
    }
}
