//! The affine maps of triangles side by side. [Deng2011] Eq. (3-27)

use pulp::Simd;

use crate::lanes::Lanes;

/// x(p, q) = origin + p along[0] + q along[1] of some consecutive triangles of a group, nm.
#[derive(Clone, Copy)]
pub struct MapLanes<L: Simd> {
    pub origin: [Lanes<L>; 2],
    pub along: [[Lanes<L>; 2]; 2],
}

impl<L: Simd> MapLanes<L> {
    /// From the corners of triangles with so many atoms an edge.
    #[inline(always)]
    pub fn between([a, b, c]: [[Lanes<L>; 2]; 3], size: i32) -> Self {
        let edge = 1.0 / f64::from(size - 1);
        let along = [
            [(b[0] - a[0]) * edge, (b[1] - a[1]) * edge],
            [(c[0] - a[0]) * edge, (c[1] - a[1]) * edge],
        ];
        Self { origin: a, along }
    }

    /// Positions of the sites at these local coordinates.
    #[inline(always)]
    pub fn at(&self, [p, q]: [f64; 2]) -> [Lanes<L>; 2] {
        let [a, b] = self.along;
        let x = b[0].times_add(q, a[0].times_add(p, self.origin[0]));
        let y = b[1].times_add(q, a[1].times_add(p, self.origin[1]));
        [x, y]
    }

    /// The vectors that p steps along one edge and q along the other make.
    #[inline(always)]
    pub fn vector(&self, [p, q]: [f64; 2]) -> [Lanes<L>; 2] {
        let [a, b] = self.along;
        [b[0].times_add(q, a[0] * p), b[1].times_add(q, a[1] * p)]
    }

    /// Squared lengths of the nearest-neighbour bonds, nm^2.
    #[inline(always)]
    pub fn nearest_bonds(&self) -> [Lanes<L>; 3] {
        let [a, b] = self.along;
        let c = [b[0] - a[0], b[1] - a[1]];
        [squared(a), squared(b), squared(c)]
    }
}

#[inline(always)]
pub fn squared<L: Simd>([x, y]: [Lanes<L>; 2]) -> Lanes<L> {
    x.mul_add(x, y * y)
}
