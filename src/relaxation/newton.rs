//! Newton's method with conjugate gradients; the product of stiffness and vector is a difference of forces.

use super::vectors::{add, dot, largest, plain_dot, turn, zeros_like};
use super::{Descent, RelaxationError};
use crate::forces::Planes;

/// Longest displacement in a difference of forces, in spacings: the third derivative of the energy then disturbs the
/// stiffness by some 1e-5, and rounding by 1e-8.
const DIFFERENCE: f64 = 1e-6;
/// Share of the residual at which the linear equations count as solved.
const LINEAR_SHARE: f64 = 1e-3;
/// Most products for one direction, per square root of the number of nodes: some ten times what elasticity takes.
const MOST_PRODUCTS: f64 = 50.0;
/// What a step must leave at most of the squared residual to count as one.
const PROGRESS: f64 = 0.25;
/// No node moves farther than this in one step, in spacings.
const LONGEST_MOVE: f64 = 0.1;
/// How often a step is halved before it is given up.
const HALVINGS: u32 = 4;

impl Descent<'_> {
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
    /// is not positive.
    fn newton_direction(&mut self, position: &Planes, force: &Planes) -> Result<Option<Planes>, RelaxationError> {
        let mut direction = zeros_like(force);
        let mut rest = force.clone();
        let mut search = zeros_like(force);
        let mut square = dot(&self.compliance, &rest, &rest);
        let enough = square * LINEAR_SHARE * LINEAR_SHARE;
        let mut kept = 0.0;
        let most = (MOST_PRODUCTS * (force[0].len() as f64).sqrt()) as usize;
        for _ in 0..most {
            if square <= enough {
                break;
            }
            turn(&mut search, kept, 1.0, &self.compliance, &rest);
            let product = self.stiffness_times(&search, position, force)?;
            let curvature = plain_dot(&search, &product);
            if curvature <= 0.0 {
                return Ok(None);
            }
            let step = square / curvature;
            add(&mut direction, step, &search);
            add(&mut rest, -step, &product);
            let next = dot(&self.compliance, &rest, &rest);
            kept = next / square;
            square = next;
        }
        Ok(Some(direction))
    }

    /// Leaves the positions displaced.
    fn stiffness_times(
        &mut self,
        vector: &Planes,
        position: &Planes,
        force: &Planes,
    ) -> Result<Planes, RelaxationError> {
        let step = DIFFERENCE * self.spacing / largest(vector);
        self.state.position.clone_from(position);
        add(&mut self.state.position, step, vector);
        self.evaluate()?;
        let mut product = force.clone();
        add(&mut product, -1.0, &self.state.force);
        product.iter_mut().flatten().for_each(|value| *value /= step);
        Ok(product)
    }
}
