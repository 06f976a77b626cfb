//! A solid becomes a mesh, a loading and a solver.

mod estimate;
mod plan;
mod specimen;
mod words;

pub use estimate::Estimator;
pub use plan::{Laid, lay_out};
pub use specimen::{Kind, Specimen};

use super::{SetupError, interaction};
use crate::material::Material;
use crate::study::case::Solid;
use crate::study::case::solid::Loading;

/// The crystal of a solid.
pub fn material(solid: &Solid) -> Result<Material, SetupError> {
    let (interaction, site_mass) = interaction(&solid.material)?;
    Material::face_centred_cubic(interaction, site_mass).ok_or(SetupError::NoLattice {
        cutoff: interaction.cutoff(),
        minimum: interaction.minimum(),
    })
}

/// Nominal strain a ps, where the loading makes one.
pub fn strain_rate(solid: &Solid) -> Option<f64> {
    let Loading::Velocity {
        face,
        speed,
        direction,
        depth,
        ..
    } = solid.loading
    else {
        return None;
    };
    let spacing = material(solid).ok()?.spacing;
    let laid = lay_out(solid, spacing).ok()?;
    Some(speed / laid.strained_length(solid, face, direction, depth))
}
