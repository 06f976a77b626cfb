//! Work, node by node, so that its sum does not depend on who moves them.

use std::ops::Range;

use crate::domain::Ranks;

/// What has been done on each of some nodes so far, eV.
#[derive(Clone, Debug, PartialEq)]
pub struct Work {
    /// Zero for nodes that other ranks move.
    of_nodes: Vec<f64>,
    /// Places in the list of the nodes that this rank moves.
    mine: Vec<u32>,
}

impl Work {
    /// On so many nodes, all of which this rank moves.
    pub fn none(nodes: usize) -> Self {
        Self {
            of_nodes: vec![0.0; nodes],
            mine: (0..nodes as u32).collect(),
        }
    }

    /// Keeps to those of the listed nodes that are in these ranges.
    pub fn keep_to(&mut self, nodes: impl Iterator<Item = u32>, ranges: &[Range<usize>]) {
        let is_mine = |node: u32| ranges.iter().any(|range| range.contains(&(node as usize)));
        let places = (0..).zip(nodes).filter(|&(_, node)| is_mine(node));
        self.mine = places.map(|(place, _)| place).collect();
    }

    /// Places in the list of the nodes that this rank moves.
    pub fn mine(&self) -> &[u32] {
        &self.mine
    }

    /// Books the work of a force (eV/nm) on the node at a place of the list that moves with a velocity (nm/ps) for a time, ps.
    #[inline(always)]
    pub fn book<const D: usize>(&mut self, place: usize, force: [f64; D], velocity: [f64; D], time: f64) {
        let power: f64 = (0..D).map(|axis| force[axis] * velocity[axis]).sum();
        self.of_nodes[place] += time * power;
    }

    /// That on all nodes, eV. All ranks must ask for it together.
    pub fn total(&self, ranks: Ranks) -> f64 {
        self.of_nodes(ranks).iter().sum()
    }

    /// That on each node. All ranks must ask for it together.
    pub fn of_nodes(&self, ranks: Ranks) -> Vec<f64> {
        ranks.merge(&self.of_nodes)
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.of_nodes.len()
    }

    pub fn is_empty(&self) -> bool {
        self.of_nodes.is_empty()
    }

    /// Goes back to what [`Self::of_nodes`] gave.
    pub fn restore(&mut self, of_nodes: &[f64]) {
        self.of_nodes.fill(0.0);
        for &place in &self.mine {
            self.of_nodes[place as usize] = of_nodes[place as usize];
        }
    }

    /// A sum over the nodes of what each of this rank's is asked for. All ranks must ask for it together.
    pub fn sum<const D: usize>(&self, ranks: Ranks, of_place: impl Fn(usize) -> [f64; D]) -> [f64; D] {
        let mut terms = vec![[0.0; D]; self.of_nodes.len()];
        for &place in &self.mine {
            terms[place as usize] = of_place(place as usize);
        }
        let all = ranks.merge(terms.as_flattened());
        let mut sum = [0.0; D];
        for term in all.as_chunks::<D>().0 {
            (0..D).for_each(|axis| sum[axis] += term[axis]);
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rank_books_and_restores_the_work_on_its_own_nodes() {
        let mut work = Work::none(4);
        work.keep_to([7, 3, 12, 9].into_iter(), &[5..10, 20..30]);
        assert_eq!(work.mine(), [0, 3]);
        work.book(3, [2.0, 0.5], [1.0, -2.0], 0.5);
        assert_eq!(work.of_nodes(Ranks::alone()), [0.0, 0.0, 0.0, 0.5]);
        work.restore(&[1.0, 2.0, 3.0, 4.0]);
        assert_eq!(work.total(Ranks::alone()), 5.0);
        let sum = work.sum(Ranks::alone(), |place| [place as f64, 1.0]);
        assert_eq!(sum, [3.0, 2.0]);
    }
}
