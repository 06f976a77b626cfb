//! What cases will cost, before anything is computed.

use super::CliError;
use crate::plan::{Plan, PlannedCase};
use crate::setup::{Estimate, Estimator};

/// The estimates of cases of a plan; an error tells every case that is physical nonsense of a kind that only the mesh
/// or the material reveals.
pub fn estimates<'a>(plan: &Plan, cases: impl IntoIterator<Item = &'a PlannedCase>) -> Result<Vec<Estimate>, CliError> {
    let mut sound = Vec::new();
    let mut refusals = Vec::new();
    let mut estimator = Estimator::default();
    for planned in cases {
        match estimator.estimate(&planned.case) {
            Ok(estimate) => sound.push(estimate),
            Err(why) => refusals.push((planned.name.as_str(), why.refusal())),
        }
    }
    if refusals.is_empty() {
        Ok(sound)
    } else {
        Err(plan.refuse(refusals).into())
    }
}
