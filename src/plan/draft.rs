//! A case on its way from the study file.

use super::swept::Swept;
use crate::study::{CaseFile, Given, Place};

/// A case before its choices are checked.
#[derive(Clone)]
pub struct Draft {
    pub name: String,
    /// The name that the sweep started from.
    pub origin: String,
    /// Where its name comes from.
    pub place: Place,
    pub values: Given<CaseFile>,
    pub swept: Vec<Swept>,
    /// The name of what it repeats.
    pub repeat_of: Option<String>,
}
