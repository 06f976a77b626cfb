//! The run of one specimen in time: the loop, its observers, and when it stops.

mod bins;
pub mod checkpoint;
mod cost;
mod crack;
mod error;
mod gauges;
pub mod j_integral;
mod ledger;
mod observe;
mod observer;
mod probe;
mod resume;
mod schedule;
mod setting;
mod sight;
mod step;
mod stop;
mod temperature;
mod time_step;
mod traction;

pub use cost::{Cost, Phase};
pub use error::{RunError, SolverError};
pub use ledger::Ledger;
pub use observer::{Moment, Observer, Progress, Reading};
pub use probe::site_volume;
pub use stop::{Ending, Until};
pub use time_step::TimeStep;

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crate::analysis::initiation;
use crate::analysis::series::Setting;
use crate::domain::{Call, Ranks};
use crate::forces::{Forces, Measure, Planes, Summation};
use crate::loading::{Impulse, Stretching};
use crate::material::Material;
use crate::mesh::Mesh;
use crate::relaxation::{self, RelaxationError, Target};
use crate::state::{Inertia, State};
use crack::Crack;
use gauges::Gauges;
use j_integral::JIntegral;
use probe::{Interior, ProfileLine};
use schedule::Schedule;
use sight::Sight;
use step::Looks;
use temperature::Thermometer;
use traction::Traction;

/// Largest force left on a node when the motion begins, over the strength of a bond. Over a specimen of a thousand rows the
/// longest wave that this leaves is a strain of some 1e-7.
const RESIDUAL_AT_START: f64 = 1e-8;

/// What a run is asked to do.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    pub time_step: TimeStep,
    pub summation: Summation,
    /// Share of the consistent mass matrix in that of the triangles; the rest is lumped.
    pub consistent_mass: f64,
    /// Whether the specimen comes to rest under the strain of the start before it moves.
    pub relax: bool,
    pub until: Until,
    /// Simulated time between probes, ps.
    pub probe_every: f64,
    /// Simulated time between snapshots, ps; `None`: only the first and the last.
    pub snapshot_every: Option<f64>,
    /// Wall time between checkpoints.
    pub checkpoint_every: Duration,
    /// What a 2D stress is divided by, nm.
    pub thickness: f64,
}

/// One specimen in motion.
pub struct Solver {
    forces: Forces,
    state: State,
    loading: Stretching,
    settings: Settings,
    setting: Setting,
    interior: Interior,
    profile: ProfileLine,
    traction: Traction,
    gauges: Gauges,
    thermometer: Thermometer,
    j_integral: JIntegral,
    sight: Sight,
    step: u64,
    time: f64,
    time_step: f64,
    /// Bound of the time step when it was last looked at, ps.
    stability_limit: f64,
    /// Half a kick that the velocities still lack, ps.
    due_kick: Option<f64>,
    /// Whether the motion of the next step has been done with the forces of this one, and where it puts nodes.
    is_ahead: bool,
    next: Planes,
    /// How fast they come to be there.
    next_velocity: Planes,
    /// How each group of triangles answers to forces.
    inertias: Vec<Inertia>,
    grip_impulse: Impulse,
    measure: Measure,
    /// Whether the measure is that of the present state.
    measured: bool,
    ledger: Ledger,
    probes: Schedule,
    snapshots: Schedule,
    broken: Vec<[i32; 3]>,
    crack: Option<Crack>,
    stop: stop::Watch,
    cost: Cost,
}

impl Solver {
    /// A specimen at the start of its loading.
    pub fn new(mesh: Mesh, material: Material, loading: Stretching, settings: Settings) -> Result<Self, SolverError> {
        Self::shared(Ranks::alone(), mesh, material, loading, settings)
    }

    /// The part of this rank in what all ranks compute together.
    pub fn shared(
        ranks: Ranks,
        mesh: Mesh,
        material: Material,
        loading: Stretching,
        settings: Settings,
    ) -> Result<Self, SolverError> {
        let mut clock = Instant::now();
        let masses = mesh
            .lumped_masses()
            .into_iter()
            .map(|mass| mass * material.site_mass)
            .collect();
        let mut state = State::at_rest(mesh.node_positions(), masses);
        if settings.consistent_mass > 0.0 {
            state.couple_masses(&mesh, settings.consistent_mass);
        }
        loading.pre_stretch(&mesh, &mut state);
        loading.start(&mesh, &mut state);
        let setting = setting::setting(&mesh, &material, &loading, settings.thickness);
        let interior = Interior::new(&mesh);
        let profile = ProfileLine::new(&mesh, &setting);
        let traction = Traction::new(&mesh, &material, &profile, &setting);
        let gauges = Gauges::new(&mesh, &setting);
        let thermometer = Thermometer::new(&mesh);
        let j_integral = JIntegral::new(&mesh, material);
        let sight = Sight::new(&mesh, &loading, &profile, &traction, &gauges);
        let crack = Crack::new(&setting);
        let mut forces = Forces::shared(ranks, mesh, material, settings.summation);
        forces.look_at(loading.held());
        let mut measure = Measure::default();
        forces
            .compute_and_measure(&mut state.position, &mut state.force, &mut measure)
            .map_err(SolverError::NoStart)?;
        let stored = [measure.energy(forces.domain()), measure.pairs(forces.domain())];
        let stability_limit = time_step::limit(&forces, &state);
        let time_step = settings
            .time_step
            .choose(stability_limit, loading.longest_step(material.spacing))?;
        let jump = material.interaction.jump_at_cutoff();
        let held = loading.held().map(|node| state.kinetic_energy_of(node as usize)).sum();
        let ledger = Ledger::new(stored, [state.kinetic_energy(), held], jump);
        let grip_impulse = Impulse::new(&loading, &forces.domain().nodes());
        let probes = Schedule::new(settings.probe_every);
        let snapshots = Schedule::new(settings.snapshot_every.unwrap_or(f64::INFINITY));
        let stop = stop::Watch::new(&setting);
        let mut cost = Cost::default();
        cost.book(Phase::SetUp, &mut clock);
        Ok(Self {
            forces,
            state,
            loading,
            settings,
            setting,
            interior,
            profile,
            traction,
            gauges,
            thermometer,
            j_integral,
            sight,
            step: 0,
            time: 0.0,
            time_step,
            stability_limit,
            due_kick: None,
            is_ahead: false,
            next: Planes::default(),
            next_velocity: Planes::default(),
            inertias: Vec::new(),
            grip_impulse,
            measure,
            measured: true,
            ledger,
            probes,
            snapshots,
            broken: Vec::new(),
            crack,
            stop,
            cost,
        })
    }

    /// What the analysis must know of this specimen.
    pub fn setting(&self) -> &Setting {
        &self.setting
    }

    pub fn mesh(&self) -> &Mesh {
        self.forces.mesh()
    }

    pub fn state(&self) -> &State {
        &self.state
    }

    /// Number of probes given so far.
    pub fn probe_count(&self) -> u64 {
        self.probes.taken()
    }

    pub fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    pub fn step_count(&self) -> u64 {
        self.step
    }

    /// Time step in force and its stability limit, ps.
    pub fn time_step(&self) -> [f64; 2] {
        [self.time_step, self.stability_limit]
    }

    /// Centres of the bins of the profile along the crack plane, nm from the left edge.
    pub fn profile_x(&self) -> &[f64] {
        self.profile.centres()
    }

    /// Where the wave gauges stand, nm from the left edge and from the crack plane.
    pub fn gauge_places(&self) -> &[[f64; 2]] {
        self.gauges.places()
    }

    /// Runs until something ends it; `stop` asks for a checkpoint and an early end.
    pub fn run<O: Observer>(&mut self, observer: &mut O, stop: &AtomicBool) -> Result<Ending, RunError<O::Error>> {
        let mut last_checkpoint = Instant::now();
        if self.step == 0 {
            if self.settings.relax && self.probes.taken() == 0 && !self.come_to_rest(observer, stop)? {
                return Ok(Ending::Interrupted);
            }
            self.observe(observer, false)?;
        } else if let Some(ending) = self.ending() {
            // Only the last checkpoint of a run is made where it ends, and everything was given before it.
            return Ok(ending);
        }
        loop {
            // While the next step is half done, nobody is to look: what is asked for is done after it.
            if !self.is_ahead {
                if let Some(ending) = self.ending() {
                    self.observe(observer, true)?;
                    self.save(observer)?;
                    return Ok(ending);
                }
                let domain = self.forces.domain_mut();
                if domain.hears(Call::Stop) {
                    self.save(observer)?;
                    return Ok(Ending::Interrupted);
                }
                if domain.hears(Call::Checkpoint) {
                    self.save(observer)?;
                    last_checkpoint = Instant::now();
                }
            }
            self.call(stop, last_checkpoint);
            self.step_on(Looks::WhenDue)?;
            if !self.is_ahead {
                self.observe(observer, false)?;
            }
        }
    }

    /// Tells all ranks if this one is asked to stop or its clock calls for a checkpoint; they hear it in the next step.
    fn call(&mut self, stop: &AtomicBool, last_checkpoint: Instant) {
        let is_due = self.ranks().is_first() && last_checkpoint.elapsed() >= self.settings.checkpoint_every;
        let asked = [(stop.load(Ordering::Relaxed), Call::Stop), (is_due, Call::Checkpoint)];
        for (_, call) in asked.into_iter().filter(|(is_asked, _)| *is_asked) {
            self.forces.domain_mut().call(call);
        }
    }

    /// Brings the specimen to rest under the strain of the start, then sets it in motion; false if asked to stop.
    fn come_to_rest<O: Observer>(&mut self, observer: &mut O, stop: &AtomicBool) -> Result<bool, SolverError> {
        let mut clock = Instant::now();
        let (present, is_first) = (self.progress(), self.ranks().is_first());
        let mut tell = |residual: f64| {
            if is_first {
                let residual = Some(residual);
                observer.progress(&Progress { residual, ..present });
            }
        };
        let target = Target {
            residual: RESIDUAL_AT_START,
            ..Target::default()
        };
        let rest = relaxation::relax_unless(&mut self.forces, &mut self.state, target, stop, &mut tell);
        match rest {
            Ok(_) => {}
            Err(RelaxationError::Interrupted) => return Ok(false),
            Err(error) => return Err(SolverError::NoRest(error)),
        }
        self.refuse_a_crack_that_ran()?;
        self.loading.start(self.forces.mesh(), &mut self.state);
        self.compute(true).map_err(SolverError::NoStart)?;
        let domain = self.forces.domain();
        let stored = [self.measure.energy(domain), self.measure.pairs(domain)];
        self.ledger.begin(stored, self.state.kinetic_energy());
        self.stability_limit = time_step::limit(&self.forces, &self.state);
        let longest = self.loading.longest_step(self.setting.spacing);
        self.time_step = self.settings.time_step.choose(self.stability_limit, longest)?;
        self.cost.book(Phase::SetUp, &mut clock);
        Ok(true)
    }

    /// A crack that has set out before the motion begins would be taken for the notch.
    fn refuse_a_crack_that_ran(&self) -> Result<(), SolverError> {
        let Some(mut crack) = Crack::new(&self.setting) else {
            return Ok(());
        };
        let broken = self.forces.broken_bonds(&self.state.position);
        crack.follow(&probe::bond_events(&[], &broken, 0), 0);
        let [notch, tip] = [self.setting.crack_length, crack.tip().x];
        if tip - notch > initiation::far(&self.setting) {
            let strain = self.strain();
            return Err(SolverError::RanWhileResting { notch, tip, strain });
        }
        Ok(())
    }

    fn ending(&self) -> Option<Ending> {
        let strain_at = |time| self.loading.strain(time);
        self.stop
            .ending(&self.settings.until, self.time, self.time_step, strain_at)
    }

    fn save<O: Observer>(&mut self, observer: &mut O) -> Result<(), RunError<O::Error>> {
        self.settle();
        let mut clock = Instant::now();
        self.gather_motion();
        self.cost.core_seconds = self.ranks().core_seconds();
        // The state is lent to the checkpoint: a copy would be most of what a run of atoms keeps in memory.
        let mut checkpoint = self.checkpoint_without_motion();
        if self.ranks().is_first() {
            checkpoint.lend(&mut self.state);
            let saved = observer.checkpoint(&checkpoint, &self.cost());
            checkpoint.lend(&mut self.state);
            saved.map_err(RunError::Output)?;
        }
        self.cost.book(Phase::Output, &mut clock);
        Ok(())
    }

    /// Brings positions and velocities of all nodes to the first rank.
    fn gather_motion(&mut self) {
        let State { position, velocity, .. } = &mut self.state;
        let planes = position.iter_mut().chain(velocity);
        planes.for_each(|plane| self.forces.domain().gather_nodes(plane));
    }

    fn ranks(&self) -> Ranks {
        self.forces.domain().ranks()
    }

    /// Where the time of this computation went: set-up without the cut of the specimen, and forces without the search for
    /// neighbours and the exchange with other ranks, which are phases of their own.
    pub fn cost(&self) -> Cost {
        let mut cost = self.cost.clone();
        cost.rebook(Phase::SetUp, Phase::Cut, (1, self.forces.first_cut()));
        cost.rebook(Phase::Forces, Phase::Neighbours, self.forces.search_cost());
        cost.rebook(Phase::Forces, Phase::Exchange, self.forces.exchange_cost());
        cost
    }

    fn strain(&self) -> f64 {
        self.loading.strain(self.time)
    }
}
