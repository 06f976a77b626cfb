//! What cases will cost, before anything is computed.

use super::CliError;
use crate::plan::PlannedCase;
use crate::setup::{self, Estimate};

/// The estimates of cases; an error names every case that is physical nonsense of a kind that only the mesh or the
/// material reveals.
pub fn estimates<'a>(cases: impl Iterator<Item = &'a PlannedCase>) -> Result<Vec<Estimate>, CliError> {
    let mut sound = Vec::new();
    let mut mistakes = Vec::new();
    for planned in cases {
        match setup::estimate(&planned.case) {
            Ok(estimate) => sound.push(estimate),
            Err(why) => mistakes.push(format!("case `{}`: {why}", planned.name)),
        }
    }
    if mistakes.is_empty() {
        Ok(sound)
    } else {
        Err(CliError::Input(mistakes.join("\nerror: ")))
    }
}
