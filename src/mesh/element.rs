//! Elements: single atoms and triangles of any size, and how their nodes carry their sites.

use crate::lattice::triangular;

/// A triangle of lattice sites with its nodes at the three corner sites, or a single atom that is its own node.
///
/// Local coordinates (p, q) of a site (i, j) are p = sign (i - column), q = sign (j - row), so that the sites are
/// p, q >= 0, p + q < size for both orientations. [Deng2011] Fig. 3-6.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Element {
    /// Sites along an edge; 1 is the atom.
    pub size: i32,
    /// 1: upright, anchored at its lower left corner; -1: inverted, anchored at its upper right corner.
    pub sign: i32,
    pub column: i32,
    pub row: i32,
}

impl Element {
    pub fn atom([column, row]: [i32; 2]) -> Self {
        Self {
            size: 1,
            sign: 1,
            column,
            row,
        }
    }

    pub fn is_atom(&self) -> bool {
        self.size == 1
    }

    /// 1 for the atom, 3 for the triangle.
    pub fn node_count(&self) -> usize {
        if self.is_atom() { 1 } else { 3 }
    }

    pub fn site_count(&self) -> usize {
        (self.size * (self.size + 1) / 2) as usize
    }

    /// Local coordinates of a lattice site.
    #[inline(always)]
    pub fn local(&self, [i, j]: [i32; 2]) -> [i32; 2] {
        [self.sign * (i - self.column), self.sign * (j - self.row)]
    }

    /// The lattice site at local coordinates.
    #[inline(always)]
    pub fn site(&self, [p, q]: [i32; 2]) -> [i32; 2] {
        [self.column + self.sign * p, self.row + self.sign * q]
    }

    pub fn contains(&self, site: [i32; 2]) -> bool {
        let [p, q] = self.local(site);
        p >= 0 && q >= 0 && p + q < self.size
    }

    /// Local coordinates of all sites, row by row.
    pub fn locals(&self) -> impl Iterator<Item = [i32; 2]> + use<> {
        let size = self.size;
        (0..size).flat_map(move |q| (0..size - q).map(move |p| [p, q]))
    }

    /// All sites, in the order of [`Self::locals`].
    pub fn sites(&self) -> impl Iterator<Item = [i32; 2]> + use<> {
        let element = *self;
        element.locals().map(move |local| element.site(local))
    }

    /// The sites that are nodes, in node order.
    pub fn corners(&self) -> impl ExactSizeIterator<Item = [i32; 2]> + Clone + use<> {
        let last = self.size - 1;
        let corners = [[0, 0], [last, 0], [0, last]].map(|local| self.site(local));
        corners.into_iter().take(self.node_count())
    }

    /// Mean of the corners, in units of the lattice spacing.
    pub fn centre(&self) -> [f64; 2] {
        let corners = self.corners();
        let number = corners.len() as f64;
        let sum = corners
            .map(triangular::position)
            .fold([0.0; 2], |sum, place| [sum[0] + place[0], sum[1] + place[1]]);
        sum.map(|total| total / number)
    }

    /// Its lattice rows: the leftmost site of each, and how many there are.
    pub fn rows(&self) -> impl Iterator<Item = ([i32; 2], i32)> + use<> {
        let element = *self;
        (0..self.size).map(move |q| {
            let count = element.size - q;
            let leftmost = if element.sign > 0 { 0 } else { count - 1 };
            (element.site([leftmost, q]), count)
        })
    }

    /// Shape functions N_i at local coordinates: area coordinates, [Deng2011] Eq. (3-27) on Fig. 3-6.
    #[inline(always)]
    pub fn shape_functions(&self, local: [i32; 2]) -> [f64; 3] {
        self.shape_functions_between_sites(local.map(f64::from))
    }

    /// The same at any place.
    #[inline(always)]
    pub fn shape_functions_between_sites(&self, [p, q]: [f64; 2]) -> [f64; 3] {
        if self.is_atom() {
            return [1.0, 0.0, 0.0];
        }
        let edge = f64::from(self.size - 1);
        let [second, third] = [p / edge, q / edge];
        [1.0 - second - third, second, third]
    }

    /// Lumped mass of each node in site masses, M_i = m sum_a N_i(a): [Deng2011] Eq. (3-29).
    pub fn lumped_mass(&self) -> f64 {
        self.site_count() as f64 / self.node_count() as f64
    }

    /// What the consistent mass matrix couples two nodes by, over the lumped mass of one: m sum_a N_i(a) N_j(a) for
    /// i != j, over m sum_a N_i(a). Its rows sum to the lumped mass, [Deng2011] Eq. (3-29).
    pub fn mass_coupling(&self) -> f64 {
        if self.is_atom() {
            return 0.0;
        }
        let products = self.locals().map(|local| {
            let [first, second, _] = self.shape_functions(local);
            first * second
        });
        products.sum::<f64>() / self.lumped_mass()
    }

    /// Lowest row of the element.
    pub fn lowest_row(&self) -> i32 {
        if self.sign > 0 {
            self.row
        } else {
            self.row - self.size + 1
        }
    }

    /// Leftmost column of the lowest row.
    pub fn lowest_column(&self) -> i32 {
        self.column
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_55_site_triangle_has_mass_55_thirds_a_node_in_either_orientation() {
        // [Deng2011] Eq. (3-29): the lumped mass is the sum of the shape functions over the sites.
        for sign in [1, -1] {
            let element = Element {
                size: 10,
                sign,
                column: 3,
                row: -2,
            };
            let mut mass = [0.0; 3];
            for local in element.locals() {
                let shape = element.shape_functions(local);
                assert!((shape.iter().sum::<f64>() - 1.0).abs() < 1e-15);
                (0..3).for_each(|k| mass[k] += shape[k]);
            }
            assert_eq!(element.sites().count(), 55);
            mass.iter().for_each(|m| assert!((m - 55.0 / 3.0).abs() < 1e-12));
            assert_eq!(element.lumped_mass(), 55.0 / 3.0);
        }
    }

    #[test]
    fn shape_functions_interpolate_lattice_positions() {
        // [Deng2011] Eq. (3-27) and [Deng2011] Fig. 3-6: x_a = sum_i N_i(a) X_i reproduces any affine field.
        let element = Element {
            size: 7,
            sign: -1,
            column: 5,
            row: 9,
        };
        let corners: Vec<[i32; 2]> = element.corners().collect();
        for local in element.locals() {
            let shape = element.shape_functions(local);
            let site = element.site(local);
            for axis in 0..2 {
                let found: f64 = (0..3).map(|k| shape[k] * f64::from(corners[k][axis])).sum();
                assert!((found - f64::from(site[axis])).abs() < 1e-12);
            }
            assert!(element.contains(site));
        }
    }

    #[test]
    fn rows_hold_every_site_once() {
        for sign in [1, -1] {
            let element = Element {
                size: 6,
                sign,
                column: -2,
                row: 4,
            };
            let in_rows = element
                .rows()
                .flat_map(|([column, row], count)| (column..column + count).map(move |i| [i, row]));
            let mut in_rows: Vec<[i32; 2]> = in_rows.collect();
            let mut sites: Vec<[i32; 2]> = element.sites().collect();
            in_rows.sort_unstable();
            sites.sort_unstable();
            assert_eq!(in_rows, sites);
        }
    }
}
