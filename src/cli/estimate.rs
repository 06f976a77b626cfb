//! What a case will cost, before anything is computed.

use super::CliError;
use crate::plan::PlannedCase;
use crate::setup::{self, Estimate};

/// The estimate of a case; an error is physical nonsense that only the mesh or the material reveals.
pub fn estimate(planned: &PlannedCase) -> Result<Estimate, CliError> {
    setup::estimate(&planned.case).map_err(|why| CliError::Input(format!("case `{}`: {why}", planned.name)))
}
