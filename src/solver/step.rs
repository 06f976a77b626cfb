//! One step in time, and what can go wrong in it.

use std::time::Instant;

use super::schedule::Schedule;
use super::{Phase, Solver, SolverError, time_step};
use crate::forces::{AtomMotion, ForceError, Motion, Planes};
use crate::integrator;
use crate::loading::Impulse;
use crate::state::{State, Strip};

/// Steps between comparisons of what ranks have spent.
const COMPARE_EVERY: u64 = 100;

/// Who looks at the state after a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Looks {
    Always,
    /// Observers that something is due for.
    WhenDue,
    Never,
}

impl Solver {
    /// One step of central differences.
    pub fn advance(&mut self) -> Result<(), SolverError> {
        self.step_on(Looks::Always)?;
        self.settle();
        Ok(())
    }

    /// So many steps, the same to the bit, of which nobody looks at any but the last.
    pub fn advance_by(&mut self, steps: u64) -> Result<(), SolverError> {
        (1..steps).try_for_each(|_| self.step_on(Looks::Never))?;
        self.advance()
    }

    /// Gives the velocities the half kick that they still lack.
    pub(super) fn settle(&mut self) {
        if let Some(time) = self.due_kick.take() {
            integrator::kick(&mut self.state, &self.forces.domain().nodes(), time);
        }
    }

    /// One step whose last half kick is left due; where nobody looks at it, the motion of the next step may be done, too.
    pub(super) fn step_on(&mut self, looks: Looks) -> Result<(), SolverError> {
        let mut clock = Instant::now();
        let time_step = self.time_step;
        if self.due_kick.is_some_and(|due| due != 0.5 * time_step) {
            self.settle();
        }
        let kicks = 1 + u32::from(self.due_kick.take().is_some());
        self.grip_impulse.add(&self.state, 0.5 * time_step);
        let nodes = self.forces.domain().nodes();
        if !std::mem::take(&mut self.is_ahead) {
            integrator::kick_and_drift(&mut self.state, &nodes, integrator::leap(kicks, time_step));
        }
        self.loading.absorb(&mut self.state, &nodes, time_step);
        self.step += 1;
        self.time += time_step;
        self.cost.book(Phase::Motion, &mut clock);
        let is_observed = match looks {
            Looks::Always => true,
            Looks::WhenDue => self.will_be_observed(),
            Looks::Never => false,
        };
        if !is_observed && self.may_run_ahead() {
            self.compute_and_move().map_err(|source| self.blow_up(source))?;
        } else {
            self.compute(is_observed).map_err(|source| self.blow_up(source))?;
            self.due_kick = Some(0.5 * time_step);
        }
        self.cost.book(Phase::Forces, &mut clock);
        self.grip_impulse.add(&self.state, 0.5 * time_step);
        self.cost.book(Phase::Motion, &mut clock);
        let [present, limit] = [self.time_step, self.stability_limit];
        let chosen = self.settings.time_step;
        if chosen.is_to_be_checked(self.step, present, limit)
            || chosen.follows_forces(self.step) && time_step::is_rough(self.hardest_push())
        {
            self.stability_limit = time_step::limit(&self.forces, &self.state);
            let adapted = chosen.adapt(self.time_step, self.stability_limit);
            self.time_step = adapted.ok_or_else(|| self.step_unstable())?;
            self.cost.book(Phase::Stability, &mut clock);
        }
        if self.step.is_multiple_of(COMPARE_EVERY) {
            let is_unbalanced = self.forces.is_unbalanced();
            self.cost.book(Phase::Exchange, &mut clock);
            if is_unbalanced {
                self.cut_anew();
                self.cost.book(Phase::Cut, &mut clock);
            }
        }
        Ok(())
    }

    /// How far the force on a node moves it within a step, over the spacing of the lattice: the largest of all ranks.
    fn hardest_push(&self) -> f64 {
        let domain = self.forces.domain();
        let nodes = domain.nodes().into_iter();
        let largest = nodes.map(|nodes| integrator::largest_squared_acceleration(&self.state, nodes));
        let largest = domain.ranks().largest(largest.fold(0.0, f64::max));
        largest.sqrt() * self.time_step * self.time_step / self.setting.spacing
    }

    /// Cuts the specimen anew. It leaves no trace in the results.
    fn cut_anew(&mut self) {
        let domain = self.forces.domain();
        let State {
            position,
            velocity,
            force,
            ..
        } = &mut self.state;
        let planes = position.iter_mut().chain(velocity).chain(force);
        planes.for_each(|plane| domain.share_nodes(plane));
        let impulses = self.grip_impulse.gathered(domain.ranks());
        let absorbed = self.loading.absorbed(domain.ranks());
        self.forces.cut_anew();
        let nodes = self.forces.domain().nodes();
        self.grip_impulse = Impulse::new(&self.loading, &nodes);
        self.grip_impulse.restore(&impulses);
        self.loading.restore_absorbed(&absorbed, &nodes);
        // What elements hold is known to the ranks that computed them before.
        self.measured = false;
    }

    /// Forces at the present positions, and what elements hold if it is asked for.
    pub(super) fn compute(&mut self, measured: bool) -> Result<(), ForceError> {
        let State { position, force, .. } = &mut self.state;
        self.measured = measured;
        if measured {
            self.forces.compute_and_measure(position, force, &mut self.measure)
        } else {
            self.forces.compute(position, force)
        }
    }

    /// Whether observers are given something at this time. Where the time step changes afterwards, it may turn out
    /// otherwise.
    fn will_be_observed(&self) -> bool {
        let is_due = |schedule: &Schedule| schedule.is_due(self.time, self.time_step);
        is_due(&self.probes) || is_due(&self.snapshots) || self.ending().is_some()
    }

    /// Whether nobody stops the run, cuts the specimen anew or changes the time step before the next step.
    fn may_run_ahead(&self) -> bool {
        let chosen = self.settings.time_step;
        !(self.forces.domain().is_called()
            || chosen.is_to_be_checked(self.step, self.time_step, self.stability_limit)
            || chosen.follows_forces(self.step)
            || self.step.is_multiple_of(COMPARE_EVERY))
    }

    /// Forces at the present positions and the motion of the next step, which passes through the memory with them.
    fn compute_and_move(&mut self) -> Result<(), ForceError> {
        if self.next[0].is_empty() {
            self.inertias = self.state.inertias(self.forces.mesh());
            self.next = self.state.position.clone();
            self.next_velocity = self.state.velocity.clone();
        }
        let State {
            position,
            velocity,
            force,
            mobility,
            mass,
            ..
        } = &mut self.state;
        let leap = integrator::leap(2, self.time_step);
        let atoms = AtomMotion {
            leap,
            mobility: mass.last().map_or(0.0, |mass| 1.0 / mass),
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
            velocity: &mut self.next_velocity,
            next: &mut self.next,
            advance: &advance,
            atoms,
        };
        let (left, Motion { velocity, next, .. }) = self.forces.compute_and_move(position, force, motion)?;
        ahead.triangles(
            self.forces.mesh(),
            &left.triangles,
            [position, force],
            [&mut *velocity, &mut *next],
        );
        for nodes in &left.atoms {
            ahead.atoms(nodes, [position, force], [&mut *velocity, &mut *next]);
        }
        std::mem::swap(&mut self.state.position, &mut self.next);
        std::mem::swap(&mut self.state.velocity, &mut self.next_velocity);
        self.is_ahead = true;
        self.measured = false;
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
            place: self.reference_place(self.mesh().node(source.element(), 0)),
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
