//! Sites that may meet others: single atoms, and exposed sites of parts.

use std::ops::Range;

use super::Planes;
use super::nodal::site_weight;
use crate::forces::Summation;
use crate::lanes::MOST;
use crate::mesh::solid::Solid;
use crate::mesh::solid::cut::Cut;

/// Sites by rising number of their element and then in the order of the element, each with the nodes that carry it.
#[derive(Clone, Debug, Default)]
pub struct Points {
    /// Where the carriers of each point of a part start.
    starts: Vec<u32>,
    carriers: Vec<(u32, f64)>,
    /// The element of each.
    pub element: Vec<u32>,
    /// What may sever them, and the lattice site of each where anything does.
    cut: Option<Cut>,
    sites: Vec<[i32; 3]>,
    /// How many sites each of a part stands for; empty where each stands for itself.
    weights: Vec<f64>,
    of_parts: usize,
    first_atom: usize,
    first_atom_node: usize,
}

/// The element of places that are no points.
const NOBODY: u32 = u32::MAX;

impl Points {
    /// Sites of parts, ascending, and all atoms, which stand for so many sites as a rule of summation says.
    pub fn new(mesh: &Solid, sites: &[(u32, [i32; 3])], summation: Summation) -> Self {
        if sites.is_empty() && mesh.atom_count() == 0 {
            return Self::default();
        }
        let mut points = Self {
            starts: vec![0],
            first_atom_node: mesh.part_nodes(),
            of_parts: sites.len(),
            element: sites.iter().map(|site| site.0).collect(),
            ..Self::default()
        };
        for &(part, local) in sites {
            let carriers = mesh.carriers(part as usize, local);
            points
                .carriers
                .extend(carriers.map(|(node, weight)| (node as u32, weight)));
            points.starts.push(points.carriers.len() as u32);
        }
        // Atoms begin where lanes do.
        points.element.resize(points.of_parts.next_multiple_of(MOST), NOBODY);
        points.first_atom = points.element.len();
        points.element.extend(mesh.parts as u32..mesh.elements.len() as u32);
        if summation == Summation::Nodal {
            let weight = |&(part, local): &(u32, [i32; 3])| site_weight(summation, mesh.elements[part as usize], local);
            points.weights = sites.iter().map(weight).collect();
        }
        if mesh.sites.cut.is_some() {
            points.cut = mesh.sites.cut;
            let of_parts = sites.iter();
            let of_parts = of_parts.map(|&(part, local)| mesh.elements[part as usize].site(local));
            points.sites.extend(of_parts);
            points.sites.resize(points.first_atom, [0; 3]);
            points
                .sites
                .extend(mesh.elements[mesh.parts..].iter().map(|atom| atom.anchor));
        }
        points
    }

    /// How many numbers there are; see [`Self::is_point`].
    pub fn len(&self) -> usize {
        self.element.len()
    }

    /// Whether there is a point of this number: a few between those of parts and the atoms are left out.
    #[inline(always)]
    pub fn is_point(&self, number: usize) -> bool {
        number < self.of_parts || number >= self.first_atom && number < self.element.len()
    }

    #[inline(always)]
    pub fn is_of_part(&self, point: usize) -> bool {
        point < self.of_parts
    }

    /// How many belong to parts; they come first.
    pub fn of_parts(&self) -> usize {
        self.of_parts
    }

    /// The number of the first atom, a multiple of [`MOST`].
    pub fn first_atom(&self) -> usize {
        self.first_atom
    }

    /// The points of consecutive elements among those of a range.
    pub fn of_elements(&self, elements: Range<usize>, points: Range<usize>) -> Range<usize> {
        let of = &self.element[points.clone()];
        let first = |element: usize| points.start + of.partition_point(|&other| (other as usize) < element);
        first(elements.start)..first(elements.end)
    }

    /// Whether a cut severs two points.
    #[inline(always)]
    pub fn are_severed(&self, point: usize, other: usize) -> bool {
        self.cut
            .is_some_and(|cut| cut.severs(self.sites[point], self.sites[other]))
    }

    /// Whether points stand for other numbers of sites than one each.
    pub fn are_weighted(&self) -> bool {
        !self.weights.is_empty()
    }

    /// How many sites a point stands for.
    #[inline(always)]
    pub fn weight(&self, point: usize) -> f64 {
        self.weights.get(point).copied().unwrap_or(1.0)
    }

    /// Nodes that carry a point of a part, and their weights.
    pub fn carriers(&self, point: usize) -> &[(u32, f64)] {
        &self.carriers[self.starts[point] as usize..self.starts[point + 1] as usize]
    }

    /// The node of an atom among the points.
    pub fn atom_node(&self, point: usize) -> usize {
        self.first_atom_node + point - self.first_atom
    }

    /// Where a point is.
    #[inline(always)]
    pub fn place(&self, point: usize, position: &Planes) -> [f64; 3] {
        if point >= self.first_atom {
            let node = self.atom_node(point);
            return [position[0][node], position[1][node], position[2][node]];
        }
        if !self.is_of_part(point) {
            return [0.0; 3];
        }
        let mut place = [0.0; 3];
        for &(node, weight) in self.carriers(point) {
            for axis in 0..3 {
                place[axis] = position[axis][node as usize].mul_add(weight, place[axis]);
            }
        }
        place
    }
}
