//! A finer mesh on the way.

use std::time::Instant;

use super::body::Instruments;
use super::cost::Phase;
use super::error::SolverError;
use super::{Solver, time_step};
use crate::loading::Load;

impl<B: Instruments<D>, const D: usize> Solver<B, D> {
    /// Where it is time to look, goes over to a finer mesh if the present one is too coarse for what it carries. All ranks decide
    /// alike, from the state alone, and at times that are fixed. A shorter step follows at once from what is stiffer.
    pub(super) fn refine(&mut self) -> Result<(), SolverError> {
        if self.body.looks_every().is_none() || !self.looks.take(self.clock.time, self.clock.time_step, false) {
            return Ok(());
        }
        let mut clock = Instant::now();
        self.settle();
        if self.body.is_too_coarse(&mut self.state) {
            if !self.measured {
                self.compute(true).map_err(|source| self.blow_up(source))?;
            }
            let before = self.energies();
            self.body.refine(&mut self.state);
            self.compute(true).map_err(|source| self.blow_up(source))?;
            let after = self.energies();
            self.ledger.refine(before, after);
            self.follow_finer_mesh()?;
        }
        self.cost.book(Phase::Refinement, &mut clock);
        Ok(())
    }

    /// What has become atoms may be stiffer; what has stayed an element was looked at before.
    fn follow_finer_mesh(&mut self) -> Result<(), SolverError> {
        let added = self.body.stiffened(&self.state);
        let of_atoms = self.body.stability_limit_of_atoms(&self.state);
        let of_atoms = time_step::without_close_bonds(of_atoms, added, self.stability_limit);
        self.stability_limit = self.stability_limit.min(of_atoms);
        let (time_step, limit) = (self.settings.time_step, self.stability_limit);
        let longest = self.body.load().longest_step(self.body.spacing());
        let calm = time_step.choose(limit, longest).map_err(|_| self.step_unstable())?;
        self.longest_step = self.longest_step.min(calm);
        let next = time_step.follow(self.clock.time_step, self.longest_step, [limit, added], None);
        let next = next.ok_or_else(|| self.step_unstable())?;
        for step in [&mut self.clock.time_step, &mut self.step_after_next] {
            *step = step.min(next);
        }
        Ok(())
    }

    /// Potential energy, eV, pairs within the cutoff, and kinetic energy, eV.
    fn energies(&self) -> [f64; 3] {
        let [potential, pairs] = self.body.stored();
        let (domain, state) = (self.body.domain(), &self.state);
        let [kinetic] = domain.sum_nodes(|node| [state.kinetic_energy_of(node)]);
        [potential, pairs, kinetic]
    }
}
