//! Newton's method with conjugate gradients; the product of stiffness and vector is a difference of forces.

use super::vectors::{add, change, dot, largest, sum, turn, zeros_like};
use super::{Descent, RelaxationError};
use crate::forces::Planes;

/// Longest displacement in a difference of forces, in spacings: the third derivative of the energy then disturbs the
/// stiffness by some 1e-5, and rounding by 1e-8.
const DIFFERENCE: f64 = 1e-6;
/// Share of the residual at which the linear equations count as solved, unless less will do for the target.
const LINEAR_SHARE: f64 = 1e-3;
/// What the linear equations may leave of the target.
const TARGET_SHARE: f64 = 0.1;
/// Most products for one direction, per square root of the number of nodes: some ten times what elasticity takes.
const MOST_PRODUCTS: f64 = 50.0;
/// What a step must leave at most of the squared residual to count as one.
const PROGRESS: f64 = 0.25;
/// No node moves farther than this in one step, in spacings.
const LONGEST_MOVE: f64 = 0.1;
/// How often a step is halved before it is given up.
const HALVINGS: u32 = 4;

impl<const D: usize> Descent<'_, D> {
    /// One step. False, with the positions as they were: the energy curves downwards or the residual hardly falls.
    pub fn newton_step(&mut self) -> Result<bool, RelaxationError> {
        let start = [self.state.position.clone(), self.state.force.clone()];
        let found = self.newton_direction(&start[0], &start[1]);
        [self.state.position, self.state.force] = start.clone();
        let Some(direction) = found? else {
            return Ok(false);
        };
        let before = dot(&self.compliance, &start[1], &start[1]);
        let mut share = (LONGEST_MOVE * self.spacing / largest(&direction)).min(1.0);
        for _ in 0..HALVINGS {
            add(&mut self.state.position, share, &direction);
            self.evaluate()?;
            if dot(&self.compliance, &self.state.force, &self.state.force) <= PROGRESS * before {
                return Ok(true);
            }
            [self.state.position, self.state.force] = start.clone();
            share *= 0.5;
        }
        Ok(false)
    }

    /// Solves stiffness times direction = force, as far as it takes a sensible number of products. `None`: the stiffness
    /// is not positive. Leaves the positions displaced.
    fn newton_direction(
        &mut self,
        position: &Planes<D>,
        force: &Planes<D>,
    ) -> Result<Option<Planes<D>>, RelaxationError> {
        let mut direction = zeros_like(force);
        let mut rest = force.clone();
        let mut search = zeros_like(force);
        let mut square = dot(&self.compliance, &rest, &rest);
        let residual = self.residual();
        let share = LINEAR_SHARE.max(TARGET_SHARE * self.target.residual / residual);
        let [first, enough] = [square, square * share * share];
        let mut kept = 0.0;
        let most = (MOST_PRODUCTS * (force[0].len() as f64).sqrt()) as usize;
        for _ in 0..most {
            if square <= enough {
                break;
            }
            turn(&mut search, kept, 1.0, &self.compliance, &rest);
            // Stiffness times vector: what forces lose over a short way, by its length.
            let way = DIFFERENCE * self.spacing / largest(&search);
            change(&mut self.state.position, [position, &search], |_, [start, search]| {
                start + way * search
            });
            self.evaluate()?;
            let moved = &self.state.force;
            let curvature = sum([&search, force, moved], |[search, force, moved]| {
                search * (force - moved)
            }) / way;
            if curvature <= 0.0 {
                return Ok(None);
            }
            let step = square / curvature;
            add(&mut direction, step, &search);
            let steps = step / way;
            change(&mut rest, [force, moved], |rest, [force, moved]| {
                rest - steps * (force - moved)
            });
            let next = dot(&self.compliance, &rest, &rest);
            kept = next / square;
            square = next;
            (self.tell)(residual * (square / first).sqrt());
        }
        Ok(Some(direction))
    }
}
