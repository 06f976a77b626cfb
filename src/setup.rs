//! A resolved case becomes a ready solver, and a run its folder.

mod burden;
mod caution;
mod error;
mod estimate;
mod expected;
mod intervals;
pub mod memory;
mod recorder;
mod run;
pub mod slab;
pub mod solid;

pub use burden::burdens;
pub use caution::cautions;
pub use error::SetupError;
pub use estimate::{Estimate, Estimator, Specimen};
pub use run::{Finished, MOST_THREADS_A_CORE, RunCaseError, run_case};
pub use slab::geometry::{Geometry, Notch, Size};
pub use slab::leftovers::Leftovers;

use std::time::Duration;

use crate::forces::Summation;
use crate::potential::{AtCutoff, CutPotential, HarmonicBond, Interaction, LennardJones, Morse};
use crate::solver::{self, TimeStep};
use crate::state::Noise;
use crate::study::case::{self, Case};
use crate::units::U_IN_EV_PS2_PER_NM2;

/// Longest cutoff in units of the distance of lowest energy.
const MOST_MINIMA: f64 = 10.0;

/// What the stresses of a solid are divided by: they are pressures.
const NO_THICKNESS: f64 = 1.0;

/// What two atoms do to each other, and the mass of one, eV ps^2/nm^2.
fn interaction(atoms: &case::Material) -> Result<(Interaction, f64), SetupError> {
    let potential = &atoms.potential;
    let at_cutoff = match potential.at_cutoff {
        case::AtCutoff::Truncated => AtCutoff::Truncated,
        case::AtCutoff::Shifted => AtCutoff::Shifted,
        case::AtCutoff::Smooth { from } => AtCutoff::Smooth { from },
    };
    let cutoff = potential.cutoff;
    let interaction = match potential.shape {
        case::PotentialShape::LennardJones { epsilon, sigma } => {
            Interaction::LennardJones(CutPotential::new(LennardJones { epsilon, sigma }, cutoff, at_cutoff))
        }
        case::PotentialShape::Morse { depth, decay, distance } => {
            Interaction::Morse(CutPotential::new(Morse { depth, decay, distance }, cutoff, at_cutoff))
        }
        case::PotentialShape::HarmonicBond { stiffness, distance } => Interaction::HarmonicBond(CutPotential::new(
            HarmonicBond { stiffness, distance },
            cutoff,
            at_cutoff,
        )),
    };
    let minimum = interaction.minimum();
    if cutoff > MOST_MINIMA * minimum {
        return Err(SetupError::CutoffTooLong {
            cutoff,
            minimum,
            most: MOST_MINIMA,
        });
    }
    Ok((interaction, atoms.mass * U_IN_EV_PS2_PER_NM2))
}

fn summation(of_case: case::Summation) -> Summation {
    match of_case {
        case::Summation::Exact => Summation::Exact,
        case::Summation::Gauss { points } => Summation::Gauss { points },
        case::Summation::StrictGauss { points } => Summation::StrictGauss { points },
        case::Summation::Nodal => Summation::Nodal,
    }
}

/// How a case is computed; `time_of` tells when its loading has made a nominal strain, ps.
fn settings(case: &Case, time_of: impl Fn(f64) -> f64) -> solver::Settings {
    solver::Settings {
        time_step: match case.run.time_step {
            case::TimeStep::Auto { fraction } => TimeStep::Auto { fraction },
            case::TimeStep::Given(step) => TimeStep::Given(step),
        },
        summation: summation(case.run.summation),
        consistent_mass: case.run.mass.consistent_share(),
        refine: None,
        relax: case.run.relax.is_some(),
        noise: case.run.noise.map(|noise| Noise {
            amplitude: noise.amplitude,
            seed: u64::from(noise.seed),
        }),
        until: solver::Until {
            strain: case.run.until.strain,
            time: case.run.until.time,
            crack_length: case.run.until.crack_length,
            arrest: case.run.until.arrest,
            after_branch: case.run.until.after_branch,
            leaves_plane: case.run.until.leaves_the_plane,
        },
        probe_every: case.probes.every,
        snapshot_every: case.snapshots.every.map(|interval| match interval {
            case::SnapshotInterval::Strain(strain) => time_of(strain),
            case::SnapshotInterval::Time(time) => time,
        }),
        checkpoint_every: Duration::from_secs_f64(case.execution.checkpoint_every),
        thickness: NO_THICKNESS,
    }
}
