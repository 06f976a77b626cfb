//! Elements of three dimensions: single atoms, and the parts of a rhombohedral block.
//!
//! A block of n^3 primitive cells is cut along two {111} planes into a tetrahedron, an octahedron and a tetrahedron. With
//! local coordinates (p, q, r) from its anchor and s = p + q + r, they hold s <= n - 2, n - 1 <= s <= 2n - 2 and the rest.
//! [Deng2011] Fig. 3-7 and Fig. 3-8; the two pyramids of the source share their four nodes and are one octahedron here.

use crate::mesh::grouped::MassCoupling;

/// What an element is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Shape {
    /// The tetrahedron at the anchor of its block.
    Low,
    Octahedron,
    /// The tetrahedron at the far corner of its block.
    High,
    Atom,
}

impl Shape {
    /// The three parts of a block.
    pub const OF_BLOCK: [Self; 3] = [Self::Low, Self::Octahedron, Self::High];

    pub fn node_count(self) -> usize {
        match self {
            Self::Low | Self::High => 4,
            Self::Octahedron => 6,
            Self::Atom => 1,
        }
    }
}

/// An element: its shape, and the block that it is a part of. An atom is a block of its own, of size 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Element {
    pub shape: Shape,
    /// Sites along an edge of the block.
    pub size: i32,
    /// The lattice site from which local coordinates are counted.
    pub anchor: [i32; 3],
}

impl Element {
    pub fn atom(site: [i32; 3]) -> Self {
        Self {
            shape: Shape::Atom,
            size: 1,
            anchor: site,
        }
    }

    /// A part of the block of so many sites an edge at the origin.
    pub fn in_block(shape: Shape, size: i32) -> Self {
        Self {
            shape,
            size,
            anchor: [0; 3],
        }
    }

    /// Local coordinates of the nodes, in node order: the tetrahedra's corners from the outer one on; of the octahedron +U, -U,
    /// +V, -V, +W, -W.
    pub fn corners(self) -> Vec<[i32; 3]> {
        let m = self.size - 1;
        match self.shape {
            Shape::Atom => vec![[0, 0, 0]],
            Shape::Low => vec![[0, 0, 0], [m - 1, 0, 0], [0, m - 1, 0], [0, 0, m - 1]],
            Shape::High => vec![[m, m, m], [1, m, m], [m, 1, m], [m, m, 1]],
            Shape::Octahedron => vec![[0, m, m], [m, 0, 0], [m, 0, m], [0, m, 0], [m, m, 0], [0, 0, m]],
        }
    }

    /// Whether a site of its block, by local coordinates, is one of its own.
    pub fn has_local(self, local: [i32; 3]) -> bool {
        let n = self.size;
        if local.iter().any(|component| !(0..n).contains(component)) {
            return false;
        }
        let layer: i32 = local.iter().sum();
        match self.shape {
            Shape::Atom => true,
            Shape::Low => layer <= n - 2,
            Shape::Octahedron => (n - 1..=2 * n - 2).contains(&layer),
            Shape::High => layer > 2 * n - 2,
        }
    }

    pub fn contains(self, site: [i32; 3]) -> bool {
        self.has_local(self.local(site))
    }

    #[inline(always)]
    pub fn local(self, site: [i32; 3]) -> [i32; 3] {
        std::array::from_fn(|axis| site[axis] - self.anchor[axis])
    }

    #[inline(always)]
    pub fn site(self, local: [i32; 3]) -> [i32; 3] {
        std::array::from_fn(|axis| self.anchor[axis] + local[axis])
    }

    /// Local coordinates of all its sites, by r, q and p.
    pub fn locals(self) -> impl Iterator<Item = [i32; 3]> {
        let range = move || 0..self.size;
        let all = range().flat_map(move |r| range().flat_map(move |q| range().map(move |p| [p, q, r])));
        all.filter(move |&local| self.has_local(local))
    }

    pub fn site_count(self) -> u64 {
        let n = self.size as u64;
        let tetrahedron = (n * n - 1) * n / 6;
        match self.shape {
            Shape::Atom => 1,
            Shape::Low | Shape::High => tetrahedron,
            Shape::Octahedron => n * n * n - 2 * tetrahedron,
        }
    }

    /// Shape functions N_i at local coordinates, a number a node.
    ///
    /// Tetrahedra have volume coordinates, [Deng2011] Eq. (3-35). The octahedron is eight affine pieces around a centre that is
    /// the mean of its nodes: with u = (q + r - m)/m, v = (p + r - m)/m, w = (p + q - m)/m, m = n - 1, a node at the end of an
    /// axis has the positive part of its coordinate and a sixth of 1 - |u| - |v| - |w|.
    pub fn shape_functions(self, local: [i32; 3]) -> [f64; 6] {
        let m = f64::from(self.size - 1);
        let [p, q, r] = local.map(f64::from);
        match self.shape {
            Shape::Atom => [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            Shape::Low => volume_coordinates([p, q, r], m - 1.0),
            Shape::High => volume_coordinates([m - p, m - q, m - r], m - 1.0),
            Shape::Octahedron => {
                let axes = [q + r - m, p + r - m, p + q - m].map(|sum| sum / m);
                let rest = (1.0 - axes.iter().map(|axis| axis.abs()).sum::<f64>()) / 6.0;
                let [u, v, w] = axes;
                [u, -u, v, -v, w, -w].map(|axis| axis.max(0.0) + rest)
            }
        }
    }

    /// Lumped mass of each node in site masses, M_i = m sum_a N_i(a): [Deng2011] Eq. (3-29). It is the same for all.
    pub fn lumped_mass(self) -> f64 {
        self.site_count() as f64 / self.shape.node_count() as f64
    }

    /// How the consistent mass matrix m sum_a N_i(a) N_j(a) couples its nodes, over the lumped mass of one.
    pub fn mass_coupling(self) -> MassCoupling {
        let mut sums = [0.0; 2];
        for local in self.locals() {
            let [first, beside, other, ..] = self.shape_functions(local);
            sums[0] += first * beside;
            sums[1] += first * other;
        }
        let [beside, other] = sums.map(|sum| sum / self.lumped_mass());
        // The second node of an octahedron is opposite the first; all others have no opposite.
        let [share, opposite] = match self.shape {
            Shape::Octahedron => [other, beside - other],
            _ => [beside, 0.0],
        };
        MassCoupling {
            corners: self.shape.node_count(),
            share,
            opposite,
        }
    }
}

fn volume_coordinates(local: [f64; 3], edge: f64) -> [f64; 6] {
    let [second, third, fourth] = local.map(|component| component / edge);
    [1.0 - second - third - fourth, second, third, fourth, 0.0, 0.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(shape: Shape, size: i32) -> Element {
        let anchor = [-3, 7, 20];
        Element { shape, size, anchor }
    }

    #[test]
    fn a_block_of_ten_has_165_670_and_165_sites_and_14_nodes() {
        // [Deng2011] Fig. 3-7: 1,000 sites, and as many nodes an element as 1,545,348 nodes in 110,382 elements.
        let parts = Shape::OF_BLOCK.map(|shape| part(shape, 10));
        assert_eq!(parts.map(Element::site_count), [165, 670, 165]);
        assert_eq!(
            parts.iter().map(|part| part.shape.node_count()).sum::<usize>(),
            1_545_348 / 110_382
        );
        for size in 3..=30 {
            let parts = Shape::OF_BLOCK.map(|shape| part(shape, size));
            parts
                .iter()
                .for_each(|part| assert_eq!(part.locals().count() as u64, part.site_count()));
            let all: u64 = parts.iter().map(|part| part.site_count()).sum();
            assert_eq!(all, (size * size * size) as u64);
        }
    }

    #[test]
    fn shape_functions_reproduce_affine_fields_and_share_the_mass_evenly() {
        // [Deng2011] Eq. (3-35) and Eq. (3-29).
        for size in [3, 6, 10, 13] {
            for shape in Shape::OF_BLOCK {
                let element = part(shape, size);
                let corners = element.corners();
                let mut masses = [0.0; 6];
                for local in element.locals() {
                    let weights = element.shape_functions(local);
                    for axis in 0..3 {
                        let found: f64 = corners
                            .iter()
                            .zip(weights)
                            .map(|(corner, weight)| weight * f64::from(corner[axis]))
                            .sum();
                        assert!((found - f64::from(local[axis])).abs() < 1e-12, "{shape:?} {size}");
                    }
                    assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-14);
                    masses
                        .iter_mut()
                        .zip(weights)
                        .for_each(|(mass, weight)| *mass += weight);
                }
                let of_nodes = &masses[..shape.node_count()];
                assert!(
                    of_nodes.iter().all(|mass| (mass - element.lumped_mass()).abs() < 1e-10),
                    "{of_nodes:?}"
                );
            }
        }
    }

    #[test]
    fn masses_are_coupled_as_the_sums_over_sites_say() {
        // [Deng2011] Eq. (3-29): rows sum to the lumped mass.
        for size in [3, 6, 10] {
            for shape in Shape::OF_BLOCK {
                let element = part(shape, size);
                let coupling = element.mass_coupling();
                let nodes = shape.node_count();
                assert_eq!(coupling.corners, nodes);
                let mut products = [[0.0; 6]; 6];
                for weights in element.locals().map(|local| element.shape_functions(local)) {
                    for (i, j) in (0..36).map(|number| (number / 6, number % 6)) {
                        products[i][j] += weights[i] * weights[j] / element.lumped_mass();
                    }
                }
                for (i, row) in products[..nodes].iter().enumerate() {
                    for (j, found) in row[..nodes].iter().enumerate() {
                        let own = 1.0 - nodes as f64 * coupling.share - coupling.opposite;
                        let expected = match (i == j, i ^ 1 == j) {
                            (true, _) => coupling.share + own,
                            (_, true) => coupling.share + coupling.opposite,
                            _ => coupling.share,
                        };
                        assert!(
                            (found - expected).abs() < 1e-12,
                            "{shape:?} {size}: {i} {j} {found} {expected}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn nodes_are_sites_of_their_element() {
        for shape in Shape::OF_BLOCK {
            let element = part(shape, 7);
            for (number, corner) in element.corners().into_iter().enumerate() {
                assert!(element.has_local(corner) && element.contains(element.site(corner)));
                assert_eq!(element.shape_functions(corner)[number], 1.0);
            }
        }
    }
}
