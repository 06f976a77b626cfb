//! The run of one specimen in time: the loop, its observers, and when it stops.

pub mod checkpoint;
mod cost;
mod ledger;
mod probe;
mod schedule;
mod stop;
mod temperature;
mod time_step;

pub use cost::{Cost, Phase};
pub use ledger::Ledger;
pub use probe::site_volume;
pub use stop::{Ending, Until};
pub use time_step::TimeStep;

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crate::analysis::crack::Tracker;
use crate::analysis::series::{BondEvent, Probe, Setting};
use crate::forces::{ForceError, Forces, Measure};
use crate::integrator;
use crate::loading::Stretching;
use crate::material::{Elasticity, Material, WaveSpeeds};
use crate::mesh::Mesh;
use crate::state::State;
use checkpoint::Checkpoint;
use probe::ProfileLine;
use schedule::Schedule;

/// What a run is asked to do.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    pub time_step: TimeStep,
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

/// A moment of a run as its observers see it.
pub struct Moment<'a> {
    pub step: u64,
    /// ps
    pub time: f64,
    /// Nominal strain.
    pub strain: f64,
    pub mesh: &'a Mesh,
    pub state: &'a State,
    pub measure: &'a Measure,
    /// Broken bonds, ascending.
    pub broken: &'a [[i32; 3]],
}

/// Takes what a run gives. An error ends the run: a lost output must never go unnoticed.
pub trait Observer {
    type Error;
    /// A row of the series, the profile along the crack plane, and the bonds that changed since the row before.
    fn probe(&mut self, probe: &Probe, profile: &[[f64; 3]], bonds: &[BondEvent]) -> Result<(), Self::Error>;
    fn snapshot(&mut self, moment: &Moment) -> Result<(), Self::Error>;
    /// All probes and snapshots up to here must be safe before the checkpoint is.
    fn checkpoint(&mut self, checkpoint: &Checkpoint) -> Result<(), Self::Error>;
    /// Called at every probe.
    fn progress(&mut self, progress: &Progress);
}

/// How far a run is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    pub step: u64,
    /// Steps that the run would take if the crack did not end it.
    pub of: u64,
    pub time: f64,
    pub strain: f64,
    /// Distance of the foremost tip from the left edge, nm.
    pub tip: Option<f64>,
}

/// Why a run cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolverError {
    #[error(
        "the time step {given:.5} ps is above the stability limit {limit:.5} ps of this mesh and material; \
         choose a smaller one, or `time-step: auto`"
    )]
    StepTooLong { given: f64, limit: f64 },
    #[error(
        "step {step}, {time:.3} ps, strain {strain:.5}: {source}; \
         try a smaller fraction of the stability limit or a lower strain rate"
    )]
    BlowUp { step: u64, time: f64, strain: f64, source: ForceError },
    #[error(
        "step {step}, {time:.3} ps, strain {strain:.5}: energy went astray by {imbalance:.3e} eV, \
         more than {limit:.0} % of the energy put in ({put_in:.3e} eV); try a smaller fraction of the stability limit"
    )]
    EnergyAstray { step: u64, time: f64, strain: f64, imbalance: f64, put_in: f64, limit: f64 },
    #[error("the run cannot start: {0}")]
    NoStart(ForceError),
}

/// How a run ended, or why not; observers' errors pass through.
#[derive(Debug, thiserror::Error)]
pub enum RunError<E> {
    #[error(transparent)]
    Physics(#[from] SolverError),
    #[error("{0}")]
    Output(E),
}

/// One specimen in motion.
pub struct Solver {
    forces: Forces,
    state: State,
    loading: Stretching,
    settings: Settings,
    setting: Setting,
    profile: ProfileLine,
    step: u64,
    time: f64,
    time_step: f64,
    /// Bound of the time step when it was last looked at, ps.
    stability_limit: f64,
    power: f64,
    ledger: Ledger,
    probes: Schedule,
    snapshots: Schedule,
    broken: Vec<[i32; 3]>,
    tracker: Option<Tracker>,
    stop: stop::Watch,
    cost: Cost,
}

impl Solver {
    /// A specimen at the start of its loading.
    pub fn new(mesh: Mesh, material: Material, loading: Stretching, settings: Settings) -> Result<Self, SolverError> {
        let mut clock = Instant::now();
        let masses = mesh.lumped_masses().into_iter().map(|mass| mass * material.site_mass).collect();
        let mut state = State::at_rest(mesh.node_positions(), masses);
        loading.start(&mesh, &mut state);
        let setting = setting(&mesh, &material, &loading, settings.thickness);
        let profile = ProfileLine::new(&mesh, &setting);
        let tracker = Tracker::new(&setting);
        let mut forces = Forces::new(mesh, material);
        forces.compute(&state.position, &mut state.force).map_err(SolverError::NoStart)?;
        let start = forces.measure(&state.position).map_err(SolverError::NoStart)?;
        let stability_limit = time_step::limit(&mut forces, &state).map_err(SolverError::NoStart)?;
        let time_step = settings.time_step.choose(stability_limit)?;
        let jump = material.interaction.jump_at_cutoff();
        let ledger = Ledger::new(&start, state.kinetic_energy(), jump);
        let power = loading.power(&state);
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
            profile,
            step: 0,
            time: 0.0,
            time_step,
            stability_limit,
            power,
            ledger,
            probes,
            snapshots,
            broken: Vec::new(),
            tracker,
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

    /// Runs until something ends it; `stop` asks for a checkpoint and an early end.
    pub fn run<O: Observer>(&mut self, observer: &mut O, stop: &AtomicBool) -> Result<Ending, RunError<O::Error>> {
        let mut last_checkpoint = Instant::now();
        if self.step == 0 {
            self.observe(observer, false)?;
        }
        loop {
            if let Some(ending) = self.stop.ending(&self.settings.until, self.time, self.strain(), self.time_step) {
                self.observe(observer, true)?;
                self.save(observer)?;
                return Ok(ending);
            }
            if stop.load(Ordering::Relaxed) {
                self.save(observer)?;
                return Ok(Ending::Interrupted);
            }
            if last_checkpoint.elapsed() >= self.settings.checkpoint_every {
                self.save(observer)?;
                last_checkpoint = Instant::now();
            }
            self.advance()?;
            self.observe(observer, false)?;
        }
    }

    fn save<O: Observer>(&mut self, observer: &mut O) -> Result<(), RunError<O::Error>> {
        let mut clock = Instant::now();
        observer.checkpoint(&self.checkpoint()).map_err(RunError::Output)?;
        self.cost.book(Phase::Output, &mut clock);
        Ok(())
    }

    /// One step of central differences.
    pub fn advance(&mut self) -> Result<(), SolverError> {
        let mut clock = Instant::now();
        let time_step = self.time_step;
        integrator::kick(&mut self.state, 0.5 * time_step);
        integrator::drift(&mut self.state, time_step);
        self.step += 1;
        self.time += time_step;
        self.cost.book(Phase::Motion, &mut clock);
        self.forces
            .compute(&self.state.position, &mut self.state.force)
            .map_err(|source| self.blow_up(source))?;
        self.cost.book(Phase::Forces, &mut clock);
        integrator::kick(&mut self.state, 0.5 * time_step);
        let power = self.loading.power(&self.state);
        self.ledger.add_work(0.5 * time_step * (self.power + power));
        self.power = power;
        self.cost.book(Phase::Motion, &mut clock);
        if self.step.is_multiple_of(time_step::CHECK_EVERY) {
            self.stability_limit =
                time_step::limit(&mut self.forces, &self.state).map_err(|source| self.blow_up(source))?;
            self.time_step = self.settings.time_step.adapt(self.time_step, self.stability_limit);
            self.cost.book(Phase::Stability, &mut clock);
        }
        Ok(())
    }

    /// Where the time of this computation went: forces without the search for neighbours, which is a phase of its own.
    pub fn cost(&self) -> Cost {
        let (searches, seconds) = self.forces.search_cost();
        let mut cost = self.cost.clone();
        cost.add(Phase::Neighbours, searches, seconds);
        cost.add(Phase::Forces, 0, -seconds);
        cost
    }

    fn strain(&self) -> f64 {
        self.loading.strain(self.time)
    }

    fn blow_up(&self, source: ForceError) -> SolverError {
        SolverError::BlowUp { step: self.step, time: self.time, strain: self.strain(), source }
    }

    /// Gives observers what is due; at the end of a run all that is not yet given.
    fn observe<O: Observer>(&mut self, observer: &mut O, at_end: bool) -> Result<(), RunError<O::Error>> {
        let probe = self.probes.take(self.time, self.time_step, at_end);
        let snapshot = self.snapshots.take(self.time, self.time_step, at_end);
        if !probe && !snapshot {
            return Ok(());
        }
        let mut clock = Instant::now();
        let measure = self.forces.measure(&self.state.position).map_err(|source| self.blow_up(source))?;
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
        let row = self.probe_row(measure);
        let number = self.probes.taken() - 1;
        let bonds = self.changed_bonds(number as u32);
        if let Some(tracker) = &mut self.tracker {
            bonds.iter().for_each(|event| tracker.apply(event));
            self.stop.follow(tracker.tip().x, self.time);
        }
        let profile = self.profile.stress(measure, &self.setting);
        observer.probe(&row, &profile, &bonds).map_err(RunError::Output)?;
        observer.progress(&Progress {
            step: self.step,
            of: self.settings.until.steps(self.step, self.time, self.time_step, self.loading.rate),
            time: self.time,
            strain: self.strain(),
            tip: self.tracker.as_ref().map(|_| self.stop.farthest_tip()),
        });
        self.ledger.check(self.step, self.time, self.strain())?;
        Ok(())
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
        }
    }

    /// Bonds that broke or closed since the last probe; remembers those broken now.
    fn changed_bonds(&mut self, probe: u32) -> Vec<BondEvent> {
        let now = self.forces.broken_bonds(&self.state.position);
        let before = if probe == 0 { Vec::new() } else { std::mem::take(&mut self.broken) };
        let events = probe::bond_events(&before, &now, probe);
        self.broken = now;
        events
    }

    /// Everything that a later run needs to go on from here.
    pub fn checkpoint(&self) -> Checkpoint {
        Checkpoint {
            step: self.step,
            time: self.time,
            time_step: self.time_step,
            position: self.state.position.clone(),
            velocity: self.state.velocity.clone(),
            open_interfaces: self.forces.open_interfaces(),
            work: self.ledger.work(),
            peak_work: self.ledger.peak_work(),
            peak_imbalance: self.ledger.peak_imbalance(),
            broken_bonds: self.broken.clone(),
            probes: self.probes.taken(),
            snapshots: self.snapshots.taken(),
            last_advance: self.stop.last_advance(),
            farthest_tip: self.stop.farthest_tip(),
        }
    }

    /// Goes back to where a checkpoint was made.
    pub fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), SolverError> {
        self.step = checkpoint.step;
        self.time = checkpoint.time;
        self.time_step = checkpoint.time_step;
        self.state.position.clone_from(&checkpoint.position);
        self.state.velocity.clone_from(&checkpoint.velocity);
        self.forces.restore_open_interfaces(&checkpoint.open_interfaces);
        self.forces.compute(&self.state.position, &mut self.state.force).map_err(|source| self.blow_up(source))?;
        self.power = self.loading.power(&self.state);
        self.ledger.restore(checkpoint.work, checkpoint.peak_work, checkpoint.peak_imbalance);
        self.broken.clone_from(&checkpoint.broken_bonds);
        self.tracker = Tracker::new(&self.setting);
        if let Some(tracker) = &mut self.tracker {
            let last_probe = checkpoint.probes.saturating_sub(1) as u32;
            probe::bond_events(&[], &self.broken, last_probe).iter().for_each(|event| tracker.apply(event));
        }
        self.probes.restore(checkpoint.probes, checkpoint.step);
        self.snapshots.restore(checkpoint.snapshots, checkpoint.step);
        self.stop.restore(checkpoint.last_advance, checkpoint.farthest_tip);
        Ok(())
    }
}

/// Gathers what the analysis must know.
fn setting(mesh: &Mesh, material: &Material, loading: &Stretching, thickness: f64) -> Setting {
    let elasticity = Elasticity::of(material);
    let speeds = WaveSpeeds::of(material);
    let left = mesh.sites.left();
    let [low, high] = mesh.grip_edges();
    Setting {
        spacing: mesh.spacing,
        length: mesh.sites.layout.length() * mesh.spacing,
        left_x: left * mesh.spacing,
        height: high - low,
        crack_row: mesh.cut.map(|cut| cut.row),
        crack_length: mesh.cut.map_or(0.0, |cut| (cut.to - left) * mesh.spacing),
        strain_rate: loading.rate,
        thickness,
        longitudinal_speed: speeds.longitudinal,
        transverse_speed: speeds.transverse,
        rayleigh_speed: speeds.rayleigh,
        young_modulus: elasticity.young_modulus(),
        poisson_ratio: elasticity.poisson_ratio(),
        fracture_energy: material.fracture_energy(),
        element_at_crack: probe::element_at_crack(mesh),
        nodes: mesh.node_count() as u64,
        elements: mesh.elements.len() as u64,
        represented_atoms: mesh.sites.len() as u64,
    }
}
