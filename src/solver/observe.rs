//! What a run gives its observers, and when.

use std::time::Instant;

use super::j_integral::Rings;
use super::ledger::Balance;
use super::{Moment, Observer, Phase, Progress, Reading, RunError, Solver, probe};
use crate::analysis::series::{BondEvent, Probe, RINGS};
use crate::forces::Summation;

/// What a probe tells of the whole specimen.
struct Totals {
    /// eV
    kinetic: f64,
    balance: Balance,
    /// Average virial stress xx, yy, xy, eV/nm^3.
    stress: [f64; 3],
}

impl Solver {
    /// Gives observers what is due; at the end of a run all that is not yet given. All ranks take part, and only the first has
    /// observers that it gives anything to.
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
        if probe {
            self.probe(observer)?;
        }
        if snapshot {
            self.snapshot(observer)?;
        }
        self.cost.book(Phase::Output, &mut clock);
        Ok(())
    }

    fn snapshot<O: Observer>(&mut self, observer: &mut O) -> Result<(), RunError<O::Error>> {
        let broken = self.forces.broken_bonds(&self.state.position);
        self.gather_motion();
        self.measure.gather(self.forces.domain());
        if !self.ranks().is_first() {
            return Ok(());
        }
        let moment = Moment {
            step: self.step,
            time: self.time,
            strain: self.strain(),
            mesh: self.forces.mesh(),
            state: &self.state,
            measure: &self.measure,
            broken: &broken,
        };
        observer.snapshot(&moment).map_err(RunError::Output)
    }

    /// All ranks follow the crack and the energy; the first alone reads the rest.
    fn probe<O: Observer>(&mut self, observer: &mut O) -> Result<(), RunError<O::Error>> {
        let number = self.probes.taken() - 1;
        let bonds = self.changed_bonds(number as u32);
        if let Some(crack) = &mut self.crack {
            let front = crack.follow(&bonds, number as u32);
            self.stop.follow(crack.tip().x, front, self.time);
            if crack.has_left_plane() {
                self.stop.leave_plane(self.time);
            }
            let is_wanted = self.settings.until.after_branch.is_some() && self.stop.branched().is_infinite();
            if is_wanted && !bonds.is_empty() && crack.has_branch() {
                self.stop.branch(self.time);
            }
        }
        let totals = self.totals();
        let rings = self.rings();
        self.bring_into_sight(rings);
        if self.ranks().is_first() {
            self.give(observer, totals, rings, &bonds)?;
        }
        self.ledger
            .check(self.step, self.time, self.strain(), || self.fastest_node())?;
        Ok(())
    }

    /// Sums over the whole specimen, which all ranks must ask for together.
    fn totals(&mut self) -> Totals {
        let domain = self.forces.domain();
        let ranks = domain.ranks();
        let [kinetic] = domain.sum_nodes(|node| [self.state.kinetic_energy_of(node)]);
        let absorbed: f64 = self.loading.absorbed(ranks).iter().sum();
        let work = self.loading.work(&self.grip_impulse.gathered(ranks)) - absorbed;
        let stored = [self.measure.energy(domain), self.measure.pairs(domain)];
        let mesh = self.forces.mesh();
        Totals {
            kinetic,
            balance: self.ledger.balance(stored, kinetic, work),
            stress: self.interior.average_stress(mesh, domain, &self.measure, &self.setting),
        }
    }

    fn give<O: Observer>(
        &mut self,
        observer: &mut O,
        totals: Totals,
        rings: Option<Rings>,
        bonds: &[BondEvent],
    ) -> Result<(), RunError<O::Error>> {
        let row = self.probe_row(totals, rings);
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
            bonds,
        };
        observer.probe(&reading).map_err(RunError::Output)?;
        observer.progress(&self.progress());
        Ok(())
    }

    pub(super) fn progress(&self) -> Progress {
        let time_of = |strain| self.loading.time_of(strain);
        let until = &self.settings.until;
        Progress {
            step: self.step,
            of: until.steps(self.step, self.time, self.time_step, time_of),
            time: self.time,
            strain: self.strain(),
            tip: self.crack.as_ref().map(|crack| crack.place(self.stop.farthest_tip())),
            residual: None,
        }
    }

    /// Where the fastest node of all ranks was before the loading.
    fn fastest_node(&self) -> [f64; 2] {
        let [x, y] = &self.state.velocity;
        // What is no number is faster than anything.
        let squared = |node: usize| (x[node] * x[node] + y[node] * y[node]).min(f64::INFINITY);
        let domain = self.forces.domain();
        let mine = domain.nodes().into_iter().flatten();
        let fastest = mine.max_by(|&a, &b| squared(a).total_cmp(&squared(b)));
        let speed = fastest.map_or(0.0, squared);
        let is_mine = speed == domain.ranks().largest(speed);
        let told = fastest.filter(|_| is_mine).map_or(u64::MAX, |node| node as u64);
        self.reference_place(domain.ranks().least(told) as usize)
    }

    fn probe_row(&mut self, totals: Totals, rings: Option<Rings>) -> Probe {
        let Totals {
            kinetic,
            balance,
            stress: [sigma_xx, sigma_yy, sigma_xy],
        } = totals;
        let area = probe::mean_length(self.forces.mesh()) * self.setting.thickness;
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
            j_integral: rings.map_or([f64::NAN; RINGS], |rings| {
                self.j_integral.evaluate(self.forces.mesh(), &self.state, rings)
            }),
        }
    }

    /// Rings around the tip, in which J is read; `None` where there is no tip or no room for them, and where bonds of nodes
    /// stand for all others, so that the stress of the bonds is not what moves the nodes.
    fn rings(&self) -> Option<Rings> {
        let crack = self.crack.as_ref();
        let crack = crack.filter(|_| self.settings.summation != Summation::Nodal);
        crack?.rings(self.forces.mesh())
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
