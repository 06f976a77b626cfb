//! What a solid keeps: the work of its loading.

use hdf5::Group;

use super::Keep;
use crate::record::arrays::{Packing, get, get_scalar, put, put_scalar};
use crate::solver::solid::Kept;

impl Keep for Kept {
    fn put(&self, group: &Group) -> hdf5::Result<()> {
        // Taken apart by name, so that a new member cannot be forgotten here.
        let Kept { works, last_strain } = self;
        put(group, "works", "eV", &[works.len()], works, Packing::Plain)?;
        put_scalar(group, "last_strain", "1", *last_strain)
    }

    fn get(group: &Group) -> hdf5::Result<Self> {
        Ok(Self {
            works: get(group, "works")?,
            last_strain: get_scalar(group, "last_strain")?,
        })
    }
}
