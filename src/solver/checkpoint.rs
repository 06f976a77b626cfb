//! Everything a run needs to go on, bit for bit, as if it had never stopped.

use std::array;

use super::slab::Kept;

/// State of a run between two steps. Internal units (nm, ps, eV).
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint<K = Kept, const D: usize = 2> {
    /// Steps taken.
    pub step: u64,
    /// Simulated time, ps.
    pub time: f64,
    /// Time step in force, ps.
    pub time_step: f64,
    /// The time step after the next one, ps.
    pub step_after_next: f64,
    /// An automatic time step is never longer, ps.
    pub longest_step: f64,
    /// Bound of the time step when it was last looked at, ps.
    pub stability_limit: f64,
    /// Node positions, an axis after the other, nm; each of length `nodes`.
    pub position: [Vec<f64>; D],
    /// Node velocities at the same time, nm/ps.
    pub velocity: [Vec<f64>; D],
    /// Interfaces that have left the intact path, ascending.
    pub open_interfaces: Vec<u32>,
    /// Potential energy (eV), pairs within the cutoff and kinetic energy (eV) when the motion began.
    pub start: [f64; 3],
    /// What the mesh has gained of energy where it was refined, eV.
    pub refined_energy: f64,
    /// Largest |work| and largest energy imbalance seen, eV.
    pub peak_work: f64,
    pub peak_imbalance: f64,
    /// See [`super::Body::closest_approach`].
    pub closest_approach: f64,
    /// Number of probes and snapshots written so far.
    pub probes: u64,
    pub snapshots: u64,
    /// How often it was looked whether the mesh is fine enough.
    pub looks: u64,
    /// What the loading has done and the instruments have seen.
    pub kept: K,
}

impl<K: Default, const D: usize> Default for Checkpoint<K, D> {
    fn default() -> Self {
        Self {
            step: 0,
            time: 0.0,
            time_step: 0.0,
            step_after_next: 0.0,
            longest_step: 0.0,
            stability_limit: 0.0,
            position: array::from_fn(|_| Vec::new()),
            velocity: array::from_fn(|_| Vec::new()),
            open_interfaces: Vec::new(),
            start: [0.0; 3],
            refined_energy: 0.0,
            peak_work: 0.0,
            peak_imbalance: 0.0,
            closest_approach: f64::INFINITY,
            probes: 0,
            snapshots: 0,
            looks: 0,
            kept: K::default(),
        }
    }
}
