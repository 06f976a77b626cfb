//! What a run gives its observers, and when.

use std::time::Instant;

use super::Solver;
use super::body::{Instruments, Totals};
use super::cost::Phase;
use super::error::RunError;
use super::observer::{Moment, Observer, Progress};
use crate::loading::Load;

impl<B: Instruments<D>, const D: usize> Solver<B, D> {
    /// Gives observers what is due; at the end of a run all that is not yet given. All ranks take part, and only the first has
    /// observers that it gives anything to.
    pub(super) fn observe<O: Observer<B, D>>(
        &mut self,
        observer: &mut O,
        at_end: bool,
    ) -> Result<(), RunError<O::Error>> {
        let probe = self.probes.take(self.clock.time, self.clock.time_step, at_end);
        let snapshot = self.snapshots.take(self.clock.time, self.clock.time_step, at_end);
        if !probe && !snapshot {
            return Ok(());
        }
        let mut clock = Instant::now();
        self.settle();
        if !self.measured {
            self.compute(true).map_err(|source| self.blow_up(source))?;
        }
        if probe {
            self.probe(observer)?;
        }
        if snapshot {
            self.snapshot(observer)?;
        }
        self.cost.book(Phase::Output, &mut clock);
        Ok(())
    }

    fn snapshot<O: Observer<B, D>>(&mut self, observer: &mut O) -> Result<(), RunError<O::Error>> {
        let broken = self.body.picture(&mut self.state);
        let moment = Moment {
            step: self.clock.step,
            time: self.clock.time,
            strain: self.strain(),
            mesh: self.body.mesh(),
            domain: self.body.domain(),
            state: &self.state,
            measure: self.body.measure(),
            broken: &broken,
            mesh_changes: self.body.looks_every().is_some(),
        };
        observer.snapshot(&moment).map_err(RunError::Output)
    }

    fn probe<O: Observer<B, D>>(&mut self, observer: &mut O) -> Result<(), RunError<O::Error>> {
        let totals = self.totals();
        if let Some(reading) = self.body.read(&mut self.state, &totals) {
            observer.probe(&reading).map_err(RunError::Output)?;
            observer.progress(&self.progress());
        }
        let strain = self.strain();
        let ranks = self.body.domain().ranks();
        let unresolved = self.body.load().unresolved(&self.state, self.clock.time_step, ranks);
        self.ledger
            .check(self.clock.step, self.clock.time, strain, unresolved, || {
                self.fastest_node()
            })?;
        Ok(())
    }

    /// Sums over the whole specimen, which all ranks must ask for together.
    fn totals(&mut self) -> Totals {
        let domain = self.body.domain();
        let [kinetic] = domain.sum_nodes(|node| [self.state.kinetic_energy_of(node)]);
        let work = self.body.load().work(domain.ranks());
        Totals {
            probe: self.probes.taken() - 1,
            clock: self.clock,
            kinetic,
            balance: self.ledger.balance(self.body.stored(), kinetic, work),
        }
    }

    pub(super) fn progress(&self) -> Progress {
        let time_of = |strain| self.body.time_of(strain);
        let clock = self.clock;
        Progress {
            step: clock.step,
            of: (self.settings.until).steps(clock.step, clock.time, clock.time_step, time_of),
            time: clock.time,
            strain: self.strain(),
            tip: self.body.tip(),
            residual: None,
        }
    }

    /// Where the fastest node of all ranks was before the loading.
    fn fastest_node(&self) -> Vec<f64> {
        // What is no number is faster than anything.
        let squared = |node: usize| {
            let squares = self.state.velocity.iter().map(|plane| plane[node] * plane[node]);
            squares.sum::<f64>().min(f64::INFINITY)
        };
        let domain = self.body.domain();
        let mine = domain.nodes().into_iter().flatten();
        let fastest = mine.max_by(|&a, &b| squared(a).total_cmp(&squared(b)));
        let speed = fastest.map_or(0.0, squared);
        let is_mine = speed == domain.ranks().largest(speed);
        let told = fastest.filter(|_| is_mine).map_or(u64::MAX, |node| node as u64);
        self.body.reference_place(domain.ranks().least(told) as usize)
    }
}
