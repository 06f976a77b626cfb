//! The study file as typed: everything may be left out here, `resolve` and the defaults decide what must not be.
//!
//! The doc comments below are what an editor shows through the JSON Schema.

mod cluster;
mod gauss;
mod loading;
mod material;
mod report;
mod resolution;
mod specimen;

use super::{
    named::{Named, Sweep},
    quantity::{Duration, Fraction, Length, Time},
    reader::Given,
};
use schemars::JsonSchema;
use serde::Deserialize;

pub use super::quantity::Interval;
pub use cluster::ClusterFile;
pub use gauss::Gauss;
pub use loading::*;
pub use material::*;
pub use report::*;
pub use resolution::*;
pub use specimen::*;

/// A study: a question, cases that answer it, and what to show.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
#[schemars(rename = "Study", extend("required" = ["study"]))]
pub struct StudyFile {
    /// Version of this file format; 1 where left out.
    pub cgaft: Given<u32>,
    /// Name of the study, and of its folder of results.
    pub study: Given<String>,
    /// What the study is to find out; shown at the top of the report.
    pub question: Given<String>,
    /// What every case starts from.
    pub base: Given<CaseFile>,
    /// The cases by name, each with what it changes in the base.
    pub cases: Given<Named<CaseFile>>,
    /// Multiplies every case: a dotted path such as `resolution.element` and its values.
    pub sweep: Given<Sweep>,
    /// Repeats every case with small random displacements, so that the report tells medians and intervals.
    pub repeats: Given<Repeats>,
    /// Tables to compare with, each by a name of its own: CSV files in the folder of the study. A column `case` names
    /// cases; the others are named as in the table `summary` (`k_ic_near_tip_mpa_sqrt_m`), or are `wave`, `path` and
    /// `reference_ps` as in `wave_arrival`. A column `ranks` in its place is for times of another program, named as in
    /// `scaling`. Lines that begin with `#` are comments.
    pub compare: Given<Named<String>>,
    pub report: Given<Report>,
    pub cluster: Given<ClusterFile>,
}

/// One case, or the base that all cases start from.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
#[schemars(rename = "Case")]
pub struct CaseFile {
    pub material: Given<Material>,
    pub specimen: Given<Specimen>,
    pub resolution: Given<Resolution>,
    pub crack: Given<Crack>,
    pub notch: Given<Notch>,
    pub held: Given<Held>,
    pub loading: Given<Loading>,
    pub run: Given<Run>,
    pub probes: Given<Probes>,
    /// What the study is about, and how often to take a snapshot of the whole specimen.
    pub observe: Given<Vec<Given<Observe>>>,
}

/// When the run ends, its time step, its economies, and what computes it.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Run {
    pub until: Given<Until>,
    /// `auto`, `{fraction: 0.8}` of the stability limit, or a time.
    pub time_step: Given<TimeStep>,
    pub summation: Given<Summation>,
    pub mass: Given<MassMatrix>,
    /// The specimen comes to rest under a strain before it moves.
    pub relax: Given<Relax>,
    /// All nodes are displaced a little before they move, so that repeats can tell what is chance.
    pub noise: Given<Noise>,
    /// Processes that a case is shared between by MPI.
    pub ranks: Given<u32>,
    /// Threads of each process.
    pub threads: Given<u32>,
    /// Time on the wall between checkpoints.
    pub checkpoint_every: Given<Duration>,
}

/// The run stops at whichever comes first; a strain or a time is needed.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Until {
    /// Nominal strain.
    pub strain: Given<Fraction>,
    pub time: Given<Time>,
    /// Distance of the tip from the edge at which the crack begins; for `edge: none` from the middle of the notch, so that it
    /// begins as half of `crack.length`.
    pub crack_length: Given<Length>,
    /// The crack has started and then stood still for this long.
    pub arrest: Given<Time>,
    /// The crack has had a branch, as the report counts them, for this long.
    pub after_branch: Given<Time>,
    /// The crack has left its plane by eight spacings for this long.
    pub leaves_the_plane: Given<Time>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TimeStep {
    Auto,
    Fraction(Given<f64>),
    /// Any other word: a time.
    #[serde(rename = "$otherwise")]
    Given(Time),
}

/// Which bonds are summed; `exact` where left out.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Summation {
    /// Every bond.
    Exact,
    /// Of each string of bonds between two elements its ends and this many Gauss points between them; in a solid 3 or 6 points
    /// of each patch of bonds between two faces.
    Gauss(Given<Gauss>),
    /// Only the bonds of nodes: cheap, and wrong at every strain. In a solid of whole blocks of one size alone.
    Nodal,
}

/// Mass of the nodes; `lumped` where left out.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MassMatrix {
    /// The mass of its sites at each node, shared as its shape functions share them: a third at each node of a triangle.
    Lumped,
    /// As the sites of an element move with its nodes.
    Consistent,
    /// This share of the consistent matrix, the rest lumped; 0.65 makes long waves most nearly as fast as they should be.
    Blend(#[schemars(range(min = 0, max = 1))] Given<f64>),
}

/// Coming to rest before the run.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Relax {
    /// Nominal strain under which the run starts; 0 % lets the surfaces relax.
    pub strain: Given<Fraction>,
}

/// Random displacements of the start, along each axis evenly up to the amplitude. A site of the lattice has the same in every
/// mesh and on any number of ranks.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Noise {
    /// In lattice spacings, such as 1e-3; 1e-10 shows how soon two runs part that differ by next to nothing.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = 0.1))]
    pub amplitude: Given<f64>,
    /// Tells repeats apart; 1 where left out.
    pub seed: Given<u32>,
}

/// Every case several times over, each with noise of its own in its start.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Repeats {
    /// How often each case is computed.
    #[schemars(range(min = 2, max = 1000))]
    pub count: Given<u32>,
    /// As `run.noise.amplitude`, which it sets in all cases.
    #[schemars(extend("exclusiveMinimum" = 0), range(max = 0.1))]
    pub amplitude: Given<f64>,
    /// Of the first repeat, 1 where left out; the next ones count on from it.
    pub seed: Given<u32>,
}

/// The time series.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Probes {
    /// Simulated time between rows of the time series.
    pub every: Given<Time>,
}

/// A table of the report, snapshots, or gauges.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Observe {
    Crack,
    StressProfile,
    WaveArrival,
    AverageStress,
    Snapshots(Snapshots),
    Gauges(Gauges),
}

/// Pictures of the whole specimen, for ParaView and the report.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Snapshots {
    /// A strain such as `0.05 % strain`, or a time.
    pub every: Given<Interval>,
}

/// Planes across a solid, or across a slab under a pulse, whose mean velocity and stress the time series tells.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Gauges {
    /// The axis that the planes lie across.
    pub axis: Given<Axis>,
    /// Where, from the low face of the axis; of a slab from its left edge.
    pub at: Given<Vec<Given<Length>>>,
}
