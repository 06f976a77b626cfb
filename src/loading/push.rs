//! Forces on a face that are given in time: tractions and pulses.

use std::f64::consts::PI;
use std::ops::Range;

use super::work::Work;
use super::{Act, Action, Load};
use crate::domain::Ranks;
use crate::state::State;

/// How a force goes on in time, as a factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Course {
    /// Grows evenly to its whole within a time, ps, and stays; 0: it is all there from the start.
    Rise { within: f64 },
    /// One half of a sine over a time, ps.
    HalfSine { duration: f64 },
    /// A Gaussian with its peak after one half of a time, ps, and a quarter of it as full width at half maximum: it begins and
    /// ends with 1e-5 of its peak.
    Gaussian { duration: f64 },
}

impl Course {
    /// The factor at a time, ps.
    pub fn factor(self, time: f64) -> f64 {
        match self {
            Self::Rise { within } if time < within => time / within,
            Self::Rise { .. } => 1.0,
            Self::HalfSine { duration } if time < duration => (PI * time / duration).sin(),
            Self::HalfSine { .. } => 0.0,
            Self::Gaussian { duration } => {
                let widths = 4.0 * (time / duration - 0.5);
                (-4.0 * 2_f64.ln() * widths * widths).exp()
            }
        }
    }
}

/// The same force on every site of a face, as the nodes that carry the sites feel it: its work on the nodes is that on the
/// sites.
#[derive(Clone, Debug, PartialEq)]
pub struct Push<const D: usize> {
    /// Nodes and how many sites each stands for.
    shares: Vec<(u32, f64)>,
    /// On a site at its whole, eV/nm.
    force: [f64; D],
    course: Course,
    /// What it is multiplied by now.
    factor: f64,
    work: Work,
}

impl<const D: usize> Push<D> {
    /// A force a site (eV/nm) on sites that nodes stand for in these shares.
    pub fn new(shares: Vec<(u32, f64)>, force: [f64; D], course: Course) -> Self {
        Self {
            work: Work::none(shares.len()),
            shares,
            force,
            course,
            factor: 0.0,
        }
    }
}

impl<const D: usize> Load<D> for Push<D> {
    fn hold(&self, _: &mut State<D>) {}

    fn held(&self) -> Vec<u32> {
        Vec::new()
    }

    fn force(&mut self, state: &mut State<D>, time: f64) {
        self.factor = self.course.factor(time);
        for (plane, component) in state.force.iter_mut().zip(self.force) {
            let of_site = self.factor * component;
            if of_site != 0.0 {
                for &place in self.work.mine() {
                    let (node, share) = self.shares[place as usize];
                    plane[node as usize] += of_site * share;
                }
            }
        }
    }

    fn book(&mut self, state: &State<D>, time: f64) {
        for number in 0..self.work.mine().len() {
            let place = self.work.mine()[number] as usize;
            let (node, share) = self.shares[place];
            let force = self.force.map(|component| self.factor * component * share);
            let velocity = state.velocity.each_ref().map(|plane| plane[node as usize]);
            self.work.book(place, force, velocity, time);
        }
    }

    fn work(&self, ranks: Ranks) -> f64 {
        self.work.total(ranks)
    }

    fn unresolved(&self, state: &State<D>, time_step: f64, ranks: Ranks) -> f64 {
        let [sum] = self.work.sum(ranks, |place| {
            let (node, share) = self.shares[place];
            let of_axis = |axis: usize| {
                let force = self.factor * self.force[axis] * share;
                force * force * state.mobility[axis][node as usize]
            };
            [(0..D).map(of_axis).sum::<f64>()]
        });
        0.125 * time_step * time_step * sum
    }

    fn longest_step(&self, _: f64) -> f64 {
        f64::INFINITY
    }
}

impl<const D: usize> Action<D> for Push<D> {
    fn pull(&self, _: &State<D>, _: Ranks) -> [f64; D] {
        let sites: f64 = self.shares.iter().map(|(_, share)| share).sum();
        self.force.map(|component| self.factor * component * sites)
    }

    fn keep_to(&mut self, nodes: &[Range<usize>]) {
        self.work.keep_to(self.shares.iter().map(|&(node, _)| node), nodes);
    }

    fn act(&self) -> Act<D> {
        Act::Push {
            shares: self.shares.clone(),
            force: self.force,
            course: self.course,
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

    /// Simpson's rule with a thousand parts.
    const QUADRATURE: f64 = 1e-9;

    #[test]
    fn pulses_have_their_peak_and_their_impulse_and_tractions_stay() {
        let simpson = |course: Course| {
            let value = |k: u32| {
                let weight = match k {
                    0 | 1000 => 1.0,
                    _ => 4.0 - 2.0 * f64::from(1 - k % 2),
                };
                weight * course.factor(4.0 * f64::from(k) / 1000.0)
            };
            (0..=1000).map(value).sum::<f64>() * 4.0 / 3000.0
        };
        let sine = Course::HalfSine { duration: 4.0 };
        assert_eq!(sine.factor(2.0), 1.0);
        assert!((simpson(sine) - 4.0 * 2.0 / PI).abs() < QUADRATURE);
        assert_eq!(sine.factor(4.5), 0.0);
        let gaussian = Course::Gaussian { duration: 4.0 };
        assert_eq!(gaussian.factor(2.0), 1.0);
        assert!((gaussian.factor(1.5) - 0.5).abs() < QUADRATURE && gaussian.factor(0.0) < 2e-5);
        let whole = (PI / (4.0 * 2_f64.ln())).sqrt();
        assert!((simpson(gaussian) - whole).abs() < 1e-5);
        let rise = Course::Rise { within: 4.0 };
        assert_eq!(
            [0.0, 1.0, 4.0, 90.0].map(|time| rise.factor(time)),
            [0.0, 0.25, 1.0, 1.0]
        );
        assert_eq!(Course::Rise { within: 0.0 }.factor(0.0), 1.0);
    }

    #[test]
    fn nodes_feel_the_force_of_the_sites_that_they_stand_for_and_it_works_on_them() {
        let mut state = State::at_rest([vec![0.0; 3], vec![0.0; 3]], vec![1.0; 3]);
        let mut push = Push::new(vec![(0, 1.5), (2, 2.5)], [0.0, -2.0], Course::Rise { within: 4.0 });
        push.force(&mut state, 2.0);
        assert_eq!(state.force, [vec![0.0; 3], vec![-1.5, 0.0, -2.5]]);
        assert_eq!(push.pull(&state, Ranks::alone()), [0.0, -4.0]);
        state.velocity[1] = vec![-1.0, 7.0, 2.0];
        push.book(&state, 0.5);
        assert_eq!(push.work(Ranks::alone()), 0.5 * (1.5 - 5.0));
    }
}
