//! Who looks at a run, and what it is shown.

use super::Cost;
use super::checkpoint::Checkpoint;
use crate::analysis::series::{BondEvent, Probe};
use crate::forces::Measure;
use crate::mesh::Mesh;
use crate::state::State;

/// Takes what a run gives. An error ends the run: a lost output must never go unnoticed.
pub trait Observer {
    type Error;
    fn probe(&mut self, reading: &Reading) -> Result<(), Self::Error>;
    fn snapshot(&mut self, moment: &Moment) -> Result<(), Self::Error>;
    /// All probes and snapshots up to here must be safe before the checkpoint is.
    /// `cost` is that of this part of the run.
    fn checkpoint(&mut self, checkpoint: &Checkpoint, cost: &Cost) -> Result<(), Self::Error>;
    /// Called at every probe, and again and again while the specimen comes to rest.
    fn progress(&mut self, progress: &Progress);
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

/// What a probe reads.
pub struct Reading<'a> {
    /// A row of the series.
    pub probe: &'a Probe,
    /// Stress xx, yy, xy along the crack plane, eV/nm^3.
    pub profile: &'a [[f64; 3]],
    /// Traction x, y across the crack plane in the bins of the profile, eV/nm^3.
    pub traction: &'a [[f64; 2]],
    /// Velocity x, y (nm/ps) and stress xx, yy, xy (eV/nm^3) of every wave gauge.
    pub gauges: &'a [[f64; 5]],
    /// Bonds that changed since the row before.
    pub bonds: &'a [BondEvent],
}

/// How far a run is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    pub step: u64,
    /// Steps that the run would take if the crack did not end it.
    pub of: u64,
    /// ps
    pub time: f64,
    /// Nominal.
    pub strain: f64,
    /// Distance of the foremost tip from the left edge, nm.
    pub tip: Option<f64>,
    /// While the specimen comes to rest: the largest force left on a node, over the strength of a bond.
    pub residual: Option<f64>,
}
