//! A rigid ball that runs into a specimen.

use std::ops::Range;

use rayon::prelude::*;

use super::carried::Carried;
use super::work::Work;
use super::{Act, Action, Load};
use crate::domain::Ranks;
use crate::state::State;

/// A rigid ball with a constant velocity. It pushes each site within its radius R with K (R - r)^2 along the line from its
/// middle, whose energy K (R - r)^3/3 is smooth to its second derivative: the stiffness of the contact sets in at zero.
#[derive(Clone, Debug)]
pub struct Ball<const D: usize> {
    sites: Carried,
    /// Nodes that carry the sites, ascending.
    nodes: Vec<u32>,
    /// nm
    radius: f64,
    /// K, eV/nm^3.
    stiffness: f64,
    /// Where its middle is at the start, nm.
    centre: [f64; D],
    /// nm/ps
    velocity: [f64; D],
    /// Elements of the sites whose nodes this rank moves.
    mine: Vec<u32>,
    /// What it pushes each of its nodes with now, eV/nm; zero for those that other ranks move.
    forces: Vec<[f64; D]>,
    work: Work,
}

impl<const D: usize> Ball<D> {
    /// A ball with its radius (nm) and stiffness (eV/nm^3), with its middle at a place (nm) and its velocity (nm/ps), before
    /// these sites.
    pub fn new(sites: Carried, [radius, stiffness]: [f64; 2], [centre, velocity]: [[f64; D]; 2]) -> Self {
        let nodes: Vec<u32> = sites.shares().into_iter().map(|(node, _)| node).collect();
        Self {
            forces: vec![[0.0; D]; nodes.len()],
            work: Work::none(nodes.len()),
            mine: (0..sites.elements().len() as u32).collect(),
            sites,
            nodes,
            radius,
            stiffness,
            centre,
            velocity,
        }
    }

    /// Where its middle is at a time, nm.
    pub fn centre(&self, time: f64) -> [f64; D] {
        std::array::from_fn(|axis| self.centre[axis] + self.velocity[axis] * time)
    }

    /// What it pushes a site with that stands at a place, eV/nm; `None` where it does not touch it.
    fn push(&self, centre: [f64; D], place: [f64; D]) -> Option<[f64; D]> {
        let way: [f64; D] = std::array::from_fn(|axis| place[axis] - centre[axis]);
        let squared: f64 = way.iter().map(|component| component * component).sum();
        if squared >= self.radius * self.radius {
            return None;
        }
        let distance = squared.sqrt();
        let depth = self.radius - distance;
        Some(way.map(|component| self.stiffness * depth * depth * component / distance))
    }

    /// The sites of an element that it touches, and its pushes. Sites stand between the nodes that carry them.
    fn touched(&self, element: usize, centre: [f64; D], position: &[Vec<f64>; D]) -> Vec<(usize, [f64; D])> {
        let sites = self.sites.elements()[element].clone();
        let carriers = self.sites.carriers(sites.clone());
        let is_beyond = (0..D).any(|axis| {
            let places = carriers
                .iter()
                .map(|&(node, _)| position[axis][node as usize] - centre[axis]);
            places.clone().all(|place| place > self.radius) || places.clone().all(|place| place < -self.radius)
        });
        if is_beyond {
            return Vec::new();
        }
        let push = |site: usize| Some((site, self.push(centre, self.sites.at(site, position))?));
        sites.filter_map(push).collect()
    }
}

impl<const D: usize> Load<D> for Ball<D> {
    fn hold(&self, _: &mut State<D>) {}

    fn held(&self) -> Vec<u32> {
        Vec::new()
    }

    /// Summed in the order of the sites, whoever finds them.
    fn force(&mut self, state: &mut State<D>, time: f64) {
        let centre = self.centre(time);
        let position = &state.position;
        let elements = self.mine.par_iter().with_min_len(64);
        let touched: Vec<_> = elements
            .flat_map_iter(|&element| self.touched(element as usize, centre, position))
            .collect();
        self.forces.fill([0.0; D]);
        for (site, push) in touched {
            for &(node, weight) in self.sites.carriers(site..site + 1) {
                let place = self.nodes.binary_search(&node).expect("it carries a site of the face");
                (0..D).for_each(|axis| self.forces[place][axis] += weight * push[axis]);
            }
        }
        for &place in self.work.mine() {
            let [node, place] = [self.nodes[place as usize], place].map(|number| number as usize);
            (0..D).for_each(|axis| state.force[axis][node] += self.forces[place][axis]);
        }
    }

    fn book(&mut self, state: &State<D>, time: f64) {
        for number in 0..self.work.mine().len() {
            let place = self.work.mine()[number] as usize;
            let node = self.nodes[place] as usize;
            let velocity = state.velocity.each_ref().map(|plane| plane[node]);
            self.work.book(place, self.forces[place], velocity, time);
        }
    }

    fn work(&self, ranks: Ranks) -> f64 {
        self.work.total(ranks)
    }

    fn unresolved(&self, state: &State<D>, time_step: f64, ranks: Ranks) -> f64 {
        let [sum] = self.work.sum(ranks, |place| {
            let node = self.nodes[place] as usize;
            let of_axis =
                |axis: usize| self.forces[place][axis] * self.forces[place][axis] * state.mobility[axis][node];
            [(0..D).map(of_axis).sum::<f64>()]
        });
        0.125 * time_step * time_step * sum
    }

    /// The contact is soft: the step of the crystal is short enough for it.
    fn longest_step(&self, _: f64) -> f64 {
        f64::INFINITY
    }
}

impl<const D: usize> Action<D> for Ball<D> {
    fn pull(&self, _: &State<D>, ranks: Ranks) -> [f64; D] {
        self.work.sum(ranks, |place| self.forces[place])
    }

    /// The nodes of an element belong to one rank.
    fn keep_to(&mut self, nodes: &[Range<usize>]) {
        self.work.keep_to(self.nodes.iter().copied(), nodes);
        let elements = (0..).zip(self.sites.elements());
        let is_mine = |(_, sites): &(u32, &Range<usize>)| {
            let (first, _) = self.sites.carriers(sites.start..sites.end)[0];
            nodes.iter().any(|range| range.contains(&(first as usize)))
        };
        self.mine = elements.filter(is_mine).map(|(element, _)| element).collect();
    }

    fn act(&self) -> Act<D> {
        Act::Strike {
            nodes: self.nodes.clone(),
            radius: self.radius,
            stiffness: self.stiffness,
            centre: self.centre,
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

    /// Of a difference of energies over 1e-5 nm.
    const DIFFERENCE: f64 = 1e-8;

    /// A ball of radius 2 below two atoms and an edge of three sites between two nodes.
    fn ball() -> (Ball<3>, State<3>) {
        let edge = [vec![(0, 1.0)], vec![(0, 0.5), (1, 0.5)], vec![(1, 1.0)]];
        let atoms = [vec![vec![(2, 1.0)]], vec![vec![(3, 1.0)]]];
        let elements = [&[edge.to_vec()], &atoms[..]].concat();
        let sites = Carried::new(elements.into_iter().map(Vec::into_iter));
        let ball = Ball::new(sites, [2.0, 10.0], [[0.0, 0.0, -1.8], [0.1, 0.0, 0.4]]);
        let places = [vec![-0.5, 0.6, 1.0, 9.0], vec![0.0, 0.3, 0.0, 0.0], vec![0.0; 4]];
        (ball, State::at_rest(places, vec![1.0; 4]))
    }

    fn energy(ball: &Ball<3>, state: &State<3>, time: f64) -> f64 {
        let centre = ball.centre(time);
        let of_site = |site: usize| {
            let place = ball.sites.at(site, &state.position);
            let squared: f64 = (0..3).map(|axis| (place[axis] - centre[axis]).powi(2)).sum();
            10.0 / 3.0 * (2.0 - squared.sqrt()).max(0.0).powi(3)
        };
        (0..ball.sites.len()).map(of_site).sum()
    }

    #[test]
    fn its_force_on_nodes_is_the_gradient_of_its_energy_and_as_large_as_that_on_the_ball() {
        let (mut ball, mut state) = ball();
        ball.force(&mut state, 0.5);
        let force = state.force.clone();
        assert!(force[2][0] > 0.01 && force[2][2] > 0.01);
        assert!(force.iter().all(|plane| plane[3] == 0.0), "what is far is not touched");
        for axis in 0..3 {
            for node in 0..4 {
                let at = |shift: f64| {
                    let mut moved = state.clone();
                    moved.position[axis][node] += shift;
                    energy(&ball, &moved, 0.5)
                };
                let slope = (at(1e-5) - at(-1e-5)) / 2e-5;
                assert!((force[axis][node] + slope).abs() < DIFFERENCE, "{axis} {node}: {slope}");
            }
            let sum: f64 = force[axis].iter().sum();
            assert!((ball.pull(&state, Ranks::alone())[axis] - sum).abs() < 1e-14);
        }
    }

    #[test]
    fn its_work_is_its_force_on_nodes_times_their_way() {
        let (mut ball, mut state) = ball();
        ball.force(&mut state, 0.5);
        state.velocity[2] = vec![1.0, 0.0, -3.0, 5.0];
        ball.book(&state, 0.25);
        let expected = 0.25 * (state.force[2][0] - 3.0 * state.force[2][2]);
        assert!((ball.work(Ranks::alone()) - expected).abs() < 1e-15);
    }

    #[test]
    fn on_a_rank_it_pushes_the_nodes_that_the_rank_moves_with_the_same_bits() {
        let (mut ball, mut state) = ball();
        ball.force(&mut state, 0.5);
        let (mut part, mut own) = super::tests::ball();
        part.keep_to(&[0..2, 3..4]);
        part.force(&mut own, 0.5);
        for axis in 0..3 {
            assert_eq!(own.force[axis][..2], state.force[axis][..2]);
            assert_eq!(own.force[axis][2], 0.0);
        }
        assert!(state.force[2][2] > 0.0);
    }

    #[test]
    fn its_push_sets_in_with_neither_a_jump_nor_a_kink() {
        let (ball, _) = ball();
        let push = |depth: f64| {
            let push = ball.push([0.0; 3], [0.0, 0.0, 2.0 - depth]);
            push.map_or(0.0, |push| push[2])
        };
        assert_eq!(push(0.0), 0.0);
        assert!((push(0.1) - 10.0 * 0.01).abs() < 1e-14);
        let stiffness = (push(2e-4) - push(1e-4)) / 1e-4;
        assert!(stiffness < 0.01, "{stiffness}");
    }

    #[test]
    fn a_step_leaves_open_an_eighth_of_what_its_force_would_do_squared() {
        let (mut ball, mut state) = ball();
        ball.force(&mut state, 0.0);
        let squares = |node: usize| {
            (0..3)
                .map(|axis| state.force[axis][node] * state.force[axis][node])
                .sum::<f64>()
        };
        let all: f64 = (0..4).map(squares).sum();
        let found = ball.unresolved(&state, 0.5, Ranks::alone());
        assert!(
            all > 0.0 && (found / (0.125 * 0.25 * all) - 1.0).abs() < 1e-14,
            "{found} for {all}"
        );
    }
}
