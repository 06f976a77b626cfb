//! One step in time, and what can go wrong in it.

use std::time::Instant;

use super::{Phase, Solver, SolverError, time_step};
use crate::forces::ForceError;
use crate::integrator;

impl Solver {
    /// One step of central differences.
    pub fn advance(&mut self) -> Result<(), SolverError> {
        self.step_on()?;
        self.settle();
        Ok(())
    }

    /// Gives the velocities the half kick that they still lack.
    pub(super) fn settle(&mut self) {
        if let Some(time) = self.due_kick.take() {
            integrator::kick(&mut self.state, time);
        }
    }

    /// One step whose last half kick is left due.
    pub(super) fn step_on(&mut self) -> Result<(), SolverError> {
        let mut clock = Instant::now();
        let time_step = self.time_step;
        if self.due_kick.is_some_and(|due| due != 0.5 * time_step) {
            self.settle();
        }
        let kicks = 1 + u32::from(self.due_kick.take().is_some());
        integrator::kick_and_drift(&mut self.state, kicks, time_step);
        let absorbed = self.loading.absorb(&mut self.state, time_step);
        self.step += 1;
        self.time += time_step;
        self.cost.book(Phase::Motion, &mut clock);
        self.forces
            .compute(&self.state.position, &mut self.state.force)
            .map_err(|source| self.blow_up(source))?;
        self.cost.book(Phase::Forces, &mut clock);
        self.due_kick = Some(0.5 * time_step);
        let power = self.loading.power(&self.state);
        self.ledger.add_work(0.5 * time_step * (self.power + power) - absorbed);
        self.power = power;
        self.cost.book(Phase::Motion, &mut clock);
        if self.step.is_multiple_of(time_step::CHECK_EVERY) {
            self.stability_limit = time_step::limit(&self.forces, &self.state);
            let adapted = self.settings.time_step.adapt(self.time_step, self.stability_limit);
            self.time_step = adapted.ok_or_else(|| self.step_unstable())?;
            self.cost.book(Phase::Stability, &mut clock);
        }
        Ok(())
    }

    fn step_unstable(&self) -> SolverError {
        SolverError::StepUnstable {
            step: self.step,
            time: self.time,
            strain: self.strain(),
            given: self.time_step,
            limit: self.stability_limit,
        }
    }

    pub(super) fn blow_up(&self, source: ForceError) -> SolverError {
        SolverError::BlowUp {
            step: self.step,
            time: self.time,
            strain: self.strain(),
            place: self.reference_place(self.mesh().first_node(source.element())),
            source,
        }
    }

    /// Where a node was before the loading: nm from the left edge, and from the crack plane.
    pub(super) fn reference_place(&self, node: usize) -> [f64; 2] {
        let mesh = self.mesh();
        let [x, y] = mesh.node_positions();
        [x[node] - self.setting.left_x, y[node] - mesh.middle_height()]
    }
}
