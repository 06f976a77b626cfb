//! The state of a specimen in motion.

/// Positions, velocities, forces and masses of the nodes, a plane (x, y) each. Units nm, ps, eV.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    pub position: [Vec<f64>; 2],
    pub velocity: [Vec<f64>; 2],
    pub force: [Vec<f64>; 2],
    /// Lumped mass, eV ps^2/nm^2.
    pub mass: Vec<f64>,
    /// What a force is multiplied by to give the acceleration: the inverse of the mass, and zero where the motion is
    /// prescribed.
    pub mobility: [Vec<f64>; 2],
}

impl State {
    /// Nodes at rest at these positions, free to move.
    pub fn at_rest(position: [Vec<f64>; 2], mass: Vec<f64>) -> Self {
        let nodes = mass.len();
        let free: Vec<f64> = mass.iter().map(|mass| 1.0 / mass).collect();
        let zeros = || [vec![0.0; nodes], vec![0.0; nodes]];
        Self { position, velocity: zeros(), force: zeros(), mass, mobility: [free.clone(), free] }
    }

    pub fn nodes(&self) -> usize {
        self.mass.len()
    }

    /// Kinetic energy of the lumped masses, eV.
    pub fn kinetic_energy(&self) -> f64 {
        let [x, y] = &self.velocity;
        let squared = x.iter().zip(y).zip(&self.mass).map(|((x, y), mass)| mass * (x * x + y * y));
        0.5 * squared.sum::<f64>()
    }
}
