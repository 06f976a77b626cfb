//! Intervals against what they are made of.

use super::SetupError;
use crate::study::Subject;
use crate::study::case::{Body, Case, Loading, Slab, SnapshotInterval};

/// Meshes of one study have steps of other lengths, so that some probes and pictures more than steps are no mistake; more than
/// these a step are one.
const MOST_A_STEP: f64 = 10.0;

/// Refuses probes and pictures that would come many times a step, rest that would be over between two probes, and damping that
/// would take all motion out within a step. The time step in ps.
pub fn refuse_too_short(case: &Case, strain_rate: Option<f64>, time_step: f64) -> Result<(), SetupError> {
    let damping = match &case.body {
        Body::Slab(Slab {
            loading: Loading::StrainRate { damping, .. },
            ..
        }) => *damping,
        Body::Slab(_) | Body::Solid(_) => None,
    };
    let step = ("a step", time_step);
    let part = ("a tenth of a step", time_step / MOST_A_STEP);
    let probe = ("the time between two probes", case.probes.every);
    let intervals = [
        (
            Subject::Probes,
            "the time between two probes",
            Some(case.probes.every),
            part,
        ),
        (
            Subject::Snapshots,
            "the time between two pictures",
            between_pictures(case, strain_rate),
            part,
        ),
        (
            Subject::UntilArrest,
            "the rest that ends the run",
            case.run.until.arrest,
            probe,
        ),
        (
            Subject::Damping,
            "the time in which motion is damped",
            damping.map(f64::recip),
            step,
        ),
    ];
    for (subject, what, interval, (least_is, least)) in intervals {
        if let Some(interval) = interval.filter(|&interval| interval < least) {
            return Err(SetupError::TooShort {
                subject,
                what,
                interval,
                least,
                least_is,
            });
        }
    }
    Ok(())
}

/// Time between two pictures, ps, under a loading that makes so much strain a ps, if it makes any.
pub fn between_pictures(case: &Case, strain_rate: Option<f64>) -> Option<f64> {
    match case.snapshots.every? {
        SnapshotInterval::Strain(strain) => strain_rate.map(|rate| strain / rate),
        SnapshotInterval::Time(time) => Some(time),
    }
}
