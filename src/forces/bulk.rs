//! Bonds inside triangles: all bonds of one lattice vector are the same vector, so each costs one evaluation.

use super::affine::{Affine, smallest_stretch};
use super::lanes::Lanes;
use super::maps::{MapLanes, stretch_at_least};
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

/// How far bonds reach in a lattice, nm.
pub struct Reach {
    pub cutoff: f64,
    pub spacing: f64,
}

/// Forces of bonds inside triangles on their nodes, x and y of each.
#[inline(always)]
pub fn force<S: PairShape, const W: usize>(
    law: &CutPotential<S>,
    size: i32,
    map: &MapLanes<W>,
    bonds: &[BulkBond],
) -> [Lanes<W>; 6] {
    let [mut first, mut second] = [[Lanes::default(); 2]; 2];
    for bond in bonds {
        let [x, y] = map.vector(bond.local);
        let pull = Lanes(law.slopes(x.mul_add(x, y * y).0)) * -bond.count;
        let [p, q] = [pull * f64::from(bond.local[0]), pull * f64::from(bond.local[1])];
        first = [p.mul_add(x, first[0]), p.mul_add(y, first[1])];
        second = [q.mul_add(x, second[0]), q.mul_add(y, second[1])];
    }
    let edge = 1.0 / f64::from(size - 1);
    let first = [first[0] * edge, first[1] * edge];
    let second = [second[0] * edge, second[1] * edge];
    let origin = [(first[0] + second[0]) * -1.0, (first[1] + second[1]) * -1.0];
    [origin[0], origin[1], first[0], first[1], second[0], second[1]]
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

    #[inline(always)]
    fn table(&self, size: i32) -> &(i32, usize, Vec<BulkBond>) {
        let table = self.by_size.iter().find(|table| table.0 == size);
        table.expect("every size has its table")
    }

    /// The lattice vectors of a triangle that may be within the cutoff: those listed, and under strong deformation as
    /// many more as the smallest stretch allows.
    #[inline(always)]
    pub fn within(&self, size: i32, affine: &Affine, spacing: f64, cutoff: f64) -> &[BulkBond] {
        let (_, listed, bonds) = self.table(size);
        let stretch = smallest_stretch(affine.deformation_gradient(1, spacing)) * spacing;
        let mut needed = *listed;
        while needed < bonds.len() && bonds[needed].length * stretch < cutoff {
            needed += 1;
        }
        &bonds[..needed]
    }

    /// The lattice vectors within the cutoff of triangles of one size side by side; `None` where some of them are so
    /// strongly deformed that each has its own.
    #[inline(always)]
    pub fn within_all<const W: usize>(&self, size: i32, map: &MapLanes<W>, reach: &Reach) -> Option<&[BulkBond]> {
        let (_, listed, bonds) = self.table(size);
        let enough = match bonds.get(*listed) {
            None => true,
            Some(next) => {
                // A little more than is needed, so that rounding does not matter.
                let stretch = 1.0001 * reach.cutoff / (next.length * reach.spacing);
                stretch_at_least(map.deformation_gradient(1, reach.spacing), stretch)
            }
        };
        if enough { Some(&bonds[..*listed]) } else { None }
    }
}
