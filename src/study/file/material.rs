//! Material: pair potential, mass, thickness.

use crate::study::{
    quantity::{Energy, InverseLength, Length, Mass, Stiffness},
    reader::Given,
};
use schemars::JsonSchema;
use serde::Deserialize;

/// Potential, mass and thickness.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Material {
    pub potential: Given<Potential>,
    /// Mass of one atom.
    pub mass: Given<Mass>,
    /// What a 2D stress (force per length) is divided by to become a pressure.
    pub thickness: Given<Length>,
}

/// Pair potential.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Potential {
    LennardJones(LennardJones),
    Morse(Morse),
    HarmonicBond(HarmonicBond),
}

/// 4 epsilon ((sigma/r)^12 - (sigma/r)^6)
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct LennardJones {
    /// Depth of the well.
    pub epsilon: Given<Energy>,
    /// Where the energy is zero; the minimum is at 2^(1/6) of this.
    pub sigma: Given<Length>,
    /// Distance beyond which a pair does not interact.
    pub cutoff: Given<Length>,
    pub at_cutoff: Given<AtCutoff>,
}

/// depth ((1 - exp(-decay (r - distance)))^2 - 1)
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Morse {
    pub depth: Given<Energy>,
    pub decay: Given<InverseLength>,
    /// Where the energy is least.
    pub distance: Given<Length>,
    /// Distance beyond which a pair does not interact.
    pub cutoff: Given<Length>,
    pub at_cutoff: Given<AtCutoff>,
}

/// A spring that snaps at the cutoff.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct HarmonicBond {
    pub stiffness: Given<Stiffness>,
    /// Length of the bond at rest.
    pub distance: Given<Length>,
    /// Length at which the bond snaps.
    pub cutoff: Given<Length>,
    pub at_cutoff: Given<AtCutoff>,
}

/// What happens where the potential ends.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum AtCutoff {
    /// Cut where it stands: energy and force jump.
    Truncated,
    /// The energy is shifted to zero at the cutoff; the force jumps.
    Shifted,
    /// Energy and force are taken to zero between two distances.
    Smooth(Smooth),
}

/// The end of a potential that goes to zero smoothly.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Smooth {
    /// Up to here the potential is untouched.
    pub from: Given<Length>,
    /// Here energy and force are zero: the cutoff.
    pub to: Given<Length>,
}
