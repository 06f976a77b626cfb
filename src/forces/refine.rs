//! Where triangles are too coarse for what they carry, and the forces on a mesh in which some have become atoms.

use rayon::prelude::*;

use super::affine::Affine;
use super::interface::{Pair, State};
use super::{CHUNK, Forces, Planes};
use crate::lattice::triangular;
use crate::mesh::Mesh;

impl Forces {
    /// For every triangle how far its strain may be off, over what its bonds have left before they give way: the largest
    /// difference |F - F'| between its deformation gradient and that of a triangle along one of its edges, over the critical
    /// strain less the largest strain of a nearest-neighbour bond in either and between them. A linear interpolation is off by
    /// about half of the difference to the next element. Infinite where a bond has nothing left or an interface has opened.
    /// An even strain has no error, nor has a triangle on whose edges nothing but atoms, faces and grips border.
    ///
    /// It depends on nothing but the positions, which must be those of the last forces, and on which interfaces are open. All
    /// ranks must ask for it together, and get the same.
    pub fn strain_errors(&self, position: &Planes) -> Vec<f64> {
        let critical = self.material.critical_strain();
        let numbers = (0..self.interfaces.pairs.len()).into_par_iter().with_min_len(CHUNK);
        let of_interfaces: Vec<f64> = numbers
            .map(|number| self.error_across(number, critical, position))
            .collect();
        let mine = self.domain.grouped().into_par_iter().with_min_len(CHUNK);
        let of_triangle = |triangle: usize| {
            let errors = self.interfaces.of(triangle).iter();
            errors.map(|&place| of_interfaces[place as usize]).fold(0.0, f64::max)
        };
        let mut errors = vec![0.0; self.mesh.triangles];
        mine.clone()
            .map(of_triangle)
            .zip(&mut errors[self.domain.grouped()])
            .for_each(|(found, error)| *error = found);
        self.domain.share_grouped(&mut errors);
        errors
    }

    /// What [`Self::strain_errors`] says of an interface.
    fn error_across(&self, number: usize, critical: f64, position: &Planes) -> f64 {
        let pair = self.interfaces.pairs[number];
        // What the grips hold has the strain that they give it.
        let is_held = |triangle: u32| self.mesh.grip_of(&self.mesh.elements[triangle as usize]) != 0;
        if pair.severed || pair.both().into_iter().any(is_held) {
            return 0.0;
        }
        if self.states[number] == State::Open {
            return f64::INFINITY;
        }
        let nearest = |bond: [i32; 2]| triangular::squared_length(bond) == 1;
        let strings = || {
            self.interfaces
                .strings(number)
                .iter()
                .filter(|string| nearest(string.bond))
        };
        // At a corner there is one bond.
        if strings().all(|string| string.count < 2) {
            return 0.0;
        }
        let spacing = self.mesh.spacing;
        let both = pair.both().map(|triangle| {
            let map = Affine::of_triangle(&self.mesh, triangle as usize, position);
            let gradient = map.deformation_gradient(self.mesh.elements[triangle as usize].sign, spacing);
            (map, gradient)
        });
        let inside = both
            .iter()
            .flat_map(|(map, _)| [[1, 0], [0, 1], [-1, 1]].map(|bond| map.vector(bond)));
        let across = Pair::new(&self.mesh, &self.interfaces, number, position);
        let between = strings().flat_map(|string| {
            let [start, change] = across.string_vectors(string);
            let last = f64::from(string.count - 1);
            [start, [start[0] + last * change[0], start[1] + last * change[1]]]
        });
        let longest = inside.chain(between).map(|[x, y]| x * x + y * y).fold(0.0, f64::max);
        let left = critical - (longest.sqrt() / spacing - 1.0);
        let [(_, one), (_, other)] = both;
        let differences = one
            .iter()
            .flatten()
            .zip(other.iter().flatten())
            .map(|(a, b)| (a - b) * (a - b));
        match left > 0.0 {
            true => differences.sum::<f64>().sqrt() / left,
            // Also where the positions are not numbers.
            false => f64::INFINITY,
        }
    }

    /// Goes over to another mesh of the same sites, in which no interface is open but those that a cut severs. All ranks must
    /// know the state of all nodes.
    pub fn go_over_to(&mut self, mesh: Mesh) {
        let next = Self::shared(self.domain.ranks(), mesh, self.material, self.summation);
        let before = std::mem::replace(self, next);
        self.domain.hear_after(&before.domain);
        self.first_cut = before.first_cut;
        self.close_bonds = before.close_bonds;
        (self.searches, self.search_time) = (before.searches, before.search_time);
        (self.exchanges, self.exchange_time) = (before.exchanges, before.exchange_time);
        self.spent = before.spent;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Material;
    use crate::mesh::Plan;
    use crate::mesh::sites::Layout;
    use crate::potential::{AtCutoff, CutPotential, Interaction, LennardJones};

    /// The strain of the elements differs by so little that only the even part takes from what bonds have left.
    const SMALL: f64 = 1e-8;

    /// Six rows of triangles, the lowest and the highest held, stretched upwards by this and by a part that grows with height.
    fn bent(even: f64) -> (Forces, Planes) {
        let shape = LennardJones {
            epsilon: 1.0,
            sigma: 1.0,
        };
        let law = CutPotential::new(shape, 1.5, AtCutoff::Truncated);
        let material = Material::new(Interaction::LennardJones(law), 1.0).expect("the potential binds");
        let mesh = Mesh::new(&Plan {
            layout: Layout {
                block: 10,
                rows: 6,
                triangles: 9,
            },
            element: 10,
            regions: vec![],
            crack: None,
            grip_rows: 10,
            spacing: material.spacing,
        });
        let mut position = mesh.node_positions();
        for y in &mut position[1] {
            *y += even * *y + 0.5 * SMALL * *y * *y;
        }
        (Forces::new(mesh, material), position)
    }

    #[test]
    fn the_error_of_a_strain_is_its_change_to_the_next_element_over_what_bonds_have_left() {
        for even in [0.0, 0.02] {
            let (forces, position) = bent(even);
            // Elements above each other are ten rows apart, those side by side are strained alike.
            let change = SMALL * 10.0 * 0.75f64.sqrt() * forces.mesh.spacing;
            // Bonds at 60 degrees are the longest.
            let longest = (0.25 + 0.75 * (1.0 + even) * (1.0 + even)).sqrt() - 1.0;
            let expected = change / (forces.material.critical_strain() - longest);
            let errors = forces.strain_errors(&position);
            // Some of the rows beside those in the grips border on these alone.
            let inner = |triangle: &usize| (20..40).contains(&forces.mesh.elements[*triangle].lowest_row());
            for triangle in (0..forces.mesh.triangles).filter(inner) {
                let error = errors[triangle];
                assert!(
                    (error / expected - 1.0).abs() < 1e-4,
                    "{triangle}: {error} for {expected}"
                );
            }
        }
    }

    #[test]
    fn what_has_no_strength_left_has_an_infinite_error() {
        let (forces, position) = bent(0.5);
        assert!(forces.strain_errors(&position).iter().any(|error| error.is_infinite()));
    }
}
