//! How hot the atoms are.

use std::collections::HashMap;

use rayon::prelude::*;

use crate::state::State;

/// Boltzmann's constant, eV/K.
const BOLTZMANN: f64 = crate::units::BOLTZMANN_EV_PER_K;

/// Atoms along each side of the cells over which the local velocity is averaged.
const CELL: i32 = 8;

/// Runs in one parallel task.
const TASK: usize = 512;

/// Atoms by cells of the lattice.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Thermometer {
    /// First node, number of nodes and cell of atoms that follow each other in one cell.
    runs: Vec<[u32; 3]>,
    /// How many atoms each cell holds.
    cells: Vec<f64>,
    /// Of an atom, eV ps^2/nm^2.
    mass: f64,
}

impl Thermometer {
    /// Of atoms by rising node, each of this mass: nodes and lattice sites.
    pub fn new<const D: usize>(atoms: impl Iterator<Item = (usize, [i32; D])>, mass: f64) -> Self {
        let mut thermometer = Self {
            mass,
            ..Self::default()
        };
        let mut number_of: HashMap<[i32; D], u32> = HashMap::new();
        let mut last = [i32::MAX; D];
        for (node, site) in atoms {
            let node = node as u32;
            let key = site.map(|coordinate| coordinate.div_euclid(CELL));
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

    /// Kinetic temperature, K: the motion relative to the local velocity field, [Deng2011] Eq. (3-22) with as many directions
    /// as there are. NaN where there are no atoms.
    pub fn read<const D: usize>(&self, state: &State<D>) -> f64 {
        if self.runs.is_empty() {
            return f64::NAN;
        }
        let of_run = |&[first, count, _]: &[u32; 3]| {
            let (mut sums, mut squared) = ([0.0; D], 0.0);
            for node in first as usize..(first + count) as usize {
                for (sum, plane) in sums.iter_mut().zip(&state.velocity) {
                    let speed = plane[node];
                    *sum += speed;
                    squared += speed * speed;
                }
            }
            (sums, squared)
        };
        let of_runs: Vec<([f64; D], f64)> = self.runs.par_iter().with_min_len(TASK).map(of_run).collect();
        let mut means = vec![[0.0; D]; self.cells.len()];
        let mut squared = 0.0;
        for (&[_, _, cell], (sums, of_run)) in self.runs.iter().zip(of_runs) {
            let mean = &mut means[cell as usize];
            (0..D).for_each(|axis| mean[axis] += sums[axis]);
            squared += of_run;
        }
        let mut freedom = 0.0;
        for (atoms, mean) in self.cells.iter().zip(means) {
            squared -= mean.iter().map(|sum| sum * sum).sum::<f64>() / atoms;
            freedom += D as f64 * (atoms - 1.0);
        }
        if freedom > 0.0 {
            self.mass * squared.max(0.0) / (freedom * BOLTZMANN)
        } else {
            f64::NAN
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cube of atoms, or a square, and a state in which none moves.
    fn atoms<const D: usize>(edge: i32) -> (Thermometer, State<D>) {
        let count = (edge as usize).pow(D as u32);
        let sites = (0..count).map(|node| {
            let mut rest = node as i32;
            let site: [i32; D] = std::array::from_fn(|_| {
                let along = rest % edge;
                rest /= edge;
                along
            });
            (node, site)
        });
        let places = std::array::from_fn(|_| vec![0.0; count]);
        (Thermometer::new(sites, 2.0), State::at_rest(places, vec![2.0; count]))
    }

    fn rigid_motion_is_cold_and_random_motion_has_the_temperature_of_its_energy<const D: usize>() {
        let (thermometer, mut state) = atoms::<D>(20);
        state.velocity.iter_mut().for_each(|plane| plane.fill(3.0));
        assert!(thermometer.read(&state).abs() < 1e-9);
        let mut sign = 1.0;
        for speed in &mut state.velocity[0] {
            *speed += sign;
            sign = -sign;
        }
        // One degree of freedom in D carries mass/2: T = m / (D k_B), less what the means of the cells take away.
        let expected = 2.0 / (D as f64 * BOLTZMANN);
        let found = thermometer.read(&state);
        assert!((found / expected - 1.0).abs() < 0.05, "{found} for {expected}");
    }

    #[test]
    fn rigid_motion_has_no_temperature_and_random_motion_has_that_of_its_energy() {
        // [Deng2011] Eq. (3-22)
        rigid_motion_is_cold_and_random_motion_has_the_temperature_of_its_energy::<2>();
        rigid_motion_is_cold_and_random_motion_has_the_temperature_of_its_energy::<3>();
        let nobody = std::iter::empty::<(usize, [i32; 3])>();
        assert!(Thermometer::new(nobody, 2.0).read(&atoms::<3>(2).1).is_nan());
    }
}
