//! What a probe reads of a solid.

use super::keep::Kept;
use super::{Solid, site_volume};
use crate::analysis::columns::Columns;
use crate::forces::solid::Measure;
use crate::mesh::solid::Solid as Mesh;
use crate::solver::body::{Instruments, Totals};
use crate::solver::clock::Clock;
use crate::solver::until::{Ending, Until};
use crate::state::State;

/// A row of the series of a solid: a number for each of its [`Columns`].
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    pub step: u64,
    pub numbers: Vec<f64>,
}

/// Components of a vector and of a symmetric tensor, in the order of their numbers.
const AXES: [&str; 3] = ["x", "y", "z"];
const COMPONENTS: [&str; 6] = ["xx", "yy", "zz", "yz", "xz", "xy"];

impl Instruments<3> for Solid {
    type Mesh = Mesh;
    type Measure = Measure;
    /// Of each element the share of the nearest-neighbour bonds of its sites that are broken; empty but on the first rank.
    type Broken = Vec<f64>;
    type Reading = Row;
    type Kept = Kept;

    fn mesh(&self) -> &Mesh {
        self.forces.mesh()
    }

    fn into_mesh(self) -> Mesh {
        self.forces.into_mesh()
    }

    fn measure(&self) -> &Measure {
        &self.measure
    }

    fn ending(&self, until: &Until, clock: Clock) -> Option<Ending> {
        until.is_reached(clock, |time| self.strain_by_rate(time))
    }

    /// All ranks read; the first alone is given what is read.
    fn read(&mut self, state: &mut State<3>, totals: &Totals) -> Option<Row> {
        self.last_strain = self.measured_strain(state) - self.strain_at_rest;
        let domain = self.forces.domain();
        let Totals {
            clock,
            kinetic,
            balance,
            ..
        } = *totals;
        let mut numbers = vec![clock.time, self.last_strain];
        numbers.extend(self.mean_stress());
        numbers.extend([kinetic, balance.potential, balance.work, balance.cutoff_release]);
        let velocities = state.velocity.iter_mut();
        velocities.for_each(|plane| domain.gather_atoms(plane));
        numbers.push(self.thermometer.read(state));
        numbers.push((self.forces.open_interfaces().len() - self.open_at_start) as f64);
        numbers.push(self.bonds.broken(&self.forces, &mut state.position).len() as f64);
        numbers.extend(self.loading.pulls(state, domain.ranks()).into_flattened());
        let volume = site_volume(self.forces.mesh());
        let gauges = self.gauges.iter();
        numbers.extend(gauges.flat_map(|gauge| gauge.read(domain, state, &self.measure, volume)));
        let step = clock.step;
        domain.ranks().is_first().then_some(Row { step, numbers })
    }

    fn picture(&mut self, state: &mut State<3>) -> Vec<f64> {
        let broken = self.bonds.broken(&self.forces, &mut state.position);
        match self.forces.domain().ranks().is_first() {
            true => self.bonds.damage(self.forces.mesh(), &broken),
            false => Vec::new(),
        }
    }

    fn open_interfaces(&self) -> Vec<u32> {
        self.forces.open_interfaces()
    }

    fn keep(&self) -> Kept {
        Kept {
            works: self.loading.booked(self.forces.domain().ranks()),
            last_strain: self.last_strain,
        }
    }

    fn check_is_own(&self, open_interfaces: &[u32], kept: &Kept) -> Result<(), &'static str> {
        let interfaces = self.forces.interface_count();
        if open_interfaces.iter().any(|&number| number as usize >= interfaces) {
            return Err("it has other interfaces");
        }
        match kept.works.len() == self.loading.node_count() {
            true => Ok(()),
            false => Err("its loading acts on another number of nodes"),
        }
    }

    fn restore(&mut self, open_interfaces: &[u32], kept: &Kept) {
        self.forces.restore_open_interfaces(open_interfaces);
        self.loading.restore(&kept.works);
        self.last_strain = kept.last_strain;
    }
}

impl Solid {
    /// Zero where the loading does not prescribe it: then no strain ends a run.
    fn strain_by_rate(&self, time: f64) -> f64 {
        self.extension.rate.map_or(0.0, |rate| rate * time)
    }

    /// Average virial stress xx, yy, zz, yz, xz, xy over the reference volume, eV/nm^3.
    fn mean_stress(&self) -> [f64; 6] {
        let sums = self
            .forces
            .domain()
            .sum_elements(|element| self.measure.virial(element));
        sums.map(|virial| virial / self.setting.volume)
    }

    /// Names and units of what a row holds.
    pub fn columns(&self) -> Columns {
        let named = |name: &str, unit: &'static str| (name.to_owned(), unit);
        let mut names = vec![named("time", "ps"), named("strain", "1")];
        let parts = |of: &str, parts: &[&str], unit: &'static str| -> Vec<(String, &'static str)> {
            parts.iter().map(|part| (format!("{of}_{part}"), unit)).collect()
        };
        names.extend(parts("sigma", &COMPONENTS, "eV/nm^3"));
        names.extend(["kinetic", "potential", "work", "cutoff_release"].map(|name| named(name, "eV")));
        names.extend([
            named("temperature", "K"),
            named("open_interfaces", "1"),
            named("broken_bonds", "1"),
        ]);
        for action in self.loading.names() {
            names.extend(parts(&format!("{action}_force"), &AXES, "eV/nm"));
        }
        for gauge in &self.gauges {
            names.extend(parts(&format!("{}_velocity", gauge.name), &AXES, "nm/ps"));
            names.extend(parts(&format!("{}_sigma", gauge.name), &COMPONENTS, "eV/nm^3"));
        }
        Columns::named(names)
    }
}
