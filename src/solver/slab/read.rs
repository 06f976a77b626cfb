//! What a probe reads of a slab.

use super::j_integral::Rings;
use super::keep::Kept;
use super::{Slab, probe};
use crate::analysis::series::{BondEvent, Probe, RINGS};
use crate::forces::Measure;
use crate::mesh::Mesh;
use crate::solver::body::{Instruments, Totals};
use crate::solver::clock::Clock;
use crate::solver::until::{Ending, Until};
use crate::state::State;

/// What a probe reads.
#[derive(Clone, Debug)]
pub struct Reading {
    /// A row of the series.
    pub probe: Probe,
    /// Stress xx, yy, xy along the crack plane, eV/nm^3.
    pub profile: Vec<[f64; 3]>,
    /// Traction x, y across the crack plane in the bins of the profile, eV/nm^3.
    pub traction: Vec<[f64; 2]>,
    /// Velocity x, y (nm/ps) and stress xx, yy, xy (eV/nm^3) of every wave gauge.
    pub gauges: Vec<[f64; 5]>,
    /// Bonds that changed since the row before.
    pub bonds: Vec<BondEvent>,
}

impl Instruments<2> for Slab {
    type Mesh = Mesh;
    type Measure = Measure;
    /// Bonds, ascending.
    type Broken = Vec<[i32; 3]>;
    type Reading = Reading;
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
        let is_reached = until.is_reached(clock, |time| self.loading.strain(time));
        is_reached.or_else(|| self.probes.watch.ending(until, clock.time))
    }

    fn tip(&self) -> Option<f64> {
        let crack = self.probes.crack.as_ref();
        crack.map(|crack| crack.place(self.probes.watch.farthest_tip()))
    }

    /// All ranks follow the crack; the first alone reads the rest.
    fn read(&mut self, state: &mut State, totals: &Totals) -> Option<Reading> {
        let bonds = self.follow_crack(state, totals.probe as u32, totals.clock.time);
        let domain = self.forces.domain();
        let interior = &self.probes.interior;
        let stress = interior.average_stress(self.forces.mesh(), domain, &self.measure, &self.setting);
        let rings = self.rings();
        self.bring_into_sight(state, rings);
        let is_first = self.forces.domain().ranks().is_first();
        is_first.then(|| {
            let probe = self.probe_row(state, totals, stress, rings);
            let (mesh, material) = (self.forces.mesh(), self.forces.material());
            let (probes, setting) = (&self.probes, &self.setting);
            let mut gauges = probes.gauges.read(mesh, state, &self.measure, setting);
            gauges.extend(probes.planes.read(state, &self.measure, setting));
            Reading {
                probe,
                profile: probes.profile.stress(&self.measure, setting),
                traction: probes.traction.read(material, state),
                gauges,
                bonds,
            }
        })
    }

    fn picture(&mut self, state: &mut State) -> Vec<[i32; 3]> {
        self.forces.broken_bonds(&state.position)
    }

    fn open_interfaces(&self) -> Vec<u32> {
        self.forces.open_interfaces()
    }

    fn keep(&self) -> Kept {
        self.kept()
    }

    fn go_to_mesh_of(&mut self, kept: &Kept, nodes: usize, state: &mut State) -> Result<(), &'static str> {
        self.go_to_refined(&kept.refined, nodes, state)
    }

    fn check_is_own(&self, open_interfaces: &[u32], kept: &Kept) -> Result<(), &'static str> {
        self.refuse_foreign(open_interfaces, kept)
    }

    fn restore(&mut self, open_interfaces: &[u32], kept: &Kept) {
        self.go_on_from(open_interfaces, kept);
    }
}

impl Slab {
    /// Follows the crack with the bonds that broke or closed since the last probe, and returns them.
    fn follow_crack(&mut self, state: &State, number: u32, time: f64) -> Vec<BondEvent> {
        let bonds = self.changed_bonds(state, number);
        let probes = &mut self.probes;
        if let Some(crack) = &mut probes.crack {
            let front = crack.follow(&bonds, number);
            probes.watch.follow(crack.tip().x, front, time);
            if crack.has_left_plane() {
                probes.watch.leave_plane(time);
            }
            let is_wanted = probes.looks_for_branches && probes.watch.branched().is_infinite();
            if is_wanted && !bonds.is_empty() && crack.has_branch() {
                probes.watch.branch(time);
            }
        }
        bonds
    }

    /// Bonds that broke or closed since the last probe; remembers those broken now.
    fn changed_bonds(&mut self, state: &State, probe: u32) -> Vec<BondEvent> {
        let now = self.forces.broken_bonds(&state.position);
        let broken = &mut self.probes.broken;
        let before = if probe == 0 { Vec::new() } else { std::mem::take(broken) };
        let events = probe::bond_events(&before, &now, probe);
        *broken = now;
        events
    }

    fn probe_row(&mut self, state: &State, totals: &Totals, stress: [f64; 3], rings: Option<Rings>) -> Probe {
        let Totals {
            clock,
            kinetic,
            balance,
            ..
        } = *totals;
        let [sigma_xx, sigma_yy, sigma_xy] = stress;
        let outruns = self.outruns() as f64;
        let mesh = self.forces.mesh();
        let area = probe::mean_length(mesh) * self.setting.thickness;
        let probes = &mut self.probes;
        Probe {
            step: clock.step,
            time: clock.time,
            strain: self.loading.strain(clock.time),
            sigma_xx,
            sigma_yy,
            sigma_xy,
            grip_stress: self.loading.grip_force(state) / area,
            kinetic,
            potential: balance.potential,
            work: balance.work,
            cutoff_release: balance.cutoff_release,
            refined_energy: balance.refined,
            nodes: mesh.node_count() as f64,
            outruns,
            temperature: probes.thermometer.read(state),
            j_integral: match (rings, &mut probes.j_integral) {
                (Some(rings), Some(integral)) => integral.evaluate(mesh, state, rings),
                _ => [f64::NAN; RINGS],
            },
        }
    }

    /// Rings around the tip, in which J is read; `None` where there is no tip or no room for them, or no J.
    fn rings(&self) -> Option<Rings> {
        let probes = &self.probes;
        let crack = probes.crack.as_ref().filter(|_| probes.j_integral.is_some());
        crack?.rings(self.forces.mesh())
    }
}
