//! How the parts of blocks of one size border each other: the same for every block of the crystal.
//!
//! Nodes are named by their place in their part. An octahedron borders tetrahedra alone along faces, other octahedra along
//! edges; tetrahedra of two blocks and octahedra at their tips are second neighbours. A test finds all of it by enumerating
//! the bonds of a block.

use super::element::Shape;

/// What of two parts lies side by side.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Contact {
    /// A face of a tetrahedron, the first, and one of an octahedron: three nodes each, opposite to each other. Each site of
    /// the tetrahedron's face has a bond to three of the octahedron's.
    Face { tetrahedron: [u8; 3], octahedron: [u8; 3] },
    /// Edges of two octahedra, site by site nearest neighbours.
    Edges { first: [u8; 2], second: [u8; 2] },
    /// Edges of two tetrahedra, site by site second neighbours.
    FarEdges { first: [u8; 2], second: [u8; 2] },
    /// Tips of two octahedra, second neighbours.
    Tips { first: u8, second: u8 },
}

/// A part and another one beside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Border {
    pub first: Shape,
    pub second: Shape,
    /// From the block of the first to that of the second.
    pub shift: [i32; 3],
    pub contact: Contact,
}

const fn face(first: Shape, tetrahedron: [u8; 3], octahedron: [u8; 3], shift: [i32; 3]) -> Border {
    let contact = Contact::Face {
        tetrahedron,
        octahedron,
    };
    Border {
        first,
        second: Shape::Octahedron,
        shift,
        contact,
    }
}

const fn edges(first: [u8; 2], second: [u8; 2], shift: [i32; 3]) -> Border {
    let contact = Contact::Edges { first, second };
    Border {
        first: Shape::Octahedron,
        second: Shape::Octahedron,
        shift,
        contact,
    }
}

const fn far_edges(first: [u8; 2], second: [u8; 2], shift: [i32; 3]) -> Border {
    let contact = Contact::FarEdges { first, second };
    Border {
        first: Shape::Low,
        second: Shape::High,
        shift,
        contact,
    }
}

const fn tips(first: u8, second: u8, shift: [i32; 3]) -> Border {
    let contact = Contact::Tips { first, second };
    Border {
        first: Shape::Octahedron,
        second: Shape::Octahedron,
        shift,
        contact,
    }
}

/// All borders of a block, each told from one of its sides.
pub const BORDERS: [Border; 23] = [
    face(Shape::Low, [1, 2, 3], [1, 3, 5], [0, 0, 0]),
    face(Shape::Low, [0, 2, 3], [1, 4, 2], [-1, 0, 0]),
    face(Shape::Low, [0, 1, 3], [3, 4, 0], [0, -1, 0]),
    face(Shape::Low, [0, 1, 2], [5, 2, 0], [0, 0, -1]),
    face(Shape::High, [1, 2, 3], [0, 2, 4], [0, 0, 0]),
    face(Shape::High, [0, 2, 3], [0, 5, 3], [1, 0, 0]),
    face(Shape::High, [0, 1, 3], [2, 5, 1], [0, 1, 0]),
    face(Shape::High, [0, 1, 2], [4, 3, 1], [0, 0, 1]),
    edges([0, 2], [3, 1], [0, 0, 1]),
    edges([3, 4], [5, 2], [0, 1, -1]),
    edges([0, 4], [5, 1], [0, 1, 0]),
    edges([1, 2], [3, 0], [1, -1, 0]),
    edges([1, 4], [5, 0], [1, 0, -1]),
    edges([2, 4], [5, 3], [1, 0, 0]),
    far_edges([0, 3], [3, 0], [-1, -1, 0]),
    far_edges([0, 2], [2, 0], [-1, 0, -1]),
    far_edges([3, 2], [2, 3], [-1, 0, 0]),
    far_edges([0, 1], [1, 0], [0, -1, -1]),
    far_edges([3, 1], [1, 3], [0, -1, 0]),
    far_edges([2, 1], [1, 2], [0, 0, -1]),
    tips(4, 5, [1, 1, -1]),
    tips(2, 3, [1, -1, 1]),
    tips(0, 1, [-1, 1, 1]),
];

/// Nearest-neighbour bonds across a border of blocks of n sites an edge.
pub fn bonds(contact: Contact, n: i32) -> u32 {
    let n = n as u32;
    match contact {
        Contact::Face { .. } => 3 * n * (n - 1) / 2,
        Contact::Edges { .. } => n,
        Contact::FarEdges { .. } | Contact::Tips { .. } => 0,
    }
}
