//! A resolved case becomes a ready solver, and a run its folder.

mod caution;
mod error;
mod estimate;
mod intervals;
pub mod memory;
mod recorder;
mod run;
pub mod slab;
pub mod solid;

pub use caution::cautions;
pub use error::SetupError;
pub use estimate::{Estimate, Estimator, Specimen};
pub use run::{Finished, MOST_THREADS_A_CORE, RunCaseError, run_case};
pub use slab::burden::burdens;
pub use slab::geometry::{Geometry, Notch, Size};
pub use slab::leftovers::Leftovers;

use crate::potential::{AtCutoff, CutPotential, HarmonicBond, Interaction, LennardJones, Morse};
use crate::study::case;
use crate::units::U_IN_EV_PS2_PER_NM2;

/// Longest cutoff in units of the distance of lowest energy.
const MOST_MINIMA: f64 = 10.0;

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
