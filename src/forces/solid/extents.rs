//! How far parts reach along some directions, which bounds the space that their sites take.

use std::ops::Range;

use nalgebra::Vector3;

use crate::mesh::solid::sites::Frame;

/// Directions along which parts are compared: in the crystal at rest they tell apart all that are no first or second neighbours.
pub struct Directions([[f64; 3]; COUNT]);

/// The normals of the four faces of parts, the axes of the laboratory, and in each face the normals of its three edges.
const COUNT: usize = NORMALS + 3 + 12;

const NORMALS: usize = 4;

/// So many directions, the normals and the axes, tell most parts apart.
const FIRST: usize = NORMALS + 3;

impl Directions {
    pub fn new(frame: &Frame) -> Self {
        let [a, b, c] = frame.vectors.map(Vector3::from);
        let faces = [[a, b, b - a], [b, c, c - b], [c, a, a - c], [b - a, c - a, c - b]];
        let normals = faces.map(|[one, other, _]| one.cross(&other).normalize());
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        let of_edges = faces.iter().zip(&normals);
        let of_edges = of_edges.flat_map(|(edges, normal)| edges.map(|edge| normal.cross(&edge).normalize()));
        let mut directions = [[0.0; 3]; COUNT];
        let all = normals.into_iter().chain(axes).chain(of_edges);
        directions.iter_mut().zip(all).for_each(|(to, from)| *to = from.into());
        Self(directions)
    }

    fn along(&self, number: usize, place: [f64; 3]) -> f64 {
        let [x, y, z] = self.0[number];
        x * place[0] + y * place[1] + z * place[2]
    }
}

/// The least and the greatest that places reach along each direction.
#[derive(Clone, Copy)]
pub struct Extents {
    least: [f64; COUNT],
    most: [f64; COUNT],
}

impl Extents {
    pub fn of(directions: &Directions, places: impl Iterator<Item = [f64; 3]>) -> Self {
        let [mut least, mut most] = [[f64::INFINITY; COUNT], [f64::NEG_INFINITY; COUNT]];
        for place in places {
            for number in 0..COUNT {
                let along = directions.along(number, place);
                least[number] = least[number].min(along);
                most[number] = most[number].max(along);
            }
        }
        Self { least, most }
    }

    /// Those of the places of both.
    pub fn and(mut self, other: &Self) -> Self {
        for number in 0..COUNT {
            self.least[number] = self.least[number].min(other.least[number]);
            self.most[number] = self.most[number].max(other.most[number]);
        }
        self
    }

    /// Whether some direction shows that all places of one are farther than this from all of the other.
    #[inline(always)]
    pub fn are_apart(&self, other: &Self, distance: f64) -> bool {
        self.are_apart_along(0..FIRST, other, distance) || self.are_apart_along(FIRST..COUNT, other, distance)
    }

    /// All these directions are looked at, because that is faster than to stop.
    #[inline(always)]
    fn are_apart_along(&self, directions: Range<usize>, other: &Self, distance: f64) -> bool {
        let mut apart = false;
        for number in directions {
            apart |= self.least[number] - other.most[number] > distance;
            apart |= other.least[number] - self.most[number] > distance;
        }
        apart
    }

    /// Whether no direction shows that a place is farther than this from all of these.
    pub fn is_near(&self, directions: &Directions, place: [f64; 3], distance: f64) -> bool {
        (0..COUNT).all(|number| {
            let along = directions.along(number, place);
            along > self.least[number] - distance && along < self.most[number] + distance
        })
    }

    /// The middle of the box along the axes, and its longest edge.
    pub fn cube(&self) -> ([f64; 3], f64) {
        let axes = [0, 1, 2].map(|axis| [self.least[NORMALS + axis], self.most[NORMALS + axis]]);
        let middle = axes.map(|[least, most]| 0.5 * (least + most));
        let edge = axes
            .iter()
            .fold(0.0, |edge, [least, most]| f64::max(edge, most - least));
        (middle, edge)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_told_apart_where_a_lattice_plane_lies_between_them() {
        let frame = Frame::of_blocks(1.0);
        let directions = Directions::new(&frame);
        let corners = |shift: i32| {
            let corners = [[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]];
            corners.map(|[i, j, k]| frame.place([i + shift, j + shift, k + shift]))
        };
        let [low, high] = [0, 4].map(|shift| Extents::of(&directions, corners(shift).into_iter()));
        // The greatest i + j + k of the one is 3 and the least of the other 12, and layers are the root of 2/3 apart.
        let gap = 9.0 * (2f64 / 3.0).sqrt();
        assert!(low.are_apart(&high, gap - 1e-9) && high.are_apart(&low, gap - 1e-9));
        assert!(!low.are_apart(&high, gap + 1e-9));
        let tip = frame.place([4, 4, 4]);
        assert!(low.is_near(&directions, tip, gap + 1e-9) && !low.is_near(&directions, tip, gap - 1e-9));
        assert!(
            corners(0)
                .into_iter()
                .all(|corner| low.is_near(&directions, corner, 1e-9))
        );
        assert!((low.cube().1 - 3.0).abs() < 1e-12);
    }
}
