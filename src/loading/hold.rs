//! Nodes that move as prescribed: held at rest, or with a constant velocity.

use std::ops::Range;

use super::work::Work;
use super::{Act, Action, Load, pace};
use crate::domain::Ranks;
use crate::state::State;

/// Moves some nodes with one constant velocity.
#[derive(Clone, Debug, PartialEq)]
pub struct Hold<const D: usize> {
    /// Ascending.
    nodes: Vec<u32>,
    /// nm/ps
    velocity: [f64; D],
    /// Along which axes they are held.
    axes: [bool; D],
    /// Whether what is next to them starts with their velocity.
    is_followed: bool,
    work: Work,
}

impl<const D: usize> Hold<D> {
    /// Nodes that stay where they are.
    pub fn at_rest(nodes: Vec<u32>) -> Self {
        Self::moving(nodes, [0.0; D], true)
    }

    /// Nodes that move with a velocity, nm/ps. `is_followed` says that the rest of the specimen does not start at rest, but with
    /// its share of it ([`super::Ramp`]), so that no shock enters.
    pub fn moving(mut nodes: Vec<u32>, velocity: [f64; D], is_followed: bool) -> Self {
        nodes.sort_unstable();
        nodes.dedup();
        Self {
            work: Work::none(nodes.len()),
            nodes,
            velocity,
            axes: [true; D],
            is_followed,
        }
    }

    /// The same along some axes, with the nodes free along the others.
    pub fn along(self, axes: [bool; D]) -> Self {
        Self { axes, ..self }
    }

    /// The force that holds a node, eV/nm.
    #[inline(always)]
    fn on_node(&self, place: usize, state: &State<D>) -> [f64; D] {
        let node = self.nodes[place] as usize;
        std::array::from_fn(|axis| match self.axes[axis] {
            true => -state.force[axis][node],
            false => 0.0,
        })
    }
}

impl<const D: usize> Load<D> for Hold<D> {
    fn hold(&self, state: &mut State<D>) {
        for &node in &self.nodes {
            for axis in (0..D).filter(|&axis| self.axes[axis]) {
                state.mobility[axis][node as usize] = 0.0;
                state.velocity[axis][node as usize] = self.velocity[axis];
            }
        }
    }

    fn held(&self) -> Vec<u32> {
        self.nodes.clone()
    }

    /// What holds a node pulls as strongly as the specimen does, the other way.
    fn book(&mut self, state: &State<D>, time: f64) {
        if self.velocity == [0.0; D] {
            return;
        }
        for number in 0..self.work.mine().len() {
            let place = self.work.mine()[number] as usize;
            self.work.book(place, self.on_node(place, state), self.velocity, time);
        }
    }

    fn work(&self, ranks: Ranks) -> f64 {
        self.work.total(ranks)
    }

    fn longest_step(&self, spacing: f64) -> f64 {
        let speed = self
            .velocity
            .iter()
            .map(|component| component * component)
            .sum::<f64>()
            .sqrt();
        match self.is_followed || speed == 0.0 {
            true => f64::INFINITY,
            false => pace::SHARE_OF_SPACING * spacing / speed,
        }
    }
}

impl<const D: usize> Action<D> for Hold<D> {
    fn pull(&self, state: &State<D>, ranks: Ranks) -> [f64; D] {
        self.work.sum(ranks, |place| self.on_node(place, state))
    }

    fn keep_to(&mut self, nodes: &[Range<usize>]) {
        self.work.keep_to(self.nodes.iter().copied(), nodes);
    }

    fn act(&self) -> Act<D> {
        Act::Move {
            nodes: self.nodes.clone(),
            velocity: self.velocity,
        }
    }

    fn booked(&self) -> &Work {
        &self.work
    }

    fn booked_mut(&mut self) -> &mut Work {
        &mut self.work
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn held_nodes_move_as_prescribed_and_the_work_is_that_of_the_force_that_holds_them() {
        let mut state = State::at_rest([vec![0.0; 4], vec![0.0; 4], vec![0.0; 4]], vec![1.0; 4]);
        let mut hold = Hold::moving(vec![3, 1, 3], [0.0, 0.5, -0.25], false);
        hold.hold(&mut state);
        assert_eq!(state.velocity[1], [0.0, 0.5, 0.0, 0.5]);
        assert_eq!(state.velocity[2], [0.0, -0.25, 0.0, -0.25]);
        assert!(state.mobility.iter().all(|plane| plane[..] == [1.0, 0.0, 1.0, 0.0]));
        // The specimen pulls down with 2 and 4: what holds it pulls up.
        state.force[1] = vec![9.0, -2.0, 9.0, -4.0];
        assert_eq!(hold.pull(&state, Ranks::alone()), [0.0, 6.0, 0.0]);
        hold.book(&state, 0.5);
        assert_eq!(hold.work(Ranks::alone()), 6.0 * 0.5 * 0.5);
        let mut at_rest = Hold::at_rest(vec![0]);
        at_rest.book(&state, 0.5);
        assert_eq!(at_rest.work(Ranks::alone()), 0.0);
    }

    #[test]
    fn nodes_that_are_held_along_one_axis_are_free_along_the_others() {
        let mut state = State::at_rest([vec![0.0; 2], vec![0.0; 2]], vec![1.0; 2]);
        state.velocity = [vec![0.5; 2], vec![0.5; 2]];
        let hold = Hold::at_rest(vec![1]).along([false, true]);
        hold.hold(&mut state);
        assert_eq!(state.velocity, [vec![0.5, 0.5], vec![0.5, 0.0]]);
        assert_eq!(state.mobility, [vec![1.0, 1.0], vec![1.0, 0.0]]);
        state.force = [vec![0.0, 3.0], vec![0.0, -4.0]];
        assert_eq!(hold.pull(&state, Ranks::alone()), [0.0, 4.0]);
    }

    #[test]
    fn in_the_longest_step_nodes_outrun_the_specimen_by_a_hundredth_of_the_spacing() {
        let speed = 0.5;
        let outrun = Hold::moving(vec![0], [0.0, 0.0, speed], false).longest_step(0.25) * speed;
        assert!((outrun / (0.01 * 0.25) - 1.0).abs() < 1e-14);
        assert_eq!(Hold::<3>::at_rest(vec![0]).longest_step(0.25), f64::INFINITY);
    }
}
