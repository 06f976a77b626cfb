//! The affine maps of all triangles, laid out so that consecutive triangles can be computed side by side.

use std::ops::Range;

use pulp::Simd;
use rayon::prelude::*;

use super::{CHUNK, Planes};
use crate::lanes::{Lanes, MOST};
use crate::mesh::Mesh;

/// x(p, q) = origin + p along[0] + q along[1] of every triangle, a plane each with room for lanes beyond
/// the last, nm. [Deng2011] Eq. (3-27)
#[derive(Default)]
pub struct Maps {
    /// origin x, y, along[0] x, y, along[1] x, y of `CHUNK` triangles after those of the chunk before.
    planes: [Vec<f64>; 6],
    /// 1 / (size - 1) of every triangle.
    edge: Vec<f64>,
}

/// The maps of some consecutive triangles.
#[derive(Clone, Copy)]
pub struct MapLanes<L: Simd> {
    pub origin: [Lanes<L>; 2],
    pub along: [[Lanes<L>; 2]; 2],
}

impl Maps {
    pub fn new(mesh: &Mesh) -> Self {
        let edge: Vec<f64> = mesh.elements[..mesh.triangles]
            .iter()
            .map(|element| 1.0 / f64::from(element.size - 1))
            .collect();
        Self {
            planes: std::array::from_fn(|_| vec![0.0; edge.len() + MOST]),
            edge,
        }
    }

    /// Follows the nodes of some consecutive triangles.
    pub fn update(&mut self, position: &Planes, triangles: Range<usize>) {
        let edge = &self.edge[triangles.clone()];
        let nodes = 3 * triangles.start..3 * triangles.end;
        let planes = self.planes.each_mut().map(|plane| &mut plane[triangles.clone()]);
        let [origin_x, origin_y, first_x, first_y, second_x, second_y] = planes;
        let [x, y] = position.each_ref().map(|plane| &plane[nodes.clone()]);
        let along_x = tasks([origin_x, first_x, second_x], edge, x);
        let along_y = tasks([origin_y, first_y, second_y], edge, y);
        // Both axes at once, so that threads wait for each other only once.
        along_x
            .chain(along_y)
            .for_each(|(((origin, first), second), (edge, nodes))| {
                for (k, corner) in nodes.chunks_exact(3).enumerate() {
                    origin[k] = corner[0];
                    first[k] = (corner[1] - corner[0]) * edge[k];
                    second[k] = (corner[2] - corner[0]) * edge[k];
                }
            });
    }

    /// The maps of consecutive triangles from one on; beyond the last one they mean nothing.
    #[inline(always)]
    pub fn lanes<L: Simd>(&self, simd: L, from: usize) -> MapLanes<L> {
        let [x, y, a, b, c, d] = &self.planes;
        let load = |plane: &[f64]| Lanes::load(simd, plane, from);
        MapLanes {
            origin: [load(x), load(y)],
            along: [[load(a), load(b)], [load(c), load(d)]],
        }
    }
}

type Task<'a> = (((&'a mut [f64], &'a mut [f64]), &'a mut [f64]), (&'a [f64], &'a [f64]));

/// The maps along one axis, triangles in tasks.
fn tasks<'a>(
    [origin, first, second]: [&'a mut [f64]; 3],
    edge: &'a [f64],
    nodes: &'a [f64],
) -> impl IndexedParallelIterator<Item = Task<'a>> {
    origin
        .par_chunks_mut(CHUNK)
        .zip(first.par_chunks_mut(CHUNK))
        .zip(second.par_chunks_mut(CHUNK))
        .zip(edge.par_chunks(CHUNK).zip(nodes.par_chunks(3 * CHUNK)))
}

impl<L: Simd> MapLanes<L> {
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
