//! The affine maps of all triangles, laid out so that consecutive triangles can be computed side by side.

use rayon::prelude::*;

use super::affine::INVERSE_ROOT_3;
use super::lanes::Lanes;
use super::{CHUNK, Planes};
use crate::mesh::Mesh;

/// x(p, q) = origin + p along[0] + q along[1] of every triangle, a plane each, nm. [Deng2011] Eq. (3-27)
#[derive(Default)]
pub struct Maps {
    /// origin x, y, along[0] x, y, along[1] x, y of `CHUNK` triangles after those of the chunk before.
    planes: [Vec<f64>; 6],
    /// 1 / (size - 1) of every triangle.
    edge: Vec<f64>,
}

/// The maps of some consecutive triangles.
#[derive(Clone, Copy)]
pub struct MapLanes<const W: usize> {
    pub origin: [Lanes<W>; 2],
    pub along: [[Lanes<W>; 2]; 2],
}

impl Maps {
    pub fn new(mesh: &Mesh) -> Self {
        let edge: Vec<f64> = mesh.elements[..mesh.triangles]
            .iter()
            .map(|element| 1.0 / f64::from(element.size - 1))
            .collect();
        Self {
            planes: std::array::from_fn(|_| vec![0.0; edge.len()]),
            edge,
        }
    }

    /// Follows the nodes.
    pub fn update(&mut self, position: &Planes) {
        let edge = &self.edge;
        let [origin_x, origin_y, first_x, first_y, second_x, second_y] = &mut self.planes;
        let axes = [(origin_x, first_x, second_x), (origin_y, first_y, second_y)];
        for ((origin, first, second), nodes) in axes.into_iter().zip(position) {
            origin
                .par_chunks_mut(CHUNK)
                .zip(first.par_chunks_mut(CHUNK))
                .zip(second.par_chunks_mut(CHUNK))
                .zip(edge.par_chunks(CHUNK).zip(nodes.par_chunks(3 * CHUNK)))
                .for_each(|(((origin, first), second), (edge, nodes))| {
                    for (k, corner) in nodes.chunks_exact(3).take(edge.len()).enumerate() {
                        origin[k] = corner[0];
                        first[k] = (corner[1] - corner[0]) * edge[k];
                        second[k] = (corner[2] - corner[0]) * edge[k];
                    }
                });
        }
    }

    #[inline(always)]
    pub fn lanes<const W: usize>(&self, from: usize) -> MapLanes<W> {
        let [x, y, a, b, c, d] = &self.planes;
        MapLanes {
            origin: [Lanes::load(x, from), Lanes::load(y, from)],
            along: [
                [Lanes::load(a, from), Lanes::load(b, from)],
                [Lanes::load(c, from), Lanes::load(d, from)],
            ],
        }
    }
}

impl<const W: usize> MapLanes<W> {
    /// One of the triangles alone.
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> MapLanes<1> {
        let one = |value: Lanes<W>| Lanes([value[lane]]);
        MapLanes {
            origin: self.origin.map(one),
            along: self.along.map(|vector| vector.map(one)),
        }
    }

    /// Positions of the sites at these local coordinates.
    #[inline(always)]
    pub fn at(&self, local: [i32; 2]) -> [Lanes<W>; 2] {
        let [p, q] = [f64::from(local[0]), f64::from(local[1])];
        let [a, b] = self.along;
        let x = b[0].times_add(q, a[0].times_add(p, self.origin[0]));
        let y = b[1].times_add(q, a[1].times_add(p, self.origin[1]));
        [x, y]
    }

    /// The vectors that p steps along one edge and q along the other make.
    #[inline(always)]
    pub fn vector(&self, local: [i32; 2]) -> [Lanes<W>; 2] {
        let [p, q] = [f64::from(local[0]), f64::from(local[1])];
        let [a, b] = self.along;
        [b[0].times_add(q, a[0] * p), b[1].times_add(q, a[1] * p)]
    }

    /// Deformation gradients with respect to the perfect lattice of this spacing; `sign` is the triangles' orientation.
    /// Columns are the images of the unit vectors along x and y.
    #[inline(always)]
    pub fn deformation_gradient(&self, sign: i32, spacing: f64) -> [[Lanes<W>; 2]; 2] {
        let scale = f64::from(sign) / spacing;
        let [a, b] = self.along;
        let across = scale * INVERSE_ROOT_3;
        let second = [(b[0] * 2.0 - a[0]) * across, (b[1] * 2.0 - a[1]) * across];
        [[a[0] * scale, a[1] * scale], second]
    }
}

/// Whether deformation gradients (columns) stretch every vector by this factor at least: F^T F - s^2 is then positive.
#[inline(always)]
pub fn stretch_at_least<const W: usize>([x, y]: [[Lanes<W>; 2]; 2], factor: f64) -> bool {
    let least = Lanes::all(factor * factor);
    let xx = x[0] * x[0] + x[1] * x[1] - least;
    let yy = y[0] * y[0] + y[1] * y[1] - least;
    let xy = x[0] * y[0] + x[1] * y[1];
    xx.every(|value| value > 0.0) && (xx * yy - xy * xy).every(|value| value > 0.0)
}
