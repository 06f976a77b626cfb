use std::ops::Range;

use crate::domain::Ranks;
use crate::state::State;

/// With what impulse the specimen has pulled at the grips so far, node by node: each node has its own sum, so that the work
/// does not depend on which rank moves it.
#[derive(Clone, Debug, PartialEq)]
pub struct Impulse {
    /// Places in the list of held nodes and numbers of the nodes that this rank moves.
    mine: Vec<(u32, u32)>,
    /// eV ps/nm along y for every held node; zero for those of other ranks.
    of_held: Vec<f64>,
}

impl Impulse {
    /// Of held nodes; `nodes` are those that this rank moves.
    pub fn new(held: impl Iterator<Item = u32> + Clone, nodes: &[Range<usize>]) -> Self {
        let is_mine = |node: u32| nodes.iter().any(|range| range.contains(&(node as usize)));
        let places = (0..).zip(held.clone());
        Self {
            mine: places.filter(|&(_, node)| is_mine(node)).collect(),
            of_held: vec![0.0; held.count()],
        }
    }

    /// Adds that of the present forces over a time, ps.
    pub fn add(&mut self, state: &State, time: f64) {
        for &(place, node) in &self.mine {
            self.of_held[place as usize] += time * state.force[1][node as usize];
        }
    }

    /// Those of all ranks, which must call this together.
    pub fn gathered(&self, ranks: Ranks) -> Vec<f64> {
        ranks.merge(&self.of_held)
    }

    /// Goes back to what [`Self::gathered`] gave.
    pub fn restore(&mut self, of_held: &[f64]) {
        for &(place, _) in &self.mine {
            self.of_held[place as usize] = of_held[place as usize];
        }
    }
}
