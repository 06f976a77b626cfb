//! The study file as typed: everything may be left out here, `resolve` and the defaults decide what must not be.
//!
//! The doc comments below are what an editor shows through the JSON Schema.

mod cluster;
mod gauss;
mod material;
mod report;

use super::{
    named::{Named, Sweep},
    quantity::{Duration, Fraction, Length, Rate, Time},
    reader::Given,
};
use schemars::JsonSchema;
use serde::Deserialize;

pub use super::quantity::Interval;
pub use cluster::ClusterFile;
pub use gauss::Gauss;
pub use material::*;
pub use report::*;

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
    pub loading: Given<Loading>,
    pub run: Given<Run>,
    pub probes: Given<Probes>,
    /// What the study is about, and how often to take a snapshot of the whole specimen.
    pub observe: Given<Vec<Given<Observe>>>,
}

/// The slab: its lattice and its sizes, grips included.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Specimen {
    pub lattice: Given<Lattice>,
    /// Extent along the crack (x).
    pub length: Given<Length>,
    /// Extent across the crack (y).
    pub width: Given<Length>,
    /// Atoms per edge of the triangles that lay out the specimen, whatever the resolution. Where left out it is
    /// `resolution.element`, and 10 where that is single atoms.
    pub block: Given<u32>,
    pub grips: Given<Grips>,
}

/// The lattice of the sites.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Lattice {
    Triangular,
}

/// What the grips hold; `clamped` where left out.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Grips {
    /// The grips hold x too.
    Clamped,
    /// The grips leave x free.
    Sliding,
}

/// How many atoms an element stands for, and where finer ones are.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Resolution {
    /// Atoms per edge of an element; 1 is the single atom, and 2 does not exist.
    pub element: Given<u32>,
    /// Where finer elements are used; the finest region that holds a site decides.
    pub regions: Given<Vec<Given<Region>>>,
}

/// A part of the specimen. x is measured from the left edge, y from the crack plane.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Region {
    /// Both sides of the crack plane.
    Band(Band),
    Box(Rectangle),
    Disc(Disc),
}

/// A band along the crack plane with elements of its own.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Band {
    pub half_width: Given<Length>,
    /// Atoms per edge of an element here; 1 is the single atom.
    pub element: Given<u32>,
}

/// A rectangle with elements of its own.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
#[schemars(rename = "Box")]
pub struct Rectangle {
    /// Lower left corner, [x, y].
    pub from: Given<[Given<Length>; 2]>,
    /// Upper right corner, [x, y].
    pub to: Given<[Given<Length>; 2]>,
    /// Atoms per edge of an element here; 1 is the single atom.
    pub element: Given<u32>,
}

/// A disc with elements of its own.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Disc {
    /// [x, y]
    pub center: Given<[Given<Length>; 2]>,
    pub radius: Given<Length>,
    /// Atoms per edge of an element here; 1 is the single atom.
    pub element: Given<u32>,
}

/// The notch from which the crack runs; leave it out for a whole slab.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Crack {
    /// The edge at which the crack begins; `left` where left out.
    pub edge: Given<Edge>,
    /// Where the middle of a notch inside is, from the left edge; for `edge: none` only, and needed there.
    pub center: Given<Length>,
    /// Of the notch, from end to end.
    pub length: Given<Length>,
    /// Where the notch ends among the elements along the crack plane; as long as given where left out. Atoms have neither
    /// corners nor edges: there it is as long as given. Not for `edge: none`.
    pub end: Given<NotchEnd>,
}

#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum NotchEnd {
    /// At the corner of elements that is nearest to the length given: six of them meet there.
    Corner,
    /// In the middle of an edge of an element, the nearest to the length given.
    MidEdge,
}

#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Edge {
    /// The crack runs right.
    Left,
    /// The crack runs left.
    Right,
    /// The notch lies inside and has two tips. The analysis follows the one that runs right, and measures the crack from the
    /// middle of the notch. Pictures and the table of broken bonds show both.
    None,
}

/// How the specimen is pulled.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Loading {
    /// The grips move apart so that the nominal strain grows at a constant rate.
    StrainRate(StrainRate),
}

/// The grips part at a constant rate.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct StrainRate {
    pub mode: Given<Mode>,
    /// Nominal strain rate.
    pub rate: Given<Rate>,
    pub ramp: Given<Ramp>,
    /// Width of a layer before each grip that takes waves out, so that few come back; none where left out.
    pub sponge: Given<Length>,
    /// Rate at which velocities everywhere approach those of even stretching, which takes heat out, and waves as fast;
    /// none where left out.
    pub damping: Given<Rate>,
}

/// Mode of the loading; `I` where left out.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
pub enum Mode {
    /// Opening.
    I,
}

/// How the motion begins.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Ramp {
    /// The interior starts with the velocities of the loading, so that no shock enters.
    InitialVelocity,
    /// The interior starts at rest.
    AtRest,
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
    /// Of each string of bonds between two elements its ends and this many Gauss points between them.
    Gauss(Given<Gauss>),
    /// Only the bonds of nodes: cheap, and wrong at every strain that is not uniform.
    Nodal,
}

/// Mass of the nodes; `lumped` where left out.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MassMatrix {
    /// A third of its mass at each node of a triangle.
    Lumped,
    /// As the sites of a triangle move with its nodes.
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

/// The time series.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Probes {
    /// Simulated time between rows of the time series.
    pub every: Given<Time>,
}

/// A table of the report, or snapshots.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Observe {
    Crack,
    StressProfile,
    WaveArrival,
    AverageStress,
    Snapshots(Snapshots),
}

/// Pictures of the whole specimen, for ParaView and the report.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Snapshots {
    /// A strain such as `0.05 % strain`, or a time.
    pub every: Given<Interval>,
}
