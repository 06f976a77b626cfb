//! A solid: tetrahedra, octahedra and atoms in three dimensions, with actions on its faces.

mod broken;
mod gauge;
mod keep;
mod read;

pub use gauge::Gauge;
pub use keep::Kept;
pub use read::Row;

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use super::body::Body;
use super::cost::{Cost, Phase};
use super::error::SolverError;
use super::temperature::Thermometer;
use super::{Settings, Solver, time_step};
use crate::analysis::columns::{Columns, SolidSetting};
use crate::domain::{Domain, Ranks};
use crate::forces::ForceError;
use crate::forces::solid::{self, Forces, Measure};
use crate::lattice::fcc;
use crate::loading::{Action, Load, Ramp, Together, mean};
use crate::material::Material;
use crate::mesh::grouped::masses_of;
use crate::mesh::solid::Solid as Mesh;
use crate::relaxation::{self, Elastic, Target};
use crate::state::{State, times};
use broken::Bonds;

/// What acts on a solid and what is read of it.
pub struct Experiment {
    /// Each with the name that its columns have.
    pub actions: Vec<(String, Box<dyn Action<3>>)>,
    /// Velocities at the start; `None`: at rest.
    pub ramp: Option<Ramp<3>>,
    pub extension: Extension,
    pub gauges: Vec<Gauge>,
}

/// Two ends of a solid, of which the one going away from the other is its nominal strain.
#[derive(Clone, Debug, PartialEq)]
pub struct Extension {
    /// Nodes of the two ends and how many sites of each they stand for.
    pub ends: [Vec<(u32, f64)>; 2],
    /// From the first to the second, of length one.
    pub along: [f64; 3],
    /// Reference distance, nm.
    pub length: f64,
    /// Nominal strain rate, 1/ps, where the motion of both ends is prescribed.
    pub rate: Option<f64>,
}

impl Extension {
    /// Nominal strain of a state, more or less that of the reference state. All ranks must ask for it together.
    fn strain(&self, domain: &Domain, position: &[Vec<f64>; 3]) -> f64 {
        let [low, high] = self.ends.each_ref().map(|end| mean(domain, end, position));
        let along: f64 = (0..3).map(|axis| self.along[axis] * (high[axis] - low[axis])).sum();
        along / self.length
    }
}

/// A solid in motion: its forces, its loading, and what is read of it.
pub struct Solid {
    forces: Forces,
    loading: Together<3>,
    ramp: Option<Ramp<3>>,
    extension: Extension,
    /// That of the reference state.
    strain_at_rest: f64,
    /// When it was last read.
    last_strain: f64,
    setting: SolidSetting,
    measure: Measure,
    thermometer: Thermometer,
    bonds: Bonds,
    /// Interfaces that are open from the start: all where the potential reaches far.
    open_at_start: usize,
    gauges: Vec<Gauge>,
}

impl Solver<Solid, 3> {
    /// The part of this rank in a solid at the start of its loading, which all ranks compute together.
    pub fn of_solid(
        ranks: Ranks,
        mesh: Mesh,
        material: Material,
        experiment: Experiment,
        settings: Settings,
    ) -> Result<Self, SolverError> {
        let start = Instant::now();
        let Experiment {
            actions,
            ramp,
            extension,
            gauges,
        } = experiment;
        let atoms = (mesh.parts..mesh.elements.len()).map(|atom| (mesh.node(atom, 0), mesh.elements[atom].anchor));
        let setting = SolidSetting {
            spacing: mesh.spacing,
            volume: mesh.site_count() as f64 * site_volume(&mesh),
            length: extension.length,
            along: extension.along,
            strain_rate: extension.rate.unwrap_or(f64::NAN),
            nodes: mesh.node_count() as u64,
            elements: mesh.elements.len() as u64,
            represented_atoms: mesh.site_count(),
        };
        let thermometer = Thermometer::new(atoms, material.site_mass);
        let forces = Forces::shared(ranks, mesh, material, settings.summation);
        let forces = forces.with_consistent_mass(settings.consistent_mass);
        let (mesh, mine) = (forces.mesh(), forces.domain().elements());
        let masses = times(masses_of(mesh, &mine), material.site_mass);
        let mut state = State::at_rest(mesh.node_positions_of(&mine), masses);
        if settings.consistent_mass > 0.0 {
            state.couple_masses(mesh, settings.consistent_mass);
        }
        let mut loading = Together::new(actions);
        loading.keep_to(&forces.domain().nodes());
        let solid = Solid {
            thermometer,
            setting,
            bonds: Bonds::new(&forces),
            open_at_start: forces.open_interfaces().len(),
            strain_at_rest: extension.strain(forces.domain(), &state.position),
            last_strain: 0.0,
            loading,
            ramp,
            extension,
            measure: Measure::default(),
            gauges,
            forces,
        };
        solid.start(&mut state);
        Self::of(solid, state, settings, start)
    }

    /// What must be known of this specimen to understand its series.
    pub fn setting(&self) -> &SolidSetting {
        self.body.setting()
    }

    /// The columns of its series, without rows.
    pub fn columns(&self) -> Columns {
        self.body.columns()
    }
}

impl Solid {
    /// What must be known of it to understand its series.
    pub fn setting(&self) -> &SolidSetting {
        &self.setting
    }

    /// Distance of the ends over that of the reference state. All ranks must ask for it together.
    fn measured_strain(&self, state: &State<3>) -> f64 {
        self.extension.strain(self.forces.domain(), &state.position)
    }
}

/// Reference volume of a site, nm^3.
fn site_volume(mesh: &Mesh) -> f64 {
    fcc::SITE_VOLUME * mesh.spacing.powi(3)
}

impl Body<3> for Solid {
    type Load = Together<3>;

    fn domain(&self) -> &Domain {
        self.forces.domain()
    }

    fn domain_mut(&mut self) -> &mut Domain {
        self.forces.domain_mut()
    }

    fn load(&self) -> &Together<3> {
        &self.loading
    }

    fn load_mut(&mut self) -> &mut Together<3> {
        &mut self.loading
    }

    fn spacing(&self) -> f64 {
        self.forces.mesh().spacing
    }

    fn jump_at_cutoff(&self) -> f64 {
        self.forces.material().interaction.jump_at_cutoff()
    }

    fn start(&self, state: &mut State<3>) {
        if let Some(ramp) = &self.ramp {
            let mine = self.forces.domain().elements();
            ramp.set(&self.forces.mesh().node_positions_of(&mine), state);
        }
        self.loading.hold(state);
    }

    fn compute(&mut self, state: &mut State<3>, time: f64, measured: bool) -> Result<(), ForceError> {
        let State { position, force, .. } = state;
        let computed = match measured {
            true => self.forces.compute_and_measure(position, force, &mut self.measure),
            false => self.forces.compute(position, force),
        };
        computed.map_err(|solid::ForceError::FlewAway { element }| ForceError::FlewAway { element })?;
        self.loading.force(state, time);
        Ok(())
    }

    fn stored(&self) -> [f64; 2] {
        let domain = self.forces.domain();
        domain.sum_elements(|element| [self.measure.energy(element), self.measure.pairs(element)])
    }

    fn stability_limit(&self, state: &State<3>) -> f64 {
        time_step::nine_digits(self.forces.squared_frequency_bound(&state.position))
    }

    fn stiffened(&self, state: &State<3>) -> f64 {
        self.forces.close_bonds().squared_frequency() / state.least_share_of_mass()
    }

    fn closest_approach(&self) -> f64 {
        self.forces.close_bonds().closest_approach(self.forces.domain().ranks())
    }

    fn restore_closest_approach(&mut self, length: f64) {
        self.forces.close_bonds_mut().restore_closest_approach(length);
    }

    /// Under its loading at the time 0.
    fn relax(&mut self, state: &mut State<3>, stop: &AtomicBool, tell: &mut dyn FnMut(f64)) -> Result<(), SolverError> {
        let target = Target {
            residual: super::RESIDUAL_AT_START,
            ..Target::default()
        };
        super::share_what_rests(self.forces.domain(), state);
        relaxation::relax_unless(self, state, target, stop, tell)
            .map(drop)
            .map_err(SolverError::NoRest)
    }

    /// Where the loading does not prescribe it, as it was last read.
    fn strain(&self, time: f64) -> f64 {
        self.extension.rate.map_or(self.last_strain, |rate| rate * time)
    }

    fn time_of(&self, strain: f64) -> f64 {
        self.extension.rate.map_or(f64::INFINITY, |rate| strain / rate)
    }

    fn site_of(&self, node: usize) -> [i32; 3] {
        let mesh = self.forces.mesh();
        let element = mesh.element_of_node(node);
        let corner = mesh.nodes_of(element).position(|own| own == node).unwrap_or_default();
        let element = mesh.elements[element];
        element.site(element.corners()[corner])
    }

    fn reference_place(&self, node: usize) -> Vec<f64> {
        self.forces.mesh().sites.frame.place(self.site_of(node)).to_vec()
    }

    fn place_of_element(&self, element: usize) -> Vec<f64> {
        self.reference_place(self.forces.mesh().node(element, 0))
    }

    fn rebook(&self, cost: &mut Cost) {
        cost.rebook(Phase::Forces, Phase::Neighbours, self.forces.search_cost());
        cost.rebook(Phase::Forces, Phase::Exchange, self.forces.exchange_cost());
    }
}

impl Elastic<3> for Solid {
    fn domain(&self) -> &Domain {
        self.forces.domain()
    }

    fn domain_mut(&mut self) -> &mut Domain {
        self.forces.domain_mut()
    }

    fn material(&self) -> &Material {
        self.forces.material()
    }

    fn compute(&mut self, state: &mut State<3>) -> Result<(), ForceError> {
        Body::compute(self, state, 0.0, false)
    }

    /// No node is stiffer than the highest frequency and its mass allow.
    fn stiffness_of_nodes(&mut self, state: &State<3>) -> Result<Vec<f64>, ForceError> {
        let bound = self.forces.squared_frequency_bound(&state.position);
        Ok(state.mass.iter().map(|mass| bound * mass).collect())
    }
}
