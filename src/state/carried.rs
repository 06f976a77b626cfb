//! A state on the next mesh of its specimen.

use super::State;
use crate::mesh::Mesh;

impl State {
    /// This state on another mesh of the same sites, in which every element is one of `from` or an atom of one, and triangles
    /// have a share of the consistent mass matrix. All nodes are free, and there are no forces yet.
    ///
    /// An atom comes to be where the shape functions of its triangle carry it, x_a = sum_i N_i(a) x_i, and as fast,
    /// [Deng2011] Eq. (3-27). Mass and momentum are kept: sum_a m N_i(a) is the lumped mass of node i. With the consistent mass
    /// matrix M_ij = sum_a m N_i(a) N_j(a), kinetic energy and angular momentum are kept too, as 1/2 sum_a m v_a v_a =
    /// 1/2 sum_ij M_ij v_i v_j, and as sum_a m x_a x v_a = sum_ij M_ij x_i x v_j. Lumped masses keep neither: a triangle of ten
    /// atoms an edge then has three times the moment of inertia I of its atoms, and these would need three times the energy,
    /// L^2/(2 I), to turn with its angular momentum L.
    pub fn carried(&self, from: &Mesh, to: &Mesh, site_mass: f64, consistent: f64) -> Self {
        let mut next = Self::of_mesh(to, site_mass, consistent);
        let mut owner = None;
        for (number, element) in to.elements.iter().enumerate() {
            for (node, site) in to.nodes_of(number).zip(element.corners()) {
                owner = from.owner_beside(site, owner);
                let Some(carrier) = owner else { continue };
                let shares = from.elements[carrier].shape_functions(from.elements[carrier].local(site));
                let planes = [
                    (&self.position, &mut next.position),
                    (&self.velocity, &mut next.velocity),
                ];
                for (before, after) in planes {
                    for (before, after) in before.iter().zip(after) {
                        let nodes = from.nodes_of(carrier).zip(shares);
                        after[node] = nodes.map(|(node, share)| share * before[node]).sum();
                    }
                }
            }
        }
        next
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Plan;
    use crate::mesh::sites::Layout;

    /// Rounding of sums over some thousand atoms.
    const ROUNDING: f64 = 1e-12;
    const SITE_MASS: f64 = 0.3;

    /// Mass, momentum, angular momentum and kinetic energy of everything.
    fn totals(mesh: &Mesh, state: &State) -> [f64; 5] {
        let mut sums = [0.0; 5];
        sums[4] = state.kinetic_energy();
        for (number, element) in mesh.elements.iter().enumerate() {
            for local in element.locals() {
                let shares = element.shape_functions(local);
                let carried = |planes: &[Vec<f64>; 2]| {
                    planes.each_ref().map(|plane| {
                        let nodes = mesh.nodes_of(number).zip(shares);
                        nodes.map(|(node, share)| share * plane[node]).sum::<f64>()
                    })
                };
                let ([x, y], [u, v]) = (carried(&state.position), carried(&state.velocity));
                let terms = [1.0, u, v, x * v - y * u].map(|term| SITE_MASS * term);
                sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
            }
        }
        sums
    }

    #[test]
    fn mass_momentum_angular_momentum_and_kinetic_energy_outlive_refinement() {
        // [Deng2011] Eq. (3-27) and Eq. (3-29)
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
            spacing: 1.0,
        });
        let mut state = State::of_mesh(&mesh, SITE_MASS, 1.0);
        // It rotates and stretches, and every node has a motion of its own.
        for node in 0..state.nodes() {
            let [x, y] = [0, 1].map(|axis| state.position[axis][node]);
            let own = (node as f64 * 12.9898).sin();
            state.position[0][node] += 0.02 * own;
            state.velocity[0][node] = -0.3 * y + 0.05 * x + 0.1 * own;
            state.velocity[1][node] = 0.3 * x - 0.02 * y - 0.1 * own;
        }
        let refined: Vec<u32> = (0..mesh.triangles as u32).filter(|number| number % 3 != 1).collect();
        let finer = mesh.refined(&refined);
        let next = state.carried(&mesh, &finer, SITE_MASS, 1.0);
        let (before, after) = (totals(&mesh, &state), totals(&finer, &next));
        for (before, after) in before.iter().zip(after) {
            let scale = before.abs().max(1.0);
            assert!((after - before).abs() < ROUNDING * scale, "{before} {after}");
        }
        // Lumped masses would lose of both.
        let lumped = State {
            coupled: Vec::new(),
            ..state.clone()
        };
        assert!(lumped.kinetic_energy() > before[4] * (1.0 + 1e-4));
    }

    #[test]
    fn what_stays_an_element_keeps_its_state_to_the_bit() {
        let mesh = Mesh::new(&Plan {
            layout: Layout {
                block: 5,
                rows: 4,
                triangles: 5,
            },
            element: 5,
            regions: vec![],
            crack: None,
            grip_rows: 5,
            spacing: 0.25,
        });
        let mut state = State::of_mesh(&mesh, SITE_MASS, 0.0);
        (0..state.nodes()).for_each(|node| state.velocity[1][node] = (node as f64).sqrt());
        let finer = mesh.refined(&[2]);
        let next = state.carried(&mesh, &finer, SITE_MASS, 0.0);
        for (number, &before) in mesh.left_by(&[2]).iter().enumerate() {
            for (node, old) in finer.nodes_of(number).zip(mesh.nodes_of(before as usize)) {
                assert_eq!(next.position[0][node].to_bits(), state.position[0][old].to_bits());
                assert_eq!(next.velocity[1][node].to_bits(), state.velocity[1][old].to_bits());
            }
        }
    }
}
