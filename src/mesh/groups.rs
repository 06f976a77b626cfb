//! Elements that are alike and follow each other, and how their nodes are numbered.

use std::ops::Range;

use super::element::Element;

/// Triangles of one size and orientation side by side along a row. Their first corners have consecutive numbers, then
/// their second corners do, then their third: what is done to one corner is done to many side by side in memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    pub elements: Range<usize>,
    /// Atoms an edge.
    pub size: i32,
}

impl Group {
    pub fn len(&self) -> usize {
        self.elements.len()
    }

    pub fn is_empty(&self) -> bool {
        self.elements.is_empty()
    }

    /// The nodes of all its triangles.
    pub fn nodes(&self) -> Range<usize> {
        3 * self.elements.start..3 * self.elements.end
    }

    /// The node at a corner of one of its triangles.
    #[inline(always)]
    pub fn node(&self, element: usize, corner: usize) -> usize {
        3 * self.elements.start + corner * self.len() + (element - self.elements.start)
    }
}

/// The groups of all triangles of a mesh, which come before its atoms.
#[derive(Clone, Debug, Default)]
pub struct Groups {
    groups: Vec<Group>,
    of_triangle: Vec<u32>,
}

impl Groups {
    pub fn new(triangles: &[Element]) -> Self {
        let mut groups: Vec<Group> = Vec::new();
        let mut of_triangle = Vec::with_capacity(triangles.len());
        let follows = |one: &Element, next: &Element| {
            let moved = Element {
                column: one.column + one.size + 1,
                ..*one
            };
            *next == moved
        };
        let mut start = 0;
        for run in triangles.chunk_by(follows) {
            of_triangle.resize(start + run.len(), groups.len() as u32);
            groups.push(Group {
                elements: start..start + run.len(),
                size: run[0].size,
            });
            start += run.len();
        }
        Self { groups, of_triangle }
    }

    /// All of them, by rising number of their triangles.
    pub fn all(&self) -> &[Group] {
        &self.groups
    }

    /// The group of a triangle.
    #[inline(always)]
    pub fn of(&self, triangle: usize) -> &Group {
        &self.groups[self.number_of(triangle)]
    }

    /// The place of a triangle's group among [`Self::all`].
    #[inline(always)]
    pub fn number_of(&self, triangle: usize) -> usize {
        self.of_triangle[triangle] as usize
    }

    /// The groups of some consecutive triangles, which begin and end with groups.
    pub fn of_range(&self, triangles: &Range<usize>) -> &[Group] {
        if triangles.is_empty() {
            return &[];
        }
        let last = self.number_of(triangles.end - 1);
        &self.groups[self.number_of(triangles.start)..=last]
    }

    /// The triangle that a node of a triangle belongs to.
    pub fn triangle_of_node(&self, node: usize) -> usize {
        let after = self.groups.partition_point(|group| group.nodes().start <= node);
        let group = &self.groups[after - 1];
        group.elements.start + (node - group.nodes().start) % group.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_corner_has_a_number_of_its_own_and_alike_corners_follow_each_other() {
        let triangle = |size: i32, sign: i32, column: i32| Element {
            size,
            sign,
            column,
            row: 0,
        };
        // A gap, another orientation and another size each begin a group.
        let triangles = [
            triangle(10, 1, 0),
            triangle(10, 1, 11),
            triangle(10, 1, 22),
            triangle(10, 1, 44),
            triangle(10, -1, 55),
            triangle(4, -1, 66),
            triangle(4, -1, 71),
        ];
        let groups = Groups::new(&triangles);
        let ranges: Vec<Range<usize>> = groups.all().iter().map(|group| group.elements.clone()).collect();
        assert_eq!(ranges, [0..3, 3..4, 4..5, 5..7]);
        assert_eq!(groups.of_range(&(3..7)), &groups.all()[1..]);
        assert!(groups.of_range(&(3..3)).is_empty());
        assert_eq!([0, 1, 2].map(|corner| groups.of(1).node(1, corner)), [1, 4, 7]);
        let mut nodes: Vec<usize> = Vec::new();
        for number in 0..triangles.len() {
            for corner in 0..3 {
                let node = groups.of(number).node(number, corner);
                assert_eq!(groups.triangle_of_node(node), number);
                nodes.push(node);
            }
        }
        nodes.sort_unstable();
        assert!(nodes.into_iter().eq(0..3 * triangles.len()));
    }
}
