//! An all-atom case as LAMMPS input: a script and a data file.
//!
//! `units lj` multiplies by no conversion constants, so lengths stand there in nm, energies in eV, times in ps and
//! masses in eV ps^2/nm^2: LAMMPS computes with the very numbers of this program. Nothing is reduced, and nothing is
//! rounded. (`units metal` would put LAMMPS' own constants of nature between the two.)

mod atom_types;
mod crystal;
mod pair_styles;
mod script;
mod solid;
mod times;

pub use crystal::Crystal;
pub use script::Motion;
pub use solid::SolidModel;
pub use times::Times;

use crate::material::Material;
use crate::mesh::Mesh;
use crate::study::case::{Case, Slab};
use atom_types::AtomTypes;
use pair_styles::PairStyles;

/// Why a case has no equal in LAMMPS.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ExportError {
    #[error(
        "its elements have {element} atoms per edge, and LAMMPS knows single atoms only; \
         export a case with `resolution: {{element: 1}}`"
    )]
    NotAtoms { element: u32 },
    #[error(
        "it comes to rest before it moves, and the input starts from the perfect lattice; \
         export a case without `run.relax`"
    )]
    Relaxed,
    #[error(
        "its atoms are displaced at the start, and the input starts from the perfect lattice; \
         export a case without `run.noise`"
    )]
    Displaced,
    #[error(
        "a plane of it is severed, and LAMMPS would need types of atoms for every row of sites near its end; \
         export a case whose notch is `blocks` that are left out"
    )]
    Severed,
    #[error("LAMMPS has no pair style that equals {what}; it has those that equal {available}")]
    NoPairStyle {
        what: &'static str,
        available: &'static str,
    },
}

/// What LAMMPS must know of a slab.
pub struct Model<'a> {
    pub crystal: Crystal,
    mesh: &'a Mesh,
}

impl<'a> Model<'a> {
    pub fn new(case: &Case, slab: &Slab, material: &Material, mesh: &'a Mesh) -> Result<Self, ExportError> {
        refuse_what_is_not_there(case)?;
        let crystal = Crystal {
            dimension: 2,
            spacing: material.spacing,
            site_mass: material.site_mass,
            styles: PairStyles::new(&slab.material.atoms.potential, material)?,
            types: AtomTypes::new(mesh, material.interaction.cutoff() / material.spacing),
        };
        Ok(Self { crystal, mesh })
    }
}

fn refuse_what_is_not_there(case: &Case) -> Result<(), ExportError> {
    let element = case.element();
    if element != 1 {
        return Err(ExportError::NotAtoms { element });
    }
    if case.run.relax.is_some() {
        return Err(ExportError::Relaxed);
    }
    match case.run.noise {
        Some(_) => Err(ExportError::Displaced),
        None => Ok(()),
    }
}

/// A number that reads back to the bit: 17 digits.
fn exact(number: f64) -> String {
    format!("{number:.16e}")
}
