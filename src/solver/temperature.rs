//! How hot the atoms are.

use std::collections::HashMap;

use rayon::prelude::*;

use crate::mesh::Mesh;
use crate::state::State;

/// Boltzmann's constant, eV/K.
const BOLTZMANN: f64 = crate::units::BOLTZMANN_EV_PER_K;

/// Atoms along each side of the cells over which the local velocity is averaged.
const CELL: i32 = 8;

/// Runs in one parallel task.
const TASK: usize = 512;

/// The atoms that are not in the grips, by cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Thermometer {
    /// First node, number of nodes and cell of atoms that follow each other in one cell.
    runs: Vec<[u32; 3]>,
    /// How many atoms each cell holds.
    cells: Vec<f64>,
}

impl Thermometer {
    pub fn new(mesh: &Mesh) -> Self {
        let mut thermometer = Self {
            runs: Vec::new(),
            cells: Vec::new(),
        };
        let mut number_of: HashMap<[i32; 2], u32> = HashMap::new();
        let mut last = [i32::MAX; 2];
        for (element, atom) in mesh.elements.iter().enumerate().skip(mesh.triangles) {
            if mesh.grip_of(atom) != 0 {
                continue;
            }
            let node = mesh.node(element, 0) as u32;
            let key = [atom.column, atom.row].map(|coordinate| coordinate.div_euclid(CELL));
            let cell = match thermometer.runs.last_mut() {
                Some([first, count, cell]) if key == last && *first + *count == node => {
                    *count += 1;
                    *cell
                }
                _ => {
                    let next = number_of.len() as u32;
                    let cell = *number_of.entry(key).or_insert(next);
                    thermometer.runs.push([node, 1, cell]);
                    thermometer.cells.resize(number_of.len(), 0.0);
                    cell
                }
            };
            thermometer.cells[cell as usize] += 1.0;
            last = key;
        }
        thermometer
    }

    /// Kinetic temperature, K: the motion relative to the local velocity field, [Deng2011] Eq. (3-22) with two directions
    /// instead of three. NaN where there are no atoms.
    pub fn read(&self, state: &State) -> f64 {
        let Some(&[first, ..]) = self.runs.first() else {
            return f64::NAN;
        };
        let [x, y] = &state.velocity;
        let of_run = |&[first, count, _]: &[u32; 3]| {
            let nodes = first as usize..(first + count) as usize;
            nodes.fold([0.0; 3], |[sum_x, sum_y, squared], node| {
                let [x, y] = [x[node], y[node]];
                [sum_x + x, sum_y + y, squared + x * x + y * y]
            })
        };
        let sums: Vec<[f64; 3]> = self.runs.par_iter().with_min_len(TASK).map(of_run).collect();
        let mut means = vec![[0.0; 2]; self.cells.len()];
        let mut squared = 0.0;
        for (&[_, _, cell], [sum_x, sum_y, of_run]) in self.runs.iter().zip(sums) {
            let [x, y] = &mut means[cell as usize];
            *x += sum_x;
            *y += sum_y;
            squared += of_run;
        }
        let mut freedom = 0.0;
        for (atoms, [x, y]) in self.cells.iter().zip(means) {
            squared -= (x * x + y * y) / atoms;
            freedom += 2.0 * (atoms - 1.0);
        }
        if freedom > 0.0 {
            state.mass[first as usize] * squared.max(0.0) / (freedom * BOLTZMANN)
        } else {
            f64::NAN
        }
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
            crack: None,
            grip_rows: 10,
            spacing: 1.0,
        };
        let mesh = Mesh::new(&plan);
        let mut state = State::at_rest(mesh.node_positions(), vec![2.0; mesh.node_count()]);
        state.velocity = [vec![3.0; mesh.node_count()], vec![-1.0; mesh.node_count()]];
        assert!(Thermometer::new(&mesh).read(&state).abs() < 1e-9);
        let mut sign = 1.0;
        for node in 0..mesh.node_count() {
            state.velocity[0][node] += sign;
            sign = -sign;
        }
        // Half a degree of freedom in two carries mass/2 each: T = m / (2 k_B), less what the cells' means take away.
        let expected = 2.0 / (2.0 * BOLTZMANN);
        let found = Thermometer::new(&mesh).read(&state);
        assert!((found / expected - 1.0).abs() < 0.05, "{found} for {expected}");
        let coarse = Mesh::new(&Plan { element: 10, ..plan });
        let state = State::at_rest(coarse.node_positions(), vec![1.0; coarse.node_count()]);
        assert!(Thermometer::new(&coarse).read(&state).is_nan());
    }
}
