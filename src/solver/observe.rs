//! What a run gives its observers, and when.

use std::time::Instant;

use super::j_integral::Rings;
use super::{Measure, Moment, Observer, Phase, Progress, Reading, RunError, Solver, probe, temperature};
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
        self.settle();
        let mut clock = Instant::now();
        let measure = self.forces.measure_computed(&self.state.position);
        if probe {
            self.probe(observer, &measure)?;
        }
        if snapshot {
            let broken = self.forces.broken_bonds(&self.state.position);
            let moment = Moment {
                step: self.step,
                time: self.time,
                strain: self.strain(),
                mesh: self.forces.mesh(),
                state: &self.state,
                measure: &measure,
                broken: &broken,
            };
            observer.snapshot(&moment).map_err(RunError::Output)?;
        }
        self.cost.book(Phase::Output, &mut clock);
        Ok(())
    }

    fn probe<O: Observer>(&mut self, observer: &mut O, measure: &Measure) -> Result<(), RunError<O::Error>> {
        let number = self.probes.taken() - 1;
        let bonds = self.changed_bonds(number as u32);
        if let Some(tracker) = &mut self.tracker {
            bonds.iter().for_each(|event| tracker.apply(event));
            self.stop.follow(tracker.tip().x, self.time);
        }
        let row = self.probe_row(measure);
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

    fn probe_row(&mut self, measure: &Measure) -> Probe {
        let kinetic = self.state.kinetic_energy();
        let balance = self.ledger.balance(measure, kinetic);
        let [sigma_xx, sigma_yy, sigma_xy] = probe::average_stress(self.forces.mesh(), measure, &self.setting);
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
            temperature: temperature::kinetic_temperature(self.forces.mesh(), &self.state),
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
