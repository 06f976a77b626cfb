use super::super::{
    named::Named,
    quantity::{Fraction, Length, Time},
    reader::Given,
};
use schemars::JsonSchema;
use serde::Deserialize;

/// What the report shows beside its tables and figures.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Report {
    /// Headline of the report; the name of the study where left out.
    pub title: Given<String>,
    /// Cases to be shown in pictures at strains of interest, the first of them also in motion.
    pub stages: Given<Stages>,
    /// The cases differ in `run.ranks`, to learn what ranks gain: every case has a run of its own, and the report shows
    /// speedup and efficiency.
    pub scaling: Given<Growth>,
    /// Other studies, whose cases stand beside those of the same name here. Each is the name of a file in the folder of
    /// this study, without `.yaml`, or of a study that comes with the program.
    pub beside: Given<Vec<Given<String>>>,
    /// Cases of this study to be set side by side, by a heading such as `time step`.
    pub side_by_side: Given<Named<SideBySideFile>>,
    /// How the figures are drawn as files.
    pub figures: Given<Figures>,
}

/// The line figures as SVG files, for a paper.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Figures {
    /// Width of each, such as 86 mm, the column of a journal; 600 pixels where left out.
    pub width: Given<Length>,
}

/// The pictures nearest to these strains are shown, and all of the first case one after the other.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Stages {
    /// Names of the cases.
    pub cases: Given<Vec<Given<String>>>,
    /// Nominal strains at which they are shown.
    pub strains: Given<Vec<Given<Fraction>>>,
}

/// What becomes of the specimen when there are more ranks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Growth {
    /// It stays the same, so that each rank gets less of it.
    Fixed,
    /// It becomes as many times wider, so that each rank gets as much of it.
    Scaled,
}

impl Growth {
    /// Size of the specimen of so many ranks over that of one.
    pub fn with(self, ranks: u32) -> f64 {
        match self {
            Growth::Fixed => 1.0,
            Growth::Scaled => f64::from(ranks),
        }
    }
}

/// The first of the cases is what the others are measured against.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
#[schemars(rename = "SideBySide")]
pub struct SideBySideFile {
    /// Names of at least two cases.
    pub cases: Given<Vec<Given<String>>>,
    /// How near the others must come to the first; the report says whether they do.
    pub agree: Given<Agreement>,
}

/// Both may be given.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Agreement {
    /// Difference of the strains at initiation, over that of the first.
    pub initiation_strain: Given<Fraction>,
    /// Difference of the times from start to first branch.
    pub first_branch: Given<Time>,
}
