//! The set of lattice sites of a specimen, the same whatever the resolution.

use std::ops::Range;

use crate::lattice::triangular;

/// How many blocks a specimen has: element rows of `block` lattice rows, an odd number of triangles in each.
///
/// Rows start in turn with an upright triangle, and are widest at their bottom, or with an inverted one, and are widest at
/// their top; two rows further the sides stand where they stood. Counted from the middle: the row above it starts upright,
/// the row below inverted, so that the faces stick out where a crack through the middle meets them and have no re-entrant
/// corner there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Sites along an edge of the triangles that lay out the set.
    pub block: i32,
    /// Element rows R.
    pub rows: i32,
    /// Triangles a row C, odd.
    pub triangles: i32,
}

impl Layout {
    /// The layout nearest to a wanted size, lengths in units of the lattice spacing: R is the integer nearest to
    /// height / (block sqrt(3)/2), C the odd integer for which (C + 1)(block + 1)/2 is nearest to the length.
    pub fn nearest(length: f64, height: f64, block: i32) -> Self {
        let rows = (height / (f64::from(block) * triangular::ROW_HEIGHT)).round() as i32;
        let cells = (length / f64::from(block + 1)).round() as i32;
        Self {
            block,
            rows,
            triangles: 2 * cells - 1,
        }
    }

    pub fn lattice_rows(&self) -> i32 {
        self.rows * self.block
    }

    /// Number of sites: that of R x C triangles.
    pub fn site_count(&self) -> u64 {
        let triangle = self.block as u64 * (self.block as u64 + 1) / 2;
        self.rows as u64 * self.triangles as u64 * triangle
    }

    /// Length along x in lattice spacings, (C + 1)(block + 1)/2.
    pub fn length(&self) -> f64 {
        f64::from((self.triangles + 1) / 2 * (self.block + 1))
    }

    /// Element rows below the middle.
    pub fn rows_below(&self) -> i32 {
        self.rows / 2
    }

    /// Whether an element row starts with an upright triangle.
    pub fn starts_upright(&self, row: i32) -> bool {
        (row - self.rows_below()) % 2 == 0
    }

    /// Column at which the upright triangles of element row `row` are anchored.
    pub fn anchor(&self, row: i32) -> i32 {
        -self.block * (row + self.rows_below() % 2).div_euclid(2)
    }

    /// First column and number of sites of a lattice row.
    fn extent(&self, lattice_row: i32) -> (i32, i32) {
        let [row, q] = [lattice_row.div_euclid(self.block), lattice_row.rem_euclid(self.block)];
        let cells = (self.triangles - 1) / 2;
        let full = cells * (self.block + 1);
        if self.starts_upright(row) {
            (self.anchor(row), full + self.block - q)
        } else {
            (self.anchor(row) - (q + 1), full + q + 1)
        }
    }
}

/// Sites numbered row by row from the lower left.
#[derive(Clone, Debug, PartialEq)]
pub struct SiteSet {
    pub layout: Layout,
    /// First column of every lattice row.
    first: Vec<i32>,
    /// Number of the first site of every lattice row, and the total at the end.
    start: Vec<usize>,
}

impl SiteSet {
    pub fn new(layout: Layout) -> Self {
        let mut first = Vec::with_capacity(layout.lattice_rows() as usize);
        let mut start = vec![0];
        for row in 0..layout.lattice_rows() {
            let (column, count) = layout.extent(row);
            first.push(column);
            start.push(start[row as usize] + count as usize);
        }
        Self { layout, first, start }
    }

    pub fn len(&self) -> usize {
        *self.start.last().expect("the total stands at the end")
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub fn rows(&self) -> i32 {
        self.first.len() as i32
    }

    /// Columns of a lattice row.
    pub fn columns(&self, row: i32) -> Range<i32> {
        let k = row as usize;
        self.first[k]..self.first[k] + (self.start[k + 1] - self.start[k]) as i32
    }

    /// Numbers of the sites of a lattice row.
    pub fn numbers(&self, row: i32) -> Range<usize> {
        self.start[row as usize]..self.start[row as usize + 1]
    }

    /// Number of a site; `None` if the specimen does not hold it.
    #[inline(always)]
    pub fn index(&self, [column, row]: [i32; 2]) -> Option<usize> {
        if row < 0 || row >= self.rows() {
            return None;
        }
        let k = row as usize;
        let offset = column - self.first[k];
        (offset >= 0 && (offset as usize) < self.start[k + 1] - self.start[k]).then(|| self.start[k] + offset as usize)
    }

    /// Numbers of so many sites of a row from this one on; `None` if the specimen does not hold them all.
    #[inline(always)]
    pub fn run(&self, leftmost: [i32; 2], count: i32) -> Option<Range<usize>> {
        let [column, row] = leftmost;
        let first = self.index(leftmost)?;
        let last = self.index([column + count - 1, row])?;
        Some(first..last + 1)
    }

    /// All sites in the order of their numbers.
    pub fn iter(&self) -> impl Iterator<Item = [i32; 2]> + '_ {
        (0..self.rows()).flat_map(|row| self.columns(row).map(move |column| [column, row]))
    }

    /// Lattice x of the specimen's left edge in spacings: the leftmost site.
    pub fn left(&self) -> f64 {
        let starts = (0..self.rows()).map(|row| triangular::position([self.columns(row).start, row])[0]);
        starts.fold(f64::INFINITY, f64::min)
    }

    /// Lattice x of the right edge: the rightmost site. It is that of the left edge after half a turn where the rows are even
    /// in number, while the length of the layout counts what the teeth of both sides leave out.
    pub fn right(&self) -> f64 {
        let ends = (0..self.rows()).map(|row| triangular::position([self.columns(row).end - 1, row])[0]);
        ends.fold(f64::NEG_INFINITY, f64::max)
    }

    /// How far from the left edge the last bond across the middle is, in spacings: where the row above it ends and the one
    /// below it, which is half a spacing shorter, do.
    pub fn last_bond(&self) -> f64 {
        let middle = self.middle_row();
        let ends = [middle - 1, middle].map(|row| triangular::position([self.columns(row).end - 1, row])[0]);
        0.5 * (ends[0] + ends[1]) - self.left()
    }

    /// How far from the left edge the first one is. From the right edge the last is as far.
    pub fn first_bond(&self) -> f64 {
        let middle = self.middle_row();
        let starts = [middle - 1, middle].map(|row| triangular::position([self.columns(row).start, row])[0]);
        0.5 * (starts[0] + starts[1]) - self.left()
    }

    /// The boundary between lattice rows at which a crack through the middle is cut: a boundary of element rows,
    /// and where their number is odd the one just below the middle.
    pub fn middle_row(&self) -> i32 {
        self.layout.rows_below() * self.layout.block
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_specimen_has_as_many_sites_as_its_triangles_and_straight_sides() {
        let layout = Layout {
            block: 10,
            rows: 6,
            triangles: 9,
        };
        let sites = SiteSet::new(layout);
        assert_eq!(sites.len() as u64, layout.site_count());
        assert_eq!(sites.iter().count(), sites.len());
        for (number, site) in sites.iter().enumerate() {
            assert_eq!(sites.index(site), Some(number));
        }
        for row in 0..2 {
            let [x_low, x_high] = [row, row + 20].map(|r| triangular::position([sites.columns(r).start, r])[0]);
            assert_eq!(
                x_low, x_high,
                "two element rows further the sides stand where they stood"
            );
        }
        assert_eq!(sites.index([sites.columns(5).end, 5]), None);
        assert_eq!(sites.index([0, 60]), None);
    }

    /// Lattice x of both ends of a lattice row.
    fn ends(sites: &SiteSet, row: i32) -> [f64; 2] {
        let columns = sites.columns(row);
        [columns.start, columns.end - 1].map(|column| triangular::position([column, row])[0])
    }

    #[test]
    fn no_face_has_a_re_entrant_corner_on_the_crack_plane() {
        for (rows, block) in (4..=20).flat_map(|rows| [4, 5, 10].map(|block| (rows, block))) {
            let sites = SiteSet::new(Layout {
                block,
                rows,
                triangles: 9,
            });
            let middle = sites.middle_row();
            for nearest in [middle - 1, middle] {
                let outward = if nearest < middle { -1 } else { 1 };
                let [near, far] = [nearest, nearest + outward].map(|row| ends(&sites, row));
                assert!(
                    near[0] < far[0] && near[1] > far[1],
                    "{rows} rows of {block}: the rows beside the plane reach farthest out"
                );
            }
        }
    }

    #[test]
    fn specimens_with_an_even_number_of_rows_below_the_plane_stay_what_they_were() {
        // The first row of models A to E, of cases 1 and 2 and of the slab of the tests starts upright at column 0.
        for rows in [160, 320, 140, 16] {
            let layout = Layout {
                block: 10,
                rows,
                triangles: 9,
            };
            let expected = |row: i32| {
                if row % 2 == 0 {
                    (-10 * (row / 2), 54)
                } else {
                    (-10 * (row / 2) - 1, 45)
                }
            };
            for row in 0..rows {
                assert_eq!(layout.extent(10 * row), expected(row), "{rows} rows, row {row}");
            }
        }
    }
}
