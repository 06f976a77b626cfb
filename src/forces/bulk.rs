//! Bonds inside triangles: all bonds of one lattice vector are the same vector, so each costs one evaluation.

use pulp::Simd;

use super::affine::{Affine, smallest_stretch};
use super::maps::{MapLanes, squared};
use super::measure::{Count, PARTS};
use super::summation::Summation;
use crate::lanes::Lanes;
use crate::lattice::triangular;
use crate::mesh::Mesh;
use crate::potential::{CutPotential, PairShape};

/// A lattice vector in local coordinates and how many bonds of a triangle it stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BulkBond {
    pub local: [i32; 2],
    /// The same as numbers.
    pub vector: [f64; 2],
    pub count: f64,
    /// Length in spacings.
    pub length: f64,
}

/// What the bonds inside triangles give.
#[derive(Clone, Copy)]
pub struct BulkSum<L: Simd> {
    /// Forces on the nodes, x and y of each.
    pub nodal: [Lanes<L>; 6],
    /// Zero where nothing is measured.
    pub held: [Lanes<L>; PARTS],
}

/// Forces of bonds inside triangles on their nodes, and what the bonds hold if it is to be `MEASURED`.
#[inline(always)]
pub fn sum<S: PairShape, L: Simd, const MEASURED: bool>(
    simd: L,
    law: &CutPotential<S>,
    size: i32,
    map: &MapLanes<L>,
    bonds: &[BulkBond],
) -> BulkSum<L> {
    let zero = Lanes::all(simd, 0.0);
    let mut count = Count::<L, MEASURED>::new(simd);
    let [mut first_x, mut first_y, mut second_x, mut second_y] = [zero; 4];
    for bond in bonds {
        let [x, y] = map.vector(bond.vector);
        let slopes = count.slopes(simd, law, squared([x, y]), Lanes::all(simd, bond.count));
        let pull = slopes * -bond.count;
        let [p, q] = [pull * bond.vector[0], pull * bond.vector[1]];
        first_x = p.mul_add(x, first_x);
        first_y = p.mul_add(y, first_y);
        second_x = q.mul_add(x, second_x);
        second_y = q.mul_add(y, second_y);
    }
    let mut held = [zero; PARTS];
    if MEASURED {
        // A bond is p along[0] + q along[1]: the forces have its parts already, with the opposite sign.
        let [a, b] = map.along;
        let virial = |x: Lanes<L>, y: Lanes<L>, axis: usize| zero - x * a[axis] - y * b[axis];
        held = [
            count.energy,
            count.pairs,
            virial(first_x, second_x, 0),
            virial(first_y, second_y, 1),
            virial(first_x, second_x, 1),
        ];
    }
    let edge = 1.0 / f64::from(size - 1);
    let [first_x, first_y] = [first_x * edge, first_y * edge];
    let [second_x, second_y] = [second_x * edge, second_y * edge];
    let [x, y] = [zero - first_x - second_x, zero - first_y - second_y];
    BulkSum {
        nodal: [x, y, first_x, first_y, second_x, second_y],
        held,
    }
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
                    vector: local.map(f64::from),
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

    /// The lattice vectors within the cutoff of triangles whose lattice is regular.
    #[inline(always)]
    pub fn listed(&self, size: i32) -> &[BulkBond] {
        let (_, listed, bonds) = self.table(size);
        &bonds[..*listed]
    }
}
