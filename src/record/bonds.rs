//! Bonds that broke or closed, in HDF5.

use hdf5::Group;

use super::arrays::{Packing, get, get_column, put};
use super::packed::Number;
use crate::analysis::series::BondEvent;

/// A column a member.
pub(super) fn put_bonds(group: &Group, bonds: &[BondEvent]) -> hdf5::Result<()> {
    fn column<T: Number>(group: &Group, name: &str, bonds: &[BondEvent], of: fn(&BondEvent) -> T) -> hdf5::Result<()> {
        let column: Vec<T> = bonds.iter().map(of).collect();
        put(group, name, "1", &[bonds.len()], &column, Packing::Deflated)
    }
    column(group, "probe", bonds, |bond| bond.probe)?;
    column(group, "column", bonds, |bond| bond.column)?;
    column(group, "row", bonds, |bond| bond.row)?;
    column(group, "direction", bonds, |bond| bond.direction)?;
    column(group, "broken", bonds, |bond| bond.broken)
}

/// Counterpart of [`put_bonds`].
pub(super) fn get_bonds(group: &Group) -> hdf5::Result<Vec<BondEvent>> {
    let probe: Vec<u32> = get(group, "probe")?;
    let column: Vec<i32> = get_column(group, "column", probe.len())?;
    let row: Vec<i32> = get_column(group, "row", probe.len())?;
    let direction: Vec<u8> = get_column(group, "direction", probe.len())?;
    let broken: Vec<bool> = get_column(group, "broken", probe.len())?;
    Ok((0..probe.len())
        .map(|bond| BondEvent {
            probe: probe[bond],
            column: column[bond],
            row: row[bond],
            direction: direction[bond],
            broken: broken[bond],
        })
        .collect())
}
