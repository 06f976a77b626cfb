//! Everything a run needs to go on, bit for bit, as if it had never stopped.

use std::mem::swap;

use crate::analysis::series::BondEvent;
use crate::state::State;

/// State of a run between two steps. Internal units (nm, ps, eV).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checkpoint {
    /// Steps taken.
    pub step: u64,
    /// Simulated time, ps.
    pub time: f64,
    /// Time step in force, ps.
    pub time_step: f64,
    /// Bound of the time step when it was last looked at, ps.
    pub stability_limit: f64,
    /// Node positions, x then y, nm; each of length `nodes`.
    pub position: [Vec<f64>; 2],
    /// Node velocities at the same time, nm/ps.
    pub velocity: [Vec<f64>; 2],
    /// Interfaces that have left the intact path, ascending.
    pub open_interfaces: Vec<u32>,
    /// Potential energy (eV), pairs within the cutoff and kinetic energy (eV) when the motion began.
    pub start: [f64; 3],
    /// Impulse with which every node in the grips was pulled so far, the lower grip first, eV ps/nm.
    pub grip_impulses: Vec<f64>,
    /// Kinetic energy that the sponges have taken from each of their elements so far, eV.
    pub absorbed: Vec<f64>,
    /// Largest |work| and largest energy imbalance seen, eV.
    pub peak_work: f64,
    pub peak_imbalance: f64,
    /// Bonds broken at the last probe, ascending (column, row, direction).
    pub broken_bonds: Vec<[i32; 3]>,
    /// Bonds that the crack had parted by then, also where its faces touch, with the probes at which they broke, ascending
    /// (column, row, direction).
    pub parted_bonds: Vec<BondEvent>,
    /// The probes at which the crack joined one ahead of it.
    pub joins: Vec<u32>,
    /// Number of probes and snapshots written so far.
    pub probes: u64,
    pub snapshots: u64,
    /// Time at which the crack or the damage ahead of it last advanced, ps, the farthest tip and the front of the damage in the
    /// frame of the crack, nm; for the stop at arrest.
    pub last_advance: f64,
    pub farthest_tip: f64,
    pub damage_front: f64,
    /// When the crack first had a branch, ps, if the run is to end after it; infinite otherwise.
    pub branched: f64,
    /// When the crack left its plane, ps; infinite as long as it keeps to it.
    pub left_plane: f64,
}

impl Checkpoint {
    /// Exchanges positions and velocities with a state.
    pub(super) fn lend(&mut self, state: &mut State) {
        swap(&mut self.position, &mut state.position);
        swap(&mut self.velocity, &mut state.velocity);
    }
}
