//! Pair styles of LAMMPS that equal the potentials of this program.

use super::{ExportError, exact};
use crate::material::Material;
use crate::study::case::{AtCutoff, Potential, PotentialShape};

/// A pair style with its settings.
#[derive(Clone, Debug, PartialEq)]
pub struct Style {
    pub name: &'static str,
    /// Cutoffs, as `pair_style` takes them.
    pub settings: String,
    /// What `pair_coeff` takes.
    pub coefficients: String,
    /// Whether the energy is shifted to zero at the cutoff.
    pub shifted: bool,
}

/// How bonded pairs interact, and how those that a cut severs do.
#[derive(Clone, Debug, PartialEq)]
pub struct PairStyles {
    pub bonded: Style,
    pub severed: Style,
}

impl PairStyles {
    pub fn new(potential: &Potential, material: &Material) -> Result<Self, ExportError> {
        let (name, coefficients, stretched) = shape(&potential.shape, material)?;
        let cutoff = exact(potential.cutoff);
        let bonded = |name, settings, shifted| Style {
            name,
            settings,
            coefficients: coefficients.clone(),
            shifted,
        };
        let bonded = match (&potential.at_cutoff, name) {
            (AtCutoff::Truncated, _) => bonded(name, cutoff, false),
            (AtCutoff::Shifted, _) => bonded(name, cutoff, true),
            // Mei, Davenport and Fernando's factor is the switch of this program.
            (AtCutoff::Smooth { from }, "lj/cut") => bonded("lj/mdf", format!("{} {cutoff}", exact(*from)), false),
            (AtCutoff::Smooth { .. }, _) => {
                return Err(ExportError::NoPairStyle {
                    what: "a Morse potential with a smooth cutoff",
                    available: "a truncated or shifted one, and `lennard-jones` with any cutoff",
                });
            }
        };
        // The potential up to its minimum, stretched so that the minimum falls on the lattice spacing.
        let severed = Style {
            name,
            settings: exact(material.spacing),
            coefficients: stretched,
            shifted: true,
        };
        Ok(Self { bonded, severed })
    }
}

/// The pair style of a shape, its coefficients, and those of the shape stretched to the lattice spacing.
fn shape(shape: &PotentialShape, material: &Material) -> Result<(&'static str, String, String), ExportError> {
    let stretch = material.spacing / material.interaction.minimum();
    let row = |numbers: &[f64]| {
        numbers
            .iter()
            .map(|&number| exact(number))
            .collect::<Vec<_>>()
            .join(" ")
    };
    match *shape {
        PotentialShape::LennardJones { epsilon, sigma } => {
            Ok(("lj/cut", row(&[epsilon, sigma]), row(&[epsilon, sigma * stretch])))
        }
        PotentialShape::Morse { depth, decay, distance } => Ok((
            "morse",
            row(&[depth, decay, distance]),
            row(&[depth, decay / stretch, distance * stretch]),
        )),
        PotentialShape::HarmonicBond { .. } => Err(ExportError::NoPairStyle {
            what: "`harmonic-bond`, which binds whatever pair comes within its cutoff",
            available: "`lennard-jones` and `morse`",
        }),
    }
}
