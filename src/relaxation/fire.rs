//! FIRE, the fast inertial relaxation engine: [Bitzek2006] with the half step back of [Guenole2020].
//!
//! The masses are the stiffness bounds of the elements. No frequency is then above 1, and one time step suits atoms
//! and triangles alike.

use super::vectors::{add, change, dot, largest, plain_dot, sum, turn, zeros_like};
use super::{Descent, RelaxationError};
use crate::forces::Planes;

/// Time steps in units of the inverse of the highest frequency; central differences are stable up to 2.
const FIRST_STEP: f64 = 0.2;
const LONGEST_STEP: f64 = 1.0;
const LONGER: f64 = 1.1;
const SHORTER: f64 = 0.5;
/// Steps downhill before the time step grows.
const PATIENCE: u32 = 5;
/// How much of the velocity is turned towards the force, and how this fades.
const TURN: f64 = 0.1;
const FADE: f64 = 0.99;
/// No node moves farther than this in one step, in spacings.
const LONGEST_MOVE: f64 = 0.05;

/// The damped motion.
pub struct Fire {
    time_step: f64,
    turn: f64,
    downhill: u32,
}

impl Default for Fire {
    fn default() -> Self {
        Self {
            time_step: FIRST_STEP,
            turn: TURN,
            downhill: 0,
        }
    }
}

impl Fire {
    /// Moves until the residual is no larger than this.
    pub fn run<const D: usize>(mut self, descent: &mut Descent<D>, residual: f64) -> Result<(), RelaxationError> {
        let mut velocity = zeros_like(&descent.state.position);
        while descent.residual() > residual {
            self.judge(descent, &mut velocity);
            let force = &descent.state.force;
            let pull = dot(&descent.compliance, force, force);
            // One kick by the force, then a turn towards it at the same speed.
            let speed = self.kicked_speed(descent, &velocity, pull);
            let towards = self.time_step * (1.0 - self.turn) + self.turn * speed / pull.sqrt();
            turn(&mut velocity, 1.0 - self.turn, towards, &descent.compliance, force);
            let longest = self.time_step * largest(&velocity) / (LONGEST_MOVE * descent.spacing);
            if longest > 1.0 {
                change(&mut velocity, [], |value, []| value / longest);
            }
            add(&mut descent.state.position, self.time_step, &velocity);
            descent.evaluate()?;
            let residual = descent.residual();
            (descent.tell)(residual);
        }
        Ok(())
    }

    /// Lengthens the step downhill; uphill goes half a step back and starts anew.
    fn judge<const D: usize>(&mut self, descent: &mut Descent<D>, velocity: &mut Planes<D>) {
        if plain_dot(&descent.state.force, velocity) > 0.0 {
            self.downhill += 1;
            if self.downhill > PATIENCE {
                self.time_step = (self.time_step * LONGER).min(LONGEST_STEP);
                self.turn *= FADE;
            }
        } else {
            if self.downhill > 0 {
                self.time_step *= SHORTER;
            }
            add(&mut descent.state.position, -0.5 * self.time_step, velocity);
            change(velocity, [], |_, []| 0.0);
            self.downhill = 0;
            self.turn = TURN;
        }
    }

    /// Speed, weighted by the masses, after a kick by the force.
    fn kicked_speed<const D: usize>(&self, descent: &Descent<D>, velocity: &Planes<D>, pull: f64) -> f64 {
        // Where the motion is prescribed both are zero.
        let squared = sum([velocity, &descent.compliance], |[value, compliance]| {
            if compliance > 0.0 {
                value * value / compliance
            } else {
                0.0
            }
        });
        let along = plain_dot(&descent.state.force, velocity);
        let time = self.time_step;
        (squared + 2.0 * time * along + time * time * pull).max(0.0).sqrt()
    }
}
