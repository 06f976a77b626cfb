//! The motion of the next step, done with the forces of this one.

use crate::forces::{AtomMotion, ForceError, Forces, Motion, Planes};
use crate::integrator;
use crate::state::{Inertia, State, Strip};

/// Where nodes come to be.
#[derive(Default)]
pub struct Next {
    position: Planes,
    /// How fast they come to be there.
    velocity: Planes,
    /// How each group of triangles answers to forces.
    inertias: Vec<Inertia>,
}

impl Next {
    /// Takes nodes of other ranks into account that have come to be this one's.
    pub fn forget_inertias(&mut self) {
        self.inertias.clear();
    }

    /// Forces at the present positions and the motion of the next step, which passes through the memory with them.
    pub fn compute_and_move(
        &mut self,
        forces: &mut Forces,
        state: &mut State,
        time_step: f64,
    ) -> Result<(), ForceError> {
        if self.position[0].is_empty() {
            // Untouched zeros, of which a rank fills in its own.
            let zeros = || [0, 1].map(|_| vec![0.0; state.nodes()]);
            (self.position, self.velocity) = (zeros(), zeros());
        }
        if self.inertias.is_empty() {
            self.inertias = state.inertias(forces.mesh());
        }
        let State {
            position,
            velocity,
            force,
            mobility,
            ..
        } = state;
        let leap = integrator::leap(2, time_step);
        let atoms = AtomMotion {
            leap,
            mobility: 1.0 / forces.material().site_mass,
        };
        let inertias = &self.inertias;
        let ahead = integrator::Ahead {
            leap,
            before: velocity,
            mobility,
            inertias,
        };
        let advance = |strip: Strip, position: &Planes| ahead.strip(strip, position);
        let motion = Motion {
            before: velocity,
            velocity: &mut self.velocity,
            next: &mut self.position,
            advance: &advance,
            atoms,
        };
        let (left, Motion { velocity, next, .. }) = forces.compute_and_move(position, force, motion)?;
        ahead.triangles(
            forces.mesh(),
            &left.triangles,
            [position, force],
            [&mut *velocity, &mut *next],
        );
        for nodes in &left.atoms {
            ahead.atoms(nodes, [position, force], [&mut *velocity, &mut *next]);
        }
        std::mem::swap(&mut state.position, &mut self.position);
        std::mem::swap(&mut state.velocity, &mut self.velocity);
        Ok(())
    }
}
