//! Work, node by node, so that its sum does not depend on who moves them.

use crate::domain::Ranks;

/// What has been done on each of some nodes so far, eV.
#[derive(Clone, Debug, PartialEq)]
pub struct Work(Vec<f64>);

impl Work {
    pub fn none(nodes: usize) -> Self {
        Self(vec![0.0; nodes])
    }

    /// Books the work of a force (eV/nm) on the node at a place of the list that moves with a velocity (nm/ps) for a time, ps.
    #[inline(always)]
    pub fn book<const D: usize>(&mut self, place: usize, force: [f64; D], velocity: [f64; D], time: f64) {
        let power: f64 = (0..D).map(|axis| force[axis] * velocity[axis]).sum();
        self.0[place] += time * power;
    }

    /// That on all nodes, eV. All ranks must ask for it together.
    pub fn total(&self, ranks: Ranks) -> f64 {
        ranks.merge(&self.0).iter().sum()
    }

    /// That on each node.
    pub fn of_nodes(&self) -> &[f64] {
        &self.0
    }

    /// Goes back to what [`Self::of_nodes`] gave.
    pub fn restore(&mut self, of_nodes: &[f64]) {
        self.0.copy_from_slice(of_nodes);
    }
}
