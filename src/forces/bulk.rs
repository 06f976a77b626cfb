//! Bonds inside triangles: all bonds of one lattice vector are the same vector, so each costs one evaluation.

use super::affine::{Affine, smallest_stretch};
use super::summation::Summation;
use crate::lattice::triangular;
use crate::mesh::Mesh;
use crate::potential::{CutPotential, PairShape};

/// A lattice vector in local coordinates and how many bonds of a triangle it stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BulkBond {
    pub local: [i32; 2],
    pub count: f64,
    /// Length in spacings.
    pub length: f64,
}

/// For every triangle size in a mesh its lattice vectors by length; the first `listed` are always summed.
pub struct BulkBonds {
    by_size: Vec<(i32, usize, Vec<BulkBond>)>,
}

impl BulkBonds {
    pub fn new(mesh: &Mesh, listed_length: f64, summation: Summation) -> Self {
        let mut sizes: Vec<i32> = mesh.elements[..mesh.triangles]
            .iter()
            .map(|element| element.size)
            .collect();
        sizes.dedup();
        let table = |size: i32| {
            let bonds: Vec<BulkBond> = triangular::half_vectors_within(f64::from(size))
                .into_iter()
                .map(|local| BulkBond {
                    local,
                    count: summation.bulk_count(size, local),
                    length: f64::from(triangular::squared_length(local)).sqrt(),
                })
                .filter(|bond| bond.count > 0.0)
                .collect();
            let listed = bonds.iter().take_while(|bond| bond.length <= listed_length).count();
            (size, listed, bonds)
        };
        Self {
            by_size: sizes.into_iter().map(table).collect(),
        }
    }

    /// The lattice vectors of a triangle that may be within the cutoff: those listed, and under strong deformation as
    /// many more as the smallest stretch allows.
    #[inline(always)]
    pub fn within(&self, size: i32, affine: &Affine, spacing: f64, cutoff: f64) -> &[BulkBond] {
        let (_, listed, bonds) = self
            .by_size
            .iter()
            .find(|table| table.0 == size)
            .expect("every size has its table");
        let stretch = smallest_stretch(affine.deformation_gradient(1, spacing)) * spacing;
        let mut needed = *listed;
        while needed < bonds.len() && bonds[needed].length * stretch < cutoff {
            needed += 1;
        }
        &bonds[..needed]
    }

    /// Forces of the bonds inside a triangle on its nodes.
    #[inline(always)]
    pub fn force<S: PairShape>(
        &self,
        law: &CutPotential<S>,
        size: i32,
        affine: &Affine,
        spacing: f64,
    ) -> [[f64; 2]; 3] {
        let [mut first, mut second] = [[0.0; 2]; 2];
        for bond in self.within(size, affine, spacing, law.cutoff()) {
            let [x, y] = affine.vector(bond.local);
            let pull = bond.count * law.slope(x * x + y * y);
            let [p, q] = [f64::from(bond.local[0]) * pull, f64::from(bond.local[1]) * pull];
            first = [first[0] - p * x, first[1] - p * y];
            second = [second[0] - q * x, second[1] - q * y];
        }
        let edge = 1.0 / f64::from(size - 1);
        let [first, second] = [first, second].map(|sum| [sum[0] * edge, sum[1] * edge]);
        [[-first[0] - second[0], -first[1] - second[1]], first, second]
    }
}
