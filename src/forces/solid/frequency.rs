//! A bound of the highest frequency, from which the stable time step follows.
//!
//! A bond between two elements stores at most twice what its two ends would store each against a wall. So the largest
//! eigenvalue of each element's own small stiffness bounds that of the whole, as in two dimensions.

use nalgebra::{DMatrix, SymmetricEigen};

use super::Forces;
use super::nodal::{bond_count, site_weight_in_blocks};
use crate::lattice::fcc;
use crate::mesh::solid::element::{Element, Shape};

/// How finely the share of a bond is sought.
const BISECTIONS: u32 = 12;

impl Forces {
    /// Bound of the squared highest frequency with bonds as they are now, 1/ps^2: that of the crystal at rest
    /// times how much stiffer the stiffest bond is.
    pub fn squared_frequency_bound(&self, position: &super::Planes) -> f64 {
        let interaction = &self.material.interaction;
        let shortest = self.shortest_bond(position).min(self.material.spacing);
        let stiffer = interaction.curvature(shortest) / interaction.curvature(self.material.spacing);
        let stiffer = self.domain.ranks().largest(stiffer);
        let at_rest = self.frequency_at_rest.get_or_init(|| self.squared_frequency_at_rest());
        at_rest * stiffer.max(1.0)
    }

    fn squared_frequency_at_rest(&self) -> f64 {
        // Where parts border on other parts of their size alone, the ends of a bond across a face may share it unevenly.
        let is_uniform = self.interfaces.lonely.iter().all(|side| side.is_free) && self.mesh.atom_count() == 0;
        let mut sizes: Vec<i32> = self.classes.keys().map(|&(_, size)| size).collect();
        sizes.sort_unstable();
        sizes.dedup();
        let of_parts = sizes.into_iter().map(|size| self.of_block(size, is_uniform));
        let has_atoms = self.mesh.atom_count() > 0;
        let of_atoms = has_atoms.then(|| self.at_rest(Shape::Atom, 1, 2.0));
        of_parts.chain(of_atoms).fold(0.0, f64::max)
    }

    /// The largest eigenvalue of the parts of a block. A bond between two elements stores no more than (1 + t) times what one
    /// end would store against a wall and (1 + 1/t) times what the other would; t = 1 without a choice.
    fn of_block(&self, size: i32, may_choose: bool) -> f64 {
        let with = |t: f64| {
            let octahedron = self.at_rest(Shape::Octahedron, size, 1.0 + 1.0 / t);
            [self.at_rest(Shape::Low, size, 1.0 + t), octahedron]
        };
        let mut bounds = with(1.0);
        if may_choose {
            let (mut low, mut high) = (0.25, 4.0);
            for _ in 0..BISECTIONS {
                let middle = 0.5 * (low + high);
                let of = with(middle);
                if of[0].max(of[1]) < bounds[0].max(bounds[1]) {
                    bounds = of;
                }
                if of[0] < of[1] { low = middle } else { high = middle }
            }
        }
        bounds[0].max(bounds[1])
    }

    /// The largest eigenvalue of an element in the crystal at rest, bonds across faces of blocks counting so many times.
    fn at_rest(&self, shape: Shape, size: i32, across_faces: f64) -> f64 {
        let element = Element::in_block(shape, size);
        let weight = |site| site_weight_in_blocks(self.summation, size, site);
        let nodes = shape.node_count();
        let mut stiffness = DMatrix::<f64>::zeros(3 * nodes, 3 * nodes);
        let spacing = self.material.spacing;
        let interaction = &self.material.interaction;
        let is_octahedral = |site: [i32; 3]| {
            let local: [i32; 3] = site.map(|component| component.rem_euclid(size));
            (size - 1..=2 * size - 2).contains(&local.iter().sum())
        };
        let is_across_a_face = |site| shape != Shape::Atom && is_octahedral(site) != (shape == Shape::Octahedron);
        let times_of = |site| if is_across_a_face(site) { across_faces } else { 2.0 };
        for vector in fcc::half_vectors_within(interaction.cutoff() / spacing) {
            let bond = fcc::in_the_cube(vector).map(|component| component * spacing);
            let squared: f64 = bond.iter().map(|component| component * component).sum();
            let slope = interaction.evaluate(squared).slope;
            let curvature = interaction.curvature(squared.sqrt());
            let of_bond = |row: usize, column: usize| {
                let even = if row == column { slope } else { 0.0 };
                even + (curvature - slope) * bond[row] * bond[column] / squared
            };
            let mut add = |weights: &[f64], times: f64| {
                for (a, wa) in weights.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
                    for (b, wb) in weights.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
                        for (row, column) in (0..9).map(|number| (number / 3, number % 3)) {
                            stiffness[(3 * a + row, 3 * b + column)] += times * wa * wb * of_bond(row, column);
                        }
                    }
                }
            };
            for local in element.locals() {
                let own = element.shape_functions(local);
                let other = std::array::from_fn(|axis| local[axis] + vector[axis]);
                let count = bond_count([weight(local), weight(other)]);
                if element.has_local(other) {
                    let theirs = element.shape_functions(other);
                    let difference: [f64; 6] = std::array::from_fn(|node| theirs[node] - own[node]);
                    add(&difference[..nodes], count);
                } else {
                    add(&own[..nodes], count * times_of(other));
                }
                let before = std::array::from_fn(|axis| local[axis] - vector[axis]);
                if !element.has_local(before) {
                    let count = bond_count([weight(local), weight(before)]);
                    add(&own[..nodes], count * times_of(before));
                }
            }
        }
        // The masses are the same along every axis.
        let slowness = self.inverse_root_of_masses(element);
        let slowness = DMatrix::from_fn(3 * nodes, 3 * nodes, |row, column| match row % 3 == column % 3 {
            true => slowness[(row / 3, column / 3)],
            false => 0.0,
        });
        let largest = SymmetricEigen::new(&slowness * stiffness * &slowness).eigenvalues.max();
        largest / (element.lumped_mass() * self.material.site_mass)
    }

    /// The inverse of the square root of the mass matrix of an element, over that of a lumped mass.
    fn inverse_root_of_masses(&self, element: Element) -> DMatrix<f64> {
        let nodes = element.shape.node_count();
        if element.shape == Shape::Atom || self.consistent_mass == 0.0 {
            return DMatrix::identity(nodes, nodes);
        }
        let coupling = element.mass_coupling().times(self.consistent_mass);
        let own = 1.0 - nodes as f64 * coupling.share - coupling.opposite;
        let masses = DMatrix::from_fn(nodes, nodes, |row, column| {
            let even = if row == column { own } else { 0.0 };
            let opposite = if row ^ 1 == column { coupling.opposite } else { 0.0 };
            coupling.share + even + opposite
        });
        let SymmetricEigen {
            eigenvectors,
            eigenvalues,
        } = SymmetricEigen::new(masses);
        let roots = DMatrix::from_diagonal(&eigenvalues.map(|value| 1.0 / value.sqrt()));
        &eigenvectors * roots * eigenvectors.transpose()
    }

    /// The shortest bond of this rank, nm: inside parts and across intact interfaces from the bonds of classes, among points from
    /// their lists.
    fn shortest_bond(&self, position: &super::Planes) -> f64 {
        let mut least = f64::INFINITY;
        for part in self.domain.grouped() {
            let element = self.mesh.elements[part];
            let nodes: Vec<[f64; 3]> = self
                .mesh
                .nodes_of(part)
                .map(|node| position.each_ref().map(|plane| plane[node]))
                .collect();
            for class in &self.classes[&(element.shape, element.size)] {
                let (bond, _) = class.bond(element.shape, &nodes);
                least = least.min(bond.iter().map(|component| component * component).sum());
            }
        }
        if let Some(pairs) = &self.pairs {
            pairs.for_each(|_, bond| least = least.min(bond.iter().map(|component| component * component).sum()));
        }
        least.sqrt()
    }
}
