//! From one moment to the next: kicks, and a drift after them.

use pulp::Simd;

use crate::lanes::Lanes;

/// So many equal kicks over a time each, then a drift over a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leap {
    pub kicks: u32,
    /// ps
    pub kick: f64,
    /// ps
    pub drift: f64,
}

impl Leap {
    /// The velocities after the kicks of some nodes; arithmetic rounds as that of single numbers does.
    #[inline(always)]
    pub fn velocities<L: Simd>(self, force: Lanes<L>, mobility: Lanes<L>, velocity: Lanes<L>) -> Lanes<L> {
        let push = mobility * self.kick * force;
        let mut velocity = velocity;
        for _ in 0..self.kicks {
            velocity = velocity + push;
        }
        velocity
    }

    /// Where a drift with these velocities brings some nodes.
    #[inline(always)]
    pub fn positions<L: Simd>(self, position: Lanes<L>, velocity: Lanes<L>) -> Lanes<L> {
        position + velocity * self.drift
    }

    /// The same of a single node: its velocity and its position.
    pub fn of_one(self, force: f64, mobility: f64, mut velocity: f64, position: f64) -> [f64; 2] {
        let push = mobility * self.kick * force;
        (0..self.kicks).for_each(|_| velocity += push);
        [velocity, position + velocity * self.drift]
    }
}
