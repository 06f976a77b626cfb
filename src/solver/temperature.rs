use std::collections::HashMap;

use crate::mesh::Mesh;
use crate::state::State;

/// Boltzmann's constant, eV/K.
const BOLTZMANN: f64 = crate::units::BOLTZMANN_EV_PER_K;

/// Atoms along each side of the cells over which the local velocity is averaged.
const CELL: i32 = 8;

/// Kinetic temperature of the atoms that are not in the grips, K: the motion relative to the local velocity field,
/// [Deng2011] Eq. (3-22) with two directions instead of three. NaN where there are no atoms.
pub fn kinetic_temperature(mesh: &Mesh, state: &State) -> f64 {
    #[derive(Default)]
    struct Cell {
        atoms: f64,
        mean: [f64; 2],
        squared: f64,
    }
    let mut cells: Vec<Cell> = Vec::new();
    let mut number_of: HashMap<[i32; 2], usize> = HashMap::new();
    // Atoms that follow each other mostly share a cell.
    let mut last = ([i32::MAX; 2], 0);
    let mut mass = 0.0;
    for element in mesh.triangles..mesh.elements.len() {
        let atom = &mesh.elements[element];
        if mesh.grip_of(atom) != 0 {
            continue;
        }
        let node = mesh.first_node(element);
        mass = state.mass[node];
        let key = [atom.column, atom.row].map(|coordinate| coordinate.div_euclid(CELL));
        if key != last.0 {
            last = (key, *number_of.entry(key).or_insert(cells.len()));
            cells.resize_with(number_of.len(), Cell::default);
        }
        let cell = &mut cells[last.1];
        let velocity = [state.velocity[0][node], state.velocity[1][node]];
        cell.atoms += 1.0;
        (0..2).for_each(|axis| cell.mean[axis] += velocity[axis]);
        cell.squared += velocity[0] * velocity[0] + velocity[1] * velocity[1];
    }
    let [mut squared, mut freedom] = [0.0; 2];
    for cell in cells {
        squared += cell.squared - (cell.mean[0] * cell.mean[0] + cell.mean[1] * cell.mean[1]) / cell.atoms;
        freedom += 2.0 * (cell.atoms - 1.0);
    }
    if freedom > 0.0 {
        mass * squared.max(0.0) / (freedom * BOLTZMANN)
    } else {
        f64::NAN
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Plan;
    use crate::mesh::sites::Layout;

    #[test]
    fn rigid_motion_has_no_temperature_and_random_motion_has_that_of_its_energy() {
        // [Deng2011] Eq. (3-22)
        let layout = Layout {
            block: 10,
            rows: 6,
            triangles: 11,
        };
        let plan = Plan {
            layout,
            element: 1,
            regions: vec![],
            crack_length: None,
            grip_rows: 10,
            spacing: 1.0,
        };
        let mesh = Mesh::new(&plan);
        let mut state = State::at_rest(mesh.node_positions(), vec![2.0; mesh.node_count()]);
        state.velocity = [vec![3.0; mesh.node_count()], vec![-1.0; mesh.node_count()]];
        assert!(kinetic_temperature(&mesh, &state).abs() < 1e-9);
        let mut sign = 1.0;
        for node in 0..mesh.node_count() {
            state.velocity[0][node] += sign;
            sign = -sign;
        }
        // Half a degree of freedom in two carries mass/2 each: T = m / (2 k_B), less what the cells' means take away.
        let expected = 2.0 / (2.0 * BOLTZMANN);
        let found = kinetic_temperature(&mesh, &state);
        assert!((found / expected - 1.0).abs() < 0.05, "{found} for {expected}");
        let coarse = Mesh::new(&Plan { element: 10, ..plan });
        let state = State::at_rest(coarse.node_positions(), vec![1.0; coarse.node_count()]);
        assert!(kinetic_temperature(&coarse, &state).is_nan());
    }
}
