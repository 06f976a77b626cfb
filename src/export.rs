//! Cases as input of other programs, so that others can check and time the same physics.

pub mod lammps;
pub mod ovito;
