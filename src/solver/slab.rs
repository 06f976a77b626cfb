//! A slab: triangles and atoms in two dimensions, pulled by grips or pushed at a face.

mod ahead;
mod bins;
mod crack;
mod gauges;
pub mod j_integral;
mod keep;
mod planes;
mod probe;
mod read;
mod refinement;
mod setting;
mod sight;
mod traction;
mod watch;

pub use keep::Kept;
pub use probe::site_volume;
pub use read::Reading;

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use super::body::Body;
use super::clock::Clock;
use super::cost::{Cost, Phase};
use super::error::SolverError;
use super::temperature::Thermometer;
use super::{Settings, Solver, time_step};
use crate::analysis::initiation;
use crate::analysis::series::Setting;
use crate::domain::{Domain, Ranks};
use crate::forces::{ForceError, Forces, Measure, Summation};
use crate::loading::{Load, SlabLoad};
use crate::material::Material;
use crate::mesh::Mesh;
use crate::relaxation::{self, Target};
use crate::state::State;
use ahead::Next;
use crack::Crack;
use gauges::Gauges;
use j_integral::JIntegral;
use planes::Planes;
use probe::{Interior, ProfileLine};
use refinement::Refinement;
use sight::Sight;
use traction::Traction;

/// A slab in motion: its forces, its load, and what is read of it.
pub struct Slab {
    forces: Forces,
    loading: SlabLoad,
    setting: Setting,
    measure: Measure,
    next: Next,
    probes: Probes,
    refinement: Option<Refinement>,
}

/// What is read of a slab, and what its readings go on from.
struct Probes {
    interior: Interior,
    profile: ProfileLine,
    traction: Traction,
    gauges: Gauges,
    planes: Planes,
    thermometer: Thermometer,
    /// `None` where bonds of nodes stand for all others, so that the stress of the bonds is not what moves the nodes.
    j_integral: Option<JIntegral>,
    sight: Sight,
    /// Bonds broken at the last probe, ascending.
    broken: Vec<[i32; 3]>,
    crack: Option<Crack>,
    watch: watch::Watch,
    /// Whether branches are looked for.
    looks_for_branches: bool,
}

impl Solver {
    /// A specimen at the start of its loading.
    pub fn new(
        mesh: Mesh,
        material: Material,
        loading: impl Into<SlabLoad>,
        settings: Settings,
    ) -> Result<Self, SolverError> {
        Self::shared(Ranks::alone(), mesh, material, loading, settings)
    }

    /// The part of this rank in what all ranks compute together.
    pub fn shared(
        ranks: Ranks,
        mesh: Mesh,
        material: Material,
        loading: impl Into<SlabLoad>,
        settings: Settings,
    ) -> Result<Self, SolverError> {
        let start = Instant::now();
        let mut loading: SlabLoad = loading.into();
        let mut setting = setting::setting(&mesh, &material, &loading, settings.thickness);
        let element = setting.element_at_crack;
        if settings.refine.is_some() {
            // What it is when the crack comes.
            setting.element_at_crack = 1;
        }
        let probes = Probes::new(&mesh, material, &loading, &setting, element, &settings);
        let mut forces = Forces::shared(ranks, mesh, material, settings.summation);
        let (mesh, mine) = (forces.mesh(), forces.domain().elements());
        let mut state = State::of_elements(mesh, &mine, material.site_mass, settings.consistent_mass);
        loading.pre_stretch(mesh, &mut state);
        loading.start(mesh, &mut state);
        let refine = settings.refine.filter(|_| loading.stretching().is_some());
        let refinement = refine.map(|refine| Refinement::new(refine, &forces, element, &settings));
        forces.look_at(loading.held().into_iter());
        let nothing = loading.nothing_booked();
        loading.belong_to(&forces.domain().nodes(), &nothing);
        let slab = Slab {
            forces,
            loading,
            setting,
            measure: Measure::default(),
            next: Next::default(),
            probes,
            refinement,
        };
        Self::of(slab, state, settings, start)
    }

    /// What the analysis must know of this specimen.
    pub fn setting(&self) -> &Setting {
        self.body.setting()
    }

    /// Centres of the bins of the profile along the crack plane, nm from the left edge.
    pub fn profile_x(&self) -> &[f64] {
        self.body.profile_x()
    }

    /// Where the wave gauges stand, nm from the left edge and from the crack plane.
    pub fn gauge_places(&self) -> Vec<[f64; 2]> {
        self.body.gauge_places()
    }

    /// The same with gauges across the slab, so many nm from its left edge.
    pub fn with_gauges(mut self, at: &[f64]) -> Self {
        let Slab {
            forces,
            setting,
            probes,
            ..
        } = &mut self.body;
        probes.planes = Planes::new(forces.mesh(), setting, at);
        probes.sight.add(probes.planes.elements());
        self
    }
}

impl Probes {
    /// `element`: atoms an edge along the crack plane of the mesh of the start.
    fn new(
        mesh: &Mesh,
        material: Material,
        loading: &SlabLoad,
        setting: &Setting,
        element: u32,
        settings: &Settings,
    ) -> Self {
        let profile = ProfileLine::new(mesh, setting, element);
        let traction = Traction::new(mesh, &material, &profile, setting);
        let gauges = Gauges::new(mesh, setting);
        let has_stress = settings.summation != Summation::Nodal;
        Self {
            interior: Interior::new(mesh),
            thermometer: Thermometer::new(free_atoms(mesh), material.site_mass),
            j_integral: has_stress.then(|| JIntegral::new(mesh, material)),
            sight: Sight::new(mesh, loading, &profile, &traction, &gauges),
            profile,
            traction,
            gauges,
            planes: Planes::default(),
            broken: Vec::new(),
            crack: Crack::new(setting),
            watch: watch::Watch::new(setting),
            looks_for_branches: settings.until.after_branch.is_some(),
        }
    }
}

/// Nodes and sites of the atoms that are not in the grips.
fn free_atoms(mesh: &Mesh) -> impl Iterator<Item = (usize, [i32; 2])> {
    let atoms = mesh.elements.iter().enumerate().skip(mesh.triangles);
    let free = atoms.filter(|(_, atom)| mesh.grip_of(atom) == 0);
    free.map(|(element, atom)| (mesh.node(element, 0), [atom.column, atom.row]))
}

impl Slab {
    /// What the analysis must know of it.
    pub fn setting(&self) -> &Setting {
        &self.setting
    }

    /// Centres of the bins of the profile along the crack plane, nm from the left edge.
    pub fn profile_x(&self) -> &[f64] {
        self.probes.profile.centres()
    }

    /// Where the wave gauges stand, nm from the left edge and from the crack plane.
    pub fn gauge_places(&self) -> Vec<[f64; 2]> {
        [self.probes.gauges.places(), self.probes.planes.places()].concat()
    }

    /// A crack that has set out before the motion begins would be taken for the notch.
    fn refuse_a_crack_that_ran(&self, state: &State) -> Result<(), SolverError> {
        let Some(mut crack) = Crack::new(&self.setting) else {
            return Ok(());
        };
        let broken = self.forces.broken_bonds(&state.position);
        crack.follow(&probe::bond_events(&[], &broken, 0), 0);
        let [notch, tip] = [self.setting.crack_length, crack.tip().x];
        if tip - notch > initiation::far(&self.setting) {
            let strain = self.strain(0.0);
            return Err(SolverError::RanWhileResting { notch, tip, strain });
        }
        Ok(())
    }
}

impl Body<2> for Slab {
    type Load = SlabLoad;

    fn domain(&self) -> &Domain {
        self.forces.domain()
    }

    fn domain_mut(&mut self) -> &mut Domain {
        self.forces.domain_mut()
    }

    fn load(&self) -> &SlabLoad {
        &self.loading
    }

    fn load_mut(&mut self) -> &mut SlabLoad {
        &mut self.loading
    }

    fn spacing(&self) -> f64 {
        self.setting.spacing
    }

    fn jump_at_cutoff(&self) -> f64 {
        self.forces.material().interaction.jump_at_cutoff()
    }

    fn start(&self, state: &mut State) {
        self.loading.start(self.forces.mesh(), state);
    }

    fn compute(&mut self, state: &mut State, time: f64, measured: bool) -> Result<(), ForceError> {
        let State { position, force, .. } = state;
        match measured {
            true => self.forces.compute_and_measure(position, force, &mut self.measure)?,
            false => self.forces.compute(position, force)?,
        }
        self.loading.force(state, time);
        Ok(())
    }

    /// What acts on nodes is added when the forces of all are known: only grips let them move on before.
    fn compute_and_move(&mut self, state: &mut State, clock: Clock) -> Result<bool, ForceError> {
        if self.loading.stretching().is_none() {
            return self.compute(state, clock.time, false).map(|()| false);
        }
        self.next
            .compute_and_move(&mut self.forces, state, clock.time_step)
            .map(|()| true)
    }

    fn stored(&self) -> [f64; 2] {
        let domain = self.forces.domain();
        [self.measure.energy(domain), self.measure.pairs(domain)]
    }

    fn stability_limit(&self, state: &State) -> f64 {
        let bound = self.forces.squared_frequency_bound(state);
        let [least, most] =
            [-1.0, 1.0].map(|sign| time_step::nine_digits(bound * (1.0 + sign * Forces::FREQUENCY_SLACK)));
        if least == most {
            return least;
        }
        // The digits that are kept hang on those that are not, once in some hundred looks.
        time_step::nine_digits(self.forces.squared_frequency_bound_one_by_one(state))
    }

    fn stiffened(&self, state: &State) -> f64 {
        self.forces.close_bonds().squared_frequency() / state.least_share_of_mass()
    }

    fn closest_approach(&self) -> f64 {
        self.forces.close_bonds().closest_approach(self.forces.domain().ranks())
    }

    fn restore_closest_approach(&mut self, length: f64) {
        self.forces.close_bonds_mut().restore_closest_approach(length);
    }

    fn is_unbalanced(&mut self) -> bool {
        self.forces.is_unbalanced()
    }

    fn cut_anew(&mut self, state: &mut State) {
        let before = self.forces.domain().clone();
        let domain = &before;
        let booked = self.loading.booked(domain.ranks());
        self.forces.cut_anew();
        let State {
            position: [x, y],
            velocity: [velocity_x, velocity_y],
            force: [force_x, force_y],
            mobility: [mobility_x, mobility_y],
            mass,
            ..
        } = state;
        let planes = [
            x, y, velocity_x, velocity_y, force_x, force_y, mobility_x, mobility_y, mass,
        ];
        let after = self.forces.domain();
        after.take_over_from(&before, self.forces.mesh(), planes.map(Vec::as_mut_slice));
        self.next.forget_inertias();
        self.loading.belong_to(&self.forces.domain().nodes(), &booked);
    }

    fn stability_limit_of_atoms(&self, state: &State) -> f64 {
        time_step::nine_digits(self.forces.squared_frequency_bound_of_atoms(state))
    }

    fn looks_every(&self) -> Option<f64> {
        let refinement = self.refinement.as_ref()?;
        Some(refinement.looks_every(&self.setting))
    }

    fn is_too_coarse(&mut self, state: &mut State) -> bool {
        self.find_too_coarse(state)
    }

    fn refine(&mut self, state: &mut State) {
        self.refine_further(state);
    }

    fn relax(&mut self, state: &mut State, stop: &AtomicBool, tell: &mut dyn FnMut(f64)) -> Result<(), SolverError> {
        let target = Target {
            residual: super::RESIDUAL_AT_START,
            ..Target::default()
        };
        super::share_what_rests(self.forces.domain(), state);
        relaxation::relax_unless(&mut self.forces, state, target, stop, tell).map_err(SolverError::NoRest)?;
        self.refuse_a_crack_that_ran(state)
    }

    fn strain(&self, time: f64) -> f64 {
        self.loading.strain(time)
    }

    fn time_of(&self, strain: f64) -> f64 {
        self.loading.time_of(strain)
    }

    fn site_of(&self, node: usize) -> [i32; 2] {
        let mesh = self.forces.mesh();
        let element = mesh.element_of_node(node);
        let corners = mesh.nodes_of(element).zip(mesh.elements[element].corners());
        let own = corners.into_iter().find(|(corner, _)| *corner == node);
        mesh.elements[element].site(own.map_or([0, 0], |(_, local)| local))
    }

    /// From the left edge, and from the crack plane.
    fn reference_place(&self, node: usize) -> Vec<f64> {
        let mesh = self.forces.mesh();
        let [x, y] = mesh.node_position(node);
        vec![x - self.setting.left_x, y - mesh.middle_height()]
    }

    fn place_of_element(&self, element: usize) -> Vec<f64> {
        self.reference_place(self.forces.mesh().node(element, 0))
    }

    fn rebook(&self, cost: &mut Cost) {
        cost.rebook(Phase::SetUp, Phase::Cut, (1, self.forces.first_cut()));
        cost.rebook(Phase::Forces, Phase::Neighbours, self.forces.search_cost());
        cost.rebook(Phase::Forces, Phase::Exchange, self.forces.exchange_cost());
    }
}
