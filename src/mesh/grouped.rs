//! What meshes of all dimensions have in common.

use std::ops::Range;

/// The mass matrix of an element with nodes alike, over the lumped mass of one: its rows sum to 1, [Deng2011] Eq. (3-29).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassCoupling {
    /// Nodes of the element.
    pub corners: usize,
    /// What couples any two nodes.
    pub share: f64,
    /// What couples two opposite nodes beside that; each stands beside its opposite in the order of the nodes. Zero for a
    /// triangle and a tetrahedron, which have none.
    pub opposite: f64,
}

impl MassCoupling {
    /// Nodes none of which is opposite another.
    pub fn even(corners: usize, share: f64) -> Self {
        Self {
            corners,
            share,
            opposite: 0.0,
        }
    }

    /// With only a share of it, the rest of the masses lumped.
    pub fn times(self, share: f64) -> Self {
        Self {
            share: share * self.share,
            opposite: share * self.opposite,
            ..self
        }
    }

    /// What the matrix multiplies motions by whose sum is zero: two opposite nodes together, and against each other.
    fn stretches(self) -> [f64; 2] {
        let together = 1.0 - self.corners as f64 * self.share;
        [together, together - 2.0 * self.opposite]
    }

    /// The least that the matrix multiplies any motion by.
    pub fn least(self) -> f64 {
        let [together, against] = self.stretches();
        together.min(against)
    }

    /// How forces become accelerations, by the inverse of the matrix.
    pub fn answer(self) -> Answer {
        let [together, against] = self.stretches();
        match self.opposite == 0.0 {
            true => Answer {
                mass: together,
                of_sum: self.share,
                of_opposite: 0.0,
            },
            false => Answer {
                mass: 2.0 * together * against / (together + against),
                of_sum: 2.0 * self.share * against / (together + against),
                of_opposite: (against - together) / (against + together),
            },
        }
    }
}

/// The acceleration of a node is the force on it, less a part of the sum of the forces on all nodes of its element, plus a part
/// of that on the opposite node, over a mass; all over the lumped mass of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    pub mass: f64,
    pub of_sum: f64,
    pub of_opposite: f64,
}

impl Answer {
    /// That of lumped masses.
    pub const LUMPED: Self = Self {
        mass: 1.0,
        of_sum: 0.0,
        of_opposite: 0.0,
    };
}

/// How a mesh of any dimension numbers its elements: first those in groups of alike ones, then the atoms.
///
/// The nodes of a group follow each other, first corner by first corner, then the second corners, and so on; the groups'
/// nodes follow each other as the groups do, and those of atoms come last.
pub trait Grouped {
    fn element_count(&self) -> usize;
    fn node_count(&self) -> usize;
    /// How many elements are in groups.
    fn grouped(&self) -> usize;
    /// The place of the group of an element among all groups.
    fn group_number(&self, element: usize) -> usize;
    fn group_count(&self) -> usize;
    /// The elements and the nodes of a group.
    fn group(&self, number: usize) -> [Range<usize>; 2];
    /// Of each node of an element, in site masses.
    fn lumped_mass(&self, element: usize) -> f64;
    /// For each group how the consistent mass matrix couples the nodes of one of its elements.
    fn mass_couplings(&self) -> Vec<MassCoupling>;

    /// Where the nodes of elements from a number on begin that starts a group or the atoms.
    fn first_node(&self, element: usize) -> usize {
        match element < self.grouped() {
            true => self.group(self.group_number(element))[1].start,
            false => self.node_count() - (self.element_count() - element),
        }
    }

    /// The nodes of consecutive elements, all in groups or all atoms: corner by corner of each group.
    fn nodes_of_range(&self, elements: &Range<usize>) -> Vec<Range<usize>> {
        if elements.start >= self.grouped() {
            let first = self.first_node(elements.start);
            return std::iter::once(first..first + elements.len()).collect();
        }
        let groups = self.group_number(elements.start)..=self.group_number(elements.end - 1);
        let of_group = |number: usize| {
            let [all, nodes] = self.group(number);
            let part = elements.start.max(all.start) - all.start..elements.end.min(all.end) - all.start;
            let corners = nodes.step_by(all.len());
            corners.map(move |first| first + part.start..first + part.end)
        };
        groups.flat_map(of_group).collect()
    }
}

/// Lumped masses, in site masses, of the nodes of some ranges of elements, which start and end with groups or are atoms; the
/// others are untouched zeros, which take no memory.
pub fn masses_of(mesh: &impl Grouped, elements: &[Range<usize>]) -> Vec<f64> {
    let mut masses = vec![0.0; mesh.node_count()];
    for elements in elements {
        let mut from = elements.start;
        while from < elements.end.min(mesh.grouped()) {
            let [group, nodes] = mesh.group(mesh.group_number(from));
            masses[nodes].fill(mesh.lumped_mass(from));
            from = group.end;
        }
        for atom in from.max(mesh.grouped())..elements.end {
            masses[mesh.first_node(atom)] = mesh.lumped_mass(atom);
        }
    }
    masses
}
