//! The run of one specimen in time: the loop, its observers, and when it stops. A specimen is a [`Body`] with
//! [`Instruments`]: a [`Slab`] in two dimensions, a [`Solid`] in three.

mod body;
pub mod checkpoint;
mod clock;
mod cost;
mod error;
mod ledger;
mod observe;
mod observer;
mod refine;
mod resume;
mod schedule;
pub mod slab;
pub mod solid;
mod step;
mod temperature;
mod time_step;
mod until;

pub use body::{Body, Instruments, Totals};
pub use clock::Clock;
pub use cost::{Cost, Phase};
pub use error::{RunError, SolverError};
pub use ledger::{Balance, Ledger};
pub use observer::{Moment, Motion, Observer, Progress};
pub use slab::{Reading, Slab, j_integral, site_volume};
pub use solid::Solid;
pub use time_step::TimeStep;
pub use until::{Ending, Until};

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crate::domain::{Call, Domain, Ranks};
use crate::forces::Summation;
use crate::loading::Load;
use crate::relaxation::RelaxationError;
use crate::state::{Noise, State};
use schedule::Schedule;
use step::Looks;

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
    /// What becomes atoms while the specimen moves; `None`: the mesh stays as it is.
    pub refine: Option<Refine>,
    /// Whether the specimen comes to rest under the strain of the start before it moves.
    pub relax: bool,
    /// Displacements of the start.
    pub noise: Option<Noise>,
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

/// When elements become atoms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refine {
    /// Largest error of the strain in an element, over what its bonds have left before they give way.
    pub error: f64,
    /// How many layers of elements around those that are too coarse become atoms with them.
    pub ahead: u32,
}

/// One specimen in motion, in `D` dimensions.
pub struct Solver<B: Instruments<D> = Slab, const D: usize = 2> {
    body: B,
    state: State<D>,
    settings: Settings,
    clock: Clock,
    /// Bound of the time step when it was last looked at, ps, without close bonds.
    stability_limit: f64,
    /// An automatic time step is never longer, ps.
    longest_step: f64,
    /// The time step after the next one, ps.
    step_after_next: f64,
    /// Half a kick that the velocities still lack, ps.
    due_kick: Option<f64>,
    /// Whether the motion of the next step has been done with the forces of this one.
    is_ahead: bool,
    /// Whether what elements hold is that of the present state.
    measured: bool,
    ledger: Ledger,
    probes: Schedule,
    snapshots: Schedule,
    /// At the mesh.
    looks: Schedule,
    cost: Cost,
}

/// Every rank carries the whole specimen to rest, and learns where all nodes are and which are free.
fn share_what_rests<const D: usize>(domain: &Domain, state: &mut State<D>) {
    let planes = state
        .position
        .iter_mut()
        .chain(&mut state.mobility)
        .chain([&mut state.mass]);
    planes.for_each(|plane| domain.share_nodes(plane));
}

impl<B: Instruments<D>, const D: usize> Solver<B, D> {
    /// A body at the start of its loading, whose set-up began at `start`.
    pub fn of(mut body: B, mut state: State<D>, settings: Settings, mut start: Instant) -> Result<Self, SolverError> {
        if let Some(noise) = settings.noise.filter(|_| !settings.relax) {
            noise.displace(&mut state, body.spacing(), |node| body.site_of(node));
        }
        body.compute(&mut state, 0.0, true).map_err(SolverError::NoStart)?;
        let stability_limit = body.stability_limit(&state);
        let longest = body.load().longest_step(body.spacing());
        let time_step = settings.time_step.choose(stability_limit, longest)?;
        let domain = body.domain();
        let [kinetic] = domain.sum_nodes(|node| [state.kinetic_energy_of(node)]);
        let of_held = body
            .load()
            .held()
            .into_iter()
            .map(|node| match domain.moves(node as usize) {
                true => state.kinetic_energy_of(node as usize),
                false => 0.0,
            });
        let held = domain.ranks().merge(&of_held.collect::<Vec<_>>()).into_iter().sum();
        let mut ledger = Ledger::new(body.stored(), [kinetic, held], body.jump_at_cutoff());
        if let Some(noise) = settings.noise {
            let [mass] = domain.sum_nodes(|node| [state.mass[node]]);
            ledger.put_in_by_noise(noise.most_energy::<D>(mass, body.spacing(), stability_limit));
        }
        let probes = Schedule::new(settings.probe_every);
        let snapshots = Schedule::new(settings.snapshot_every.unwrap_or(f64::INFINITY));
        let looks = Schedule::new(body.looks_every().unwrap_or(f64::INFINITY));
        let mut cost = Cost::default();
        cost.book(Phase::SetUp, &mut start);
        Ok(Self {
            body,
            state,
            settings,
            clock: Clock {
                step: 0,
                time: 0.0,
                time_step,
            },
            stability_limit,
            longest_step: time_step,
            step_after_next: time_step,
            due_kick: None,
            is_ahead: false,
            measured: true,
            ledger,
            probes,
            snapshots,
            looks,
            cost,
        })
    }

    pub fn body(&self) -> &B {
        &self.body
    }

    /// All that is left of it where its motion is no longer wanted.
    pub fn into_body(self) -> B {
        self.body
    }

    pub fn mesh(&self) -> &B::Mesh {
        self.body.mesh()
    }

    pub fn state(&self) -> &State<D> {
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
        self.clock.step
    }

    /// Time step in force and its stability limit, ps.
    pub fn time_step(&self) -> [f64; 2] {
        [self.clock.time_step, self.stability_limit]
    }

    /// The closest that sites have come, as a share of the spacing; `None` where all bonds were as in a regular lattice, as far as
    /// neighbours are searched. All ranks must ask for it together.
    pub fn closest_approach(&self) -> Option<f64> {
        let share = self.body.closest_approach() / self.body.spacing();
        share.is_finite().then_some(share)
    }

    /// Runs until something ends it; `stop` asks for a checkpoint and an early end.
    pub fn run<O: Observer<B, D>>(
        &mut self,
        observer: &mut O,
        stop: &AtomicBool,
    ) -> Result<Ending, RunError<O::Error>> {
        let mut last_checkpoint = Instant::now();
        if self.clock.step == 0 {
            if self.settings.relax && self.probes.taken() == 0 && !self.come_to_rest(observer, stop)? {
                return Ok(Ending::Interrupted);
            }
            self.observe(observer, false)?;
            self.refine()?;
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
                let domain = self.body.domain_mut();
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
                self.refine()?;
            }
        }
    }

    /// Tells all ranks if this one is asked to stop or its clock calls for a checkpoint; they hear it in the next step.
    fn call(&mut self, stop: &AtomicBool, last_checkpoint: Instant) {
        let is_due = self.ranks().is_first() && last_checkpoint.elapsed() >= self.settings.checkpoint_every;
        let asked = [(stop.load(Ordering::Relaxed), Call::Stop), (is_due, Call::Checkpoint)];
        for (_, call) in asked.into_iter().filter(|(is_asked, _)| *is_asked) {
            self.body.domain_mut().call(call);
        }
    }

    /// Brings the specimen to rest under the strain of the start, then sets it in motion; false if asked to stop.
    fn come_to_rest<O: Observer<B, D>>(&mut self, observer: &mut O, stop: &AtomicBool) -> Result<bool, SolverError> {
        let mut clock = Instant::now();
        let (present, is_first) = (self.progress(), self.ranks().is_first());
        let mut tell = |residual: f64| {
            if is_first {
                let residual = Some(residual);
                observer.progress(&Progress { residual, ..present });
            }
        };
        match self.body.relax(&mut self.state, stop, &mut tell) {
            Err(SolverError::NoRest(RelaxationError::Interrupted)) => return Ok(false),
            rest => rest?,
        }
        self.body.start(&mut self.state);
        if let Some(noise) = self.settings.noise {
            noise.displace(&mut self.state, self.body.spacing(), |node| self.body.site_of(node));
        }
        self.compute(true).map_err(SolverError::NoStart)?;
        let [kinetic] = (self.body.domain()).sum_nodes(|node| [self.state.kinetic_energy_of(node)]);
        self.ledger.begin(self.body.stored(), kinetic);
        self.stability_limit = self.body.stability_limit(&self.state);
        let longest = self.body.load().longest_step(self.body.spacing());
        let chosen = self.settings.time_step.choose(self.stability_limit, longest)?;
        self.clock.time_step = chosen.min(self.longest_step);
        self.step_after_next = self.clock.time_step;
        self.cost.book(Phase::SetUp, &mut clock);
        Ok(true)
    }

    fn ending(&self) -> Option<Ending> {
        self.body.ending(&self.settings.until, self.clock)
    }

    fn save<O: Observer<B, D>>(&mut self, observer: &mut O) -> Result<(), RunError<O::Error>> {
        self.settle();
        let mut clock = Instant::now();
        self.cost.core_seconds = self.ranks().core_seconds();
        let checkpoint = self.checkpoint_without_motion();
        let motion = self.motion();
        match self.ranks().is_first() {
            true => (observer.checkpoint(&checkpoint, &motion, &self.cost())).map_err(RunError::Output)?,
            false => (0..Motion::<D>::PLANES).for_each(|number| motion.plane(number, &mut |_| ())),
        }
        self.cost.book(Phase::Output, &mut clock);
        Ok(())
    }

    fn ranks(&self) -> Ranks {
        self.body.domain().ranks()
    }

    /// Where the time of this computation went: set-up without the cut of the specimen, and forces without the search for
    /// neighbours and the exchange with other ranks, which are phases of their own.
    pub fn cost(&self) -> Cost {
        let mut cost = self.cost.clone();
        self.body.rebook(&mut cost);
        cost
    }

    fn strain(&self) -> f64 {
        self.body.strain(self.clock.time)
    }
}
