//! The state of a specimen in motion.

use std::ops::Range;

use crate::lanes;

/// Positions, velocities, forces and masses of the nodes, a plane (x, y) each. Units nm, ps, eV.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    pub position: [Vec<f64>; 2],
    pub velocity: [Vec<f64>; 2],
    pub force: [Vec<f64>; 2],
    /// Lumped mass, the sum of a row of the mass matrix, eV ps^2/nm^2.
    pub mass: Vec<f64>,
    /// For every triangle, whose nodes come first, the mass that couples two of its nodes over the lumped mass of one;
    /// empty where all masses are lumped. The block of a triangle is mass ((1 - 3 c) I + c 1 1^T).
    pub coupling: Vec<f64>,
    /// What a force is multiplied by to give the acceleration: the inverse of the mass, and zero where the motion is
    /// prescribed. With coupled masses the mean force of the triangle acts apart: see [`crate::integrator::kick`].
    pub mobility: [Vec<f64>; 2],
}

impl State {
    /// Nodes at rest at these positions, free to move, with lumped masses.
    pub fn at_rest(position: [Vec<f64>; 2], mass: Vec<f64>) -> Self {
        let nodes = mass.len();
        let free: Vec<f64> = mass.iter().map(|mass| 1.0 / mass).collect();
        let zeros = || [vec![0.0; nodes], vec![0.0; nodes]];
        Self {
            position,
            velocity: zeros(),
            force: zeros(),
            mass,
            coupling: Vec::new(),
            mobility: [free.clone(), free],
        }
    }

    /// Couples the masses of each triangle's nodes by this share of the lumped mass of one. All nodes become free.
    pub fn couple_masses(&mut self, coupling: Vec<f64>) {
        for (triangle, share) in coupling.iter().enumerate() {
            for node in 3 * triangle..3 * triangle + 3 {
                let mobility = 1.0 / (self.mass[node] * (1.0 - 3.0 * share));
                self.mobility.iter_mut().for_each(|plane| plane[node] = mobility);
            }
        }
        self.coupling = coupling;
    }

    pub fn nodes(&self) -> usize {
        self.mass.len()
    }

    /// All nodes, as one range.
    pub fn every_node(&self) -> [Range<usize>; 1] {
        std::array::from_fn(|_| 0..self.nodes())
    }

    /// Kinetic energy, v^T M v/2, eV.
    pub fn kinetic_energy(&self) -> f64 {
        let [energy] = lanes::sums(self.nodes(), |node| [self.kinetic_energy_of(node)]);
        energy
    }

    /// The part of a node: with coupled masses c m (sum v)^2, which the nodes of a triangle share, is c m v (sum v) of each.
    #[inline(always)]
    pub fn kinetic_energy_of(&self, node: usize) -> f64 {
        if self.coupling.is_empty() {
            let [x, y] = self.velocity.each_ref().map(|plane| plane[node]);
            return 0.5 * self.mass[node] * (x * x + y * y);
        }
        let triangle = node / 3;
        let share = self.coupling.get(triangle);
        let squared = self.velocity.iter().map(|plane| {
            let speed = plane[node];
            let coupled = share.map_or(0.0, |share| {
                let sum: f64 = plane[3 * triangle..3 * triangle + 3].iter().sum();
                share * (sum - 3.0 * speed)
            });
            speed * (speed + coupled)
        });
        0.5 * self.mass[node] * squared.sum::<f64>()
    }
}
