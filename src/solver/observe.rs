//! What a run gives its observers, and when.

use std::time::Instant;

use super::j_integral::Rings;
use super::{Moment, Observer, Phase, Progress, Reading, RunError, Solver, SolverError, probe};
use crate::analysis::crack::Tracker;
use crate::analysis::series::{BondEvent, Probe, RINGS};
use crate::forces::Summation;

impl Solver {
    /// Gives observers what is due; at the end of a run all that is not yet given.
    pub(super) fn observe<O: Observer>(&mut self, observer: &mut O, at_end: bool) -> Result<(), RunError<O::Error>> {
        let probe = self.probes.take(self.time, self.time_step, at_end);
        let snapshot = self.snapshots.take(self.time, self.time_step, at_end);
        if !probe && !snapshot {
            return Ok(());
        }
        let mut clock = Instant::now();
        self.settle();
        if !self.measured {
            self.compute(true).map_err(|source| self.blow_up(source))?;
        }
        self.gather();
        let given = if self.ranks().is_first() {
            self.give(observer, probe, snapshot)
        } else {
            Ok(())
        };
        if let Err(RunError::Output(_)) = given {
            return given;
        }
        self.follow_first(given.is_err())?;
        self.cost.book(Phase::Output, &mut clock);
        given
    }

    /// Brings to the first rank what observers look at.
    fn gather(&mut self) {
        self.gather_motion();
        let domain = self.forces.domain();
        self.state.force.iter_mut().for_each(|plane| domain.gather_nodes(plane));
        self.measure.gather(domain);
        self.grip_impulses = self.grip_impulse.gathered(domain.ranks());
        self.absorbed = self.loading.absorbed(domain.ranks()).iter().sum();
    }

    /// All ranks learn what only the first knows and what ends a run.
    fn follow_first(&mut self, has_failed: bool) -> Result<(), SolverError> {
        let has_failed = f64::from(u8::from(has_failed));
        let mut told = [has_failed, self.stop.last_advance(), self.stop.farthest_tip()];
        self.ranks().follow_first(&mut told);
        let [has_failed, last_advance, farthest_tip] = told;
        self.stop.restore(last_advance, farthest_tip);
        if has_failed > 0.0 && !self.ranks().is_first() {
            return Err(SolverError::ToldByFirstRank);
        }
        Ok(())
    }

    fn give<O: Observer>(&mut self, observer: &mut O, probe: bool, snapshot: bool) -> Result<(), RunError<O::Error>> {
        if probe {
            self.probe(observer)?;
        }
        if snapshot {
            let broken = self.forces.broken_bonds(&self.state.position);
            let moment = Moment {
                step: self.step,
                time: self.time,
                strain: self.strain(),
                mesh: self.forces.mesh(),
                state: &self.state,
                measure: &self.measure,
                broken: &broken,
            };
            observer.snapshot(&moment).map_err(RunError::Output)?;
        }
        Ok(())
    }

    fn probe<O: Observer>(&mut self, observer: &mut O) -> Result<(), RunError<O::Error>> {
        let number = self.probes.taken() - 1;
        let bonds = self.changed_bonds(number as u32);
        if let Some(tracker) = &mut self.tracker {
            bonds.iter().for_each(|event| tracker.apply(event));
            self.stop.follow(tracker.tip().x, self.time);
        }
        let row = self.probe_row();
        let measure = &self.measure;
        let profile = self.profile.stress(measure, &self.setting);
        let traction = self.traction.read(self.forces.material(), &self.state);
        let reading = Reading {
            probe: &row,
            profile: &profile,
            traction: &traction,
            gauges: &self
                .gauges
                .read(self.forces.mesh(), &self.state, measure, &self.setting),
            bonds: &bonds,
        };
        observer.probe(&reading).map_err(RunError::Output)?;
        observer.progress(&Progress {
            step: self.step,
            of: self
                .settings
                .until
                .steps(self.step, self.time, self.time_step, |strain| {
                    self.loading.time_of(strain)
                }),
            time: self.time,
            strain: self.strain(),
            tip: self.tracker.as_ref().map(|_| self.stop.farthest_tip()),
        });
        self.ledger
            .check(self.step, self.time, self.strain(), || self.fastest_node())?;
        Ok(())
    }

    /// Where the fastest node was before the loading.
    fn fastest_node(&self) -> [f64; 2] {
        let [x, y] = &self.state.velocity;
        let squared = |node: usize| x[node] * x[node] + y[node] * y[node];
        let fastest = (0..self.state.nodes()).max_by(|&a, &b| squared(a).total_cmp(&squared(b)));
        self.reference_place(fastest.unwrap_or_default())
    }

    fn probe_row(&mut self) -> Probe {
        let measure = &self.measure;
        let kinetic = self.state.kinetic_energy();
        let work = self.loading.work(&self.grip_impulses) - self.absorbed;
        let balance = self.ledger.balance(measure, kinetic, work);
        let [sigma_xx, sigma_yy, sigma_xy] = self.interior.average_stress(measure, &self.setting);
        let area = self.setting.length * self.setting.thickness;
        Probe {
            step: self.step,
            time: self.time,
            strain: self.strain(),
            sigma_xx,
            sigma_yy,
            sigma_xy,
            grip_stress: self.loading.grip_force(&self.state) / area,
            kinetic,
            potential: balance.potential,
            work: balance.work,
            cutoff_release: balance.cutoff_release,
            temperature: self.thermometer.read(&self.state),
            j_integral: self.j_integral(),
        }
    }

    /// J in the rings around the tip; not a number where there is no tip or no room for rings, and where bonds of nodes
    /// stand for all others, so that the stress of the bonds is not what moves the nodes.
    fn j_integral(&mut self) -> [f64; RINGS] {
        if self.settings.summation == Summation::Nodal {
            return [f64::NAN; RINGS];
        }
        let mesh = self.forces.mesh();
        let tip = self.tracker.as_ref().map(Tracker::tip);
        match tip.and_then(|tip| Rings::around(tip, mesh, &self.setting)) {
            Some(rings) => self.j_integral.evaluate(mesh, &self.state, rings),
            None => [f64::NAN; RINGS],
        }
    }

    /// Bonds that broke or closed since the last probe; remembers those broken now.
    fn changed_bonds(&mut self, probe: u32) -> Vec<BondEvent> {
        let now = self.forces.broken_bonds(&self.state.position);
        let before = if probe == 0 {
            Vec::new()
        } else {
            std::mem::take(&mut self.broken)
        };
        let events = probe::bond_events(&before, &now, probe);
        self.broken = now;
        events
    }
}
