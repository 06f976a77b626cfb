//! What a report is made from: plain values, whoever read them from where.

use super::film::Film;
use super::solid::specimen::Solid;
use crate::analysis::series::{Series, Setting};
use crate::domain::{Burden, MessageCost};
use crate::plan::{Comparison, SideBySide, Stages, Swept};
use crate::study::Growth;

/// A study and the results of its cases, in the order in which they are to be shown.
#[derive(Clone, Debug, Default)]
pub struct Study {
    pub name: String,
    /// Heading of the report; the name where there is none.
    pub title: Option<String>,
    pub question: Option<String>,
    /// The study file as typed.
    pub text: String,
    /// Width of the figures as files of their own, nm; 600 pixels where there is none.
    pub figure_width: Option<f64>,
    /// The case to be shown through time, and at which strains.
    pub stages: Option<Stages>,
    /// Where the cases are to show what ranks gain.
    pub scaling: Option<Scaling>,
    /// What the cases are to be compared with.
    pub comparisons: Vec<Comparison>,
    /// Studies whose cases stand beside those of the same names here.
    pub others: Vec<OtherStudy>,
    /// Cases to be set side by side.
    pub side_by_side: Vec<SideBySide>,
    pub cases: Vec<CaseResult>,
}

/// Cases that differ in their ranks.
#[derive(Clone, Debug)]
pub struct Scaling {
    pub growth: Growth,
    /// What would fall to the busiest of so many ranks, from one rank on; empty where that cannot be told.
    pub burdens: Vec<Burden>,
    /// Times of another program.
    pub compared: Vec<Comparison>,
}

/// What there is of another study.
#[derive(Clone, Debug, Default)]
pub struct OtherStudy {
    pub name: String,
    /// Its cases that are done and have the name of one here.
    pub cases: Vec<CaseResult>,
    /// What of it is missing, and what to do about it.
    pub missing: Option<String>,
}

/// One case: what was asked for, what came out, or why nothing did.
#[derive(Clone, Debug, Default)]
pub struct CaseResult {
    pub name: String,
    /// Hash of the resolved case.
    pub id: String,
    /// The resolved case as text, every default filled in.
    pub resolved: String,
    /// The resolved case as pairs of dotted key and value, as a person reads them; the report shows those that differ
    /// between the cases.
    pub choices: Vec<(String, String)>,
    /// The name that a sweep started from, and what it has set.
    pub origin: String,
    pub swept: Vec<Swept>,
    /// The name of the case that it repeats with noise of its own.
    pub repeat_of: Option<String>,
    /// `None` where that cannot be told on this machine.
    pub specimen: Option<Specimen>,
    /// `None` where the case did not come as far as its set-up.
    pub setting: Option<Setting>,
    pub series: Series,
    /// The pictures that the run took.
    pub film: Option<Film>,
    /// Of a solid, which has no setting, series and film of a slab.
    pub solid: Option<Solid>,
    pub manifest: Manifest,
    /// Hash of all that it has computed, where runs of one case are compared.
    pub digest: Option<String>,
    pub failure: Option<Failure>,
}

impl CaseResult {
    /// Time that processors worked, s.
    pub fn core_seconds(&self) -> Option<f64> {
        self.manifest.core_seconds
    }

    /// Whether its run has left pictures.
    pub fn has_pictures(&self) -> bool {
        self.film.is_some() || self.solid.as_ref().is_some_and(|solid| solid.film.is_some())
    }
}

/// A specimen as asked for and as laid out of whole elements; lengths in nm, asked before actual.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Specimen {
    pub length: [f64; 2],
    pub width: [f64; 2],
    pub height_between_grips: [f64; 2],
    /// `None` where there is no crack, as are the next two where nobody has laid the elements.
    pub crack: Option<[f64; 2]>,
    pub notch_end: Option<&'static str>,
    /// Share of the atoms in smaller elements than asked for, and where those are.
    pub leftover_share: Option<f64>,
    pub leftover_where: Vec<&'static str>,
    pub grip_thickness: f64,
    /// Of each grip, nm/ps.
    pub grip_speed: f64,
    /// Equal for cases that are one computation, however they were asked for.
    pub computation: u64,
}

/// How a case was carried out. What is not known is `None`.
#[derive(Clone, Debug, Default)]
pub struct Manifest {
    /// Where the run stands: `done`, `failed`, `interrupted`, `missing`.
    pub state: String,
    /// Program version and source commit.
    pub version: String,
    pub commit: Option<String>,
    pub host: Option<String>,
    pub ranks: Option<u32>,
    pub threads: Option<u32>,
    /// Times of day as text.
    pub started: Option<String>,
    pub ended: Option<String>,
    pub wall_seconds: Option<f64>,
    /// Time that processors worked for all ranks and threads, s.
    pub core_seconds: Option<f64>,
    /// Which condition ended the run.
    pub end_reason: Option<String>,
    /// Time step used and the stability limit, ps.
    pub time_step: Option<f64>,
    pub stability_limit: Option<f64>,
    pub steps: Option<u64>,
    /// Largest energy imbalance over the largest work.
    pub energy_error: Option<f64>,
    /// The closest that sites have come, as a share of the spacing.
    pub closest_approach: Option<f64>,
    /// Largest memory of the solver, bytes.
    pub peak_memory: Option<f64>,
    pub cost: Vec<Phase>,
    /// What messages cost between its ranks.
    pub messages: Option<MessageCost>,
}

/// Time spent in one part of the computation.
#[derive(Clone, Debug, Default)]
pub struct Phase {
    pub name: String,
    pub calls: u64,
    pub seconds: f64,
}

/// Why a case has no result.
#[derive(Clone, Debug, Default)]
pub struct Failure {
    pub reason: String,
    /// The last lines of the log.
    pub log_tail: String,
}
