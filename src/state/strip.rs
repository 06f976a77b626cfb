//! Triangles on their way from one moment into the next.

use std::ops::Range;

use crate::mesh::groups::Group;

/// Some triangles of a group side by side: x and y, each of the first, of the second and of the third corners.
pub struct Strip<'a> {
    /// Number of the group.
    pub group: usize,
    pub axes: [[Corners<'a>; 3]; 2],
}

/// Corners of triangles side by side along one axis.
pub struct Corners<'a> {
    /// Numbers of the nodes.
    pub nodes: Range<usize>,
    /// eV/nm
    pub force: &'a [f64],
    /// nm/ps
    pub velocity: &'a mut [f64],
    /// Where they come to be, nm.
    pub next: &'a mut [f64],
}

impl<'a> Strip<'a> {
    /// Some triangles of the group with this number, from planes that begin with its first node.
    pub fn of(
        number: usize,
        group: &Group,
        triangles: &Range<usize>,
        force: [&'a [f64]; 2],
        velocity: [&'a mut [f64]; 2],
        next: [&'a mut [f64]; 2],
    ) -> Self {
        let first = triangles.start - group.elements.start;
        let part = first..first + triangles.len();
        let mut planes = force.into_iter().zip(velocity).zip(next);
        let axes = [0, 1].map(|_| {
            let ((force, velocity), next) = planes.next().expect("there are two axes");
            let [mut velocity, mut next] = [velocity, next].map(|plane| plane.chunks_mut(group.len()));
            [0, 1, 2].map(|corner| {
                let node = group.node(triangles.start, corner);
                let corners = [&mut velocity, &mut next].map(|corners| corners.next().unwrap_or_default());
                let [velocity, next] = corners.map(|corners| &mut corners[part.clone()]);
                Corners {
                    nodes: node..node + triangles.len(),
                    force: &force[corner * group.len()..][part.clone()],
                    velocity,
                    next,
                }
            })
        });
        Self { group: number, axes }
    }
}
