//! Several actions on one specimen.

use super::{Action, Load};
use crate::domain::Ranks;
use crate::state::State;

/// Actions that stand beside each other, each with a name of its own.
pub struct Together<const D: usize>(Vec<(String, Box<dyn Action<D>>)>);

impl<const D: usize> Together<D> {
    pub fn new(actions: Vec<(String, Box<dyn Action<D>>)>) -> Self {
        Self(actions)
    }

    /// Name and force on the specimen, eV/nm, of each.
    pub fn pulls(&self, state: &State<D>) -> impl Iterator<Item = (&str, [f64; D])> {
        let pulls = self.0.iter();
        pulls.map(|(name, action)| (name.as_str(), action.pull(state)))
    }

    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|(name, _)| name.as_str())
    }

    /// What each has booked on each of its nodes, one after the other, eV.
    pub fn booked(&self) -> Vec<f64> {
        let actions = self.0.iter();
        actions
            .flat_map(|(_, action)| action.booked().of_nodes())
            .copied()
            .collect()
    }

    /// Goes back to what [`Self::booked`] gave.
    pub fn restore(&mut self, booked: &[f64]) {
        let mut rest = booked;
        for (_, action) in &mut self.0 {
            let (own, others) = rest.split_at(action.booked().of_nodes().len());
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

    fn longest_step(&self, spacing: f64) -> f64 {
        let longest = self.0.iter().map(|(_, action)| action.longest_step(spacing));
        longest.fold(f64::INFINITY, f64::min)
    }
}
