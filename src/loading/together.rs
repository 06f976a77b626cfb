//! Several actions on one specimen.

use std::ops::Range;

use super::{Act, Action, Load};
use crate::domain::Ranks;
use crate::state::State;

/// Actions that stand beside each other, each with a name of its own.
pub struct Together<const D: usize>(Vec<(String, Box<dyn Action<D>>)>);

impl<const D: usize> Together<D> {
    pub fn new(actions: Vec<(String, Box<dyn Action<D>>)>) -> Self {
        Self(actions)
    }

    /// Force of each on the specimen, eV/nm. All ranks must ask for it together.
    pub fn pulls(&self, state: &State<D>, ranks: Ranks) -> Vec<[f64; D]> {
        self.0.iter().map(|(_, action)| action.pull(state, ranks)).collect()
    }

    /// Keeps to the nodes that a rank moves, those in these ranges.
    pub fn keep_to(&mut self, nodes: &[Range<usize>]) {
        self.0.iter_mut().for_each(|(_, action)| action.keep_to(nodes));
    }

    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|(name, _)| name.as_str())
    }

    /// What each does, with its name.
    pub fn acts(&self) -> impl Iterator<Item = (&str, Act<D>)> {
        self.0.iter().map(|(name, action)| (name.as_str(), action.act()))
    }

    /// What each has booked on each of its nodes, one after the other, eV. All ranks must ask for it together.
    pub fn booked(&self, ranks: Ranks) -> Vec<f64> {
        let actions = self.0.iter();
        actions
            .flat_map(|(_, action)| action.booked().of_nodes(ranks))
            .collect()
    }

    /// On how many nodes they act, one after the other.
    pub fn node_count(&self) -> usize {
        self.0.iter().map(|(_, action)| action.booked().len()).sum()
    }

    /// Goes back to what [`Self::booked`] gave.
    pub fn restore(&mut self, booked: &[f64]) {
        let mut rest = booked;
        for (_, action) in &mut self.0 {
            let (own, others) = rest.split_at(action.booked().len());
            action.booked_mut().restore(own);
            rest = others;
        }
    }
}

impl<const D: usize> Load<D> for Together<D> {
    fn hold(&self, state: &mut State<D>) {
        self.0.iter().for_each(|(_, action)| action.hold(state));
    }

    fn held(&self) -> Vec<u32> {
        let mut held: Vec<u32> = self.0.iter().flat_map(|(_, action)| action.held()).collect();
        held.sort_unstable();
        held.dedup();
        held
    }

    fn force(&mut self, state: &mut State<D>, time: f64) {
        self.0.iter_mut().for_each(|(_, action)| action.force(state, time));
    }

    fn book(&mut self, state: &State<D>, time: f64) {
        self.0.iter_mut().for_each(|(_, action)| action.book(state, time));
    }

    fn work(&self, ranks: Ranks) -> f64 {
        self.0.iter().map(|(_, action)| action.work(ranks)).sum()
    }

    fn unresolved(&self, state: &State<D>, time_step: f64, ranks: Ranks) -> f64 {
        let actions = self.0.iter();
        actions
            .map(|(_, action)| action.unresolved(state, time_step, ranks))
            .sum()
    }

    fn longest_step(&self, spacing: f64) -> f64 {
        let longest = self.0.iter().map(|(_, action)| action.longest_step(spacing));
        longest.fold(f64::INFINITY, f64::min)
    }
}
