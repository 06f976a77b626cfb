//! One step in time, and what can go wrong in it.

use std::time::Instant;

use super::body::Instruments;
use super::clock::Clock;
use super::cost::Phase;
use super::error::SolverError;
use super::schedule::Schedule;
use super::{Solver, time_step};
use crate::forces::ForceError;
use crate::integrator;
use crate::loading::Load;

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

impl<B: Instruments<D>, const D: usize> Solver<B, D> {
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
            integrator::kick(&mut self.state, &self.body.domain().nodes(), time);
        }
    }

    /// One step whose last half kick is left due; where nobody looks at it, the motion of the next step may be done, too.
    pub(super) fn step_on(&mut self, looks: Looks) -> Result<(), SolverError> {
        let mut clock = Instant::now();
        let time_step = self.clock.time_step;
        if self.due_kick.is_some_and(|due| due != 0.5 * time_step) {
            self.settle();
        }
        let kicks = 1 + u32::from(self.due_kick.take().is_some());
        let nodes = self.body.domain().nodes();
        if !std::mem::take(&mut self.is_ahead) {
            integrator::kick_and_drift(&mut self.state, &nodes, integrator::leap(kicks, time_step));
        }
        let load = self.body.load_mut();
        load.book(&self.state, 0.5 * time_step);
        load.damp(&mut self.state, &nodes, time_step);
        self.clock.step += 1;
        self.clock.time += time_step;
        self.cost.book(Phase::Motion, &mut clock);
        let is_observed = match looks {
            Looks::Always => true,
            Looks::WhenDue => self.will_be_observed(),
            Looks::Never => false,
        };
        self.is_ahead = match !is_observed && self.may_run_ahead() {
            true => self.compute_and_move(),
            false => self.compute(is_observed).map(|()| false),
        }
        .map_err(|source| self.blow_up(source))?;
        self.due_kick = (!self.is_ahead).then_some(0.5 * time_step);
        self.cost.book(Phase::Forces, &mut clock);
        self.body.load_mut().book(&self.state, 0.5 * time_step);
        self.cost.book(Phase::Motion, &mut clock);
        self.follow_stability(&mut clock)?;
        if self.clock.step.is_multiple_of(COMPARE_EVERY) {
            let is_unbalanced = self.body.is_unbalanced();
            self.cost.book(Phase::Exchange, &mut clock);
            if is_unbalanced {
                self.body.cut_anew(&mut self.state);
                // What elements hold is known to the ranks that computed them before.
                self.measured = false;
                self.cost.book(Phase::Cut, &mut clock);
            }
        }
        Ok(())
    }

    /// Looks at the stability limit where it is time to, and lets the time step follow it and the close bonds of this step.
    ///
    /// What is found here sets the step after the next one: the motion of the next may have been done with the forces.
    fn follow_stability(&mut self, clock: &mut Instant) -> Result<(), SolverError> {
        let Clock {
            step,
            time_step: present,
            ..
        } = self.clock;
        let added = self.body.stiffened(&self.state);
        if self
            .settings
            .time_step
            .is_to_be_checked(step, present, self.stability_limit)
        {
            let found = self.body.stability_limit(&self.state);
            self.stability_limit = time_step::without_close_bonds(found, added, self.stability_limit);
            self.cost.book(Phase::Stability, clock);
        }
        self.clock.time_step = self.step_after_next;
        self.step_after_next = self.follow(added).ok_or_else(|| self.step_unstable())?;
        Ok(())
    }

    /// The time step after the next one, where close bonds add this to the squared highest frequency.
    fn follow(&self, added: f64) -> Option<f64> {
        let Clock { step, time_step, .. } = self.clock;
        let chosen = self.settings.time_step;
        let farthest = chosen.follows_speed(step).then(|| self.farthest());
        chosen.follow(time_step, self.longest_step, [self.stability_limit, added], farthest)
    }

    /// How far the fastest node of all ranks goes in a step, over the spacing of the lattice.
    fn farthest(&self) -> f64 {
        let domain = self.body.domain();
        let nodes = domain.nodes().into_iter();
        let largest = nodes.map(|nodes| integrator::largest_squared_speed(&self.state, nodes));
        let largest = domain.ranks().largest(largest.fold(0.0, f64::max));
        largest.sqrt() * self.clock.time_step / self.body.spacing()
    }

    /// Forces at the present positions, and what elements hold if it is asked for.
    pub(super) fn compute(&mut self, measured: bool) -> Result<(), ForceError> {
        self.measured = measured;
        self.body.compute(&mut self.state, self.clock.time, measured)
    }

    fn compute_and_move(&mut self) -> Result<bool, ForceError> {
        self.measured = false;
        self.body.compute_and_move(&mut self.state, self.clock)
    }

    /// Whether observers are given something at this time, or the mesh is looked at. Where the time step changes afterwards, it may turn out
    /// otherwise.
    fn will_be_observed(&self) -> bool {
        let is_due = |schedule: &Schedule| schedule.is_due(self.clock.time, self.clock.time_step);
        let is_looked_at = self.body.looks_every().is_some() && is_due(&self.looks);
        is_due(&self.probes) || is_due(&self.snapshots) || is_looked_at || self.ending().is_some()
    }

    /// Whether nobody stops the run, cuts the specimen anew or changes the time step before the next step.
    fn may_run_ahead(&self) -> bool {
        let Clock { step, time_step, .. } = self.clock;
        let chosen = self.settings.time_step;
        !(self.body.domain().is_called()
            || chosen.is_to_be_checked(step, time_step, self.stability_limit)
            || chosen.follows_speed(step)
            || self.step_after_next != time_step
            || step.is_multiple_of(COMPARE_EVERY))
    }

    pub(super) fn step_unstable(&self) -> SolverError {
        SolverError::StepUnstable {
            step: self.clock.step,
            time: self.clock.time,
            strain: self.strain(),
            given: self.clock.time_step,
            limit: self.stability_limit,
        }
    }

    pub(super) fn blow_up(&self, source: ForceError) -> SolverError {
        SolverError::BlowUp {
            step: self.clock.step,
            time: self.clock.time,
            strain: self.strain(),
            place: self.body.place_of_element(source.element()),
            source,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::forces::Summation;
    use crate::loading::{Grip, Stretching};
    use crate::material::Material;
    use crate::mesh::sites::Layout;
    use crate::mesh::{Mesh, Plan};
    use crate::potential::{AtCutoff, CutPotential, Interaction, LennardJones};
    use crate::solver::{Settings, TimeStep, Until};

    #[test]
    fn a_step_is_looked_at_where_something_is_due_and_nowhere_else() {
        let shape = LennardJones {
            epsilon: 1.0,
            sigma: 1.0,
        };
        let law = CutPotential::new(shape, 1.5, AtCutoff::Truncated);
        let material = Material::new(Interaction::LennardJones(law), 1.0).expect("the potential binds");
        let mesh = Mesh::new(&Plan {
            layout: Layout {
                block: 5,
                rows: 6,
                triangles: 5,
            },
            element: 5,
            regions: vec![],
            crack: None,
            grip_rows: 5,
            spacing: material.spacing,
        });
        let settings = Settings {
            time_step: TimeStep::Given(0.01),
            summation: Summation::Exact,
            consistent_mass: 0.0,
            refine: None,
            relax: false,
            noise: None,
            until: Until {
                strain: Some(1.0),
                ..Until::default()
            },
            probe_every: 0.1,
            snapshot_every: None,
            checkpoint_every: Duration::from_secs(3600),
            thickness: 1.0,
        };
        let loading = Stretching::new(&mesh, 1e-3, Grip::Clamped, true);
        let mut solver: Solver = Solver::new(mesh, material, loading, settings).expect("the run starts");
        solver.probes.take(0.0, 0.01, false);
        solver.snapshots.take(0.0, 0.01, false);
        for step in 1..=20 {
            solver.step_on(Looks::WhenDue).expect("nothing flies away");
            assert_eq!(solver.measured, step % 10 == 0, "step {step}");
            solver.probes.take(solver.clock.time, solver.clock.time_step, false);
        }
    }
}
