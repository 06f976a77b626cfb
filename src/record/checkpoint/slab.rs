//! What a slab keeps: its grips and sponges, and its crack.

use hdf5::Group;

use super::Keep;
use crate::loading::Booked;
use crate::record::arrays::{Packing, get, get_rows, get_scalar, new_group, put, put_scalar};
use crate::record::bonds::{get_bonds, put_bonds};
use crate::solver::slab::Kept;

impl Keep for Kept {
    fn put(&self, group: &Group) -> hdf5::Result<()> {
        // Taken apart by name, so that a new member cannot be forgotten here.
        let Kept {
            booked: Booked {
                impulses,
                absorbed,
                works,
            },
            earlier_work,
            refined,
            outruns,
            broken_bonds,
            parted_bonds,
            joins,
            last_advance,
            farthest_tip,
            damage_front,
            branched,
            left_plane,
        } = self;
        for (name, unit, numbers) in [
            ("grip_impulses", "eV ps/nm", impulses),
            ("absorbed", "eV", absorbed),
            ("works", "eV", works),
        ] {
            put(group, name, unit, &[numbers.len()], numbers, Packing::Plain)?;
        }
        put(group, "refined", "1", &[refined.len()], refined, Packing::Plain)?;
        put_scalar(group, "outruns", "1", *outruns)?;
        put(group, "joins", "1", &[joins.len()], joins, Packing::Plain)?;
        let shape = [broken_bonds.len(), 3];
        let broken = broken_bonds.as_flattened();
        put(group, "broken_bonds", "1", &shape, broken, Packing::Plain)?;
        put_bonds(&new_group(group, "parted_bonds")?, parted_bonds)?;
        for (name, unit, number) in [
            ("earlier_work", "eV", earlier_work),
            ("last_advance", "ps", last_advance),
            ("farthest_tip", "nm", farthest_tip),
            ("damage_front", "nm", damage_front),
            ("branched", "ps", branched),
            ("left_plane", "ps", left_plane),
        ] {
            put_scalar(group, name, unit, *number)?;
        }
        Ok(())
    }

    fn get(group: &Group) -> hdf5::Result<Self> {
        Ok(Self {
            booked: Booked {
                impulses: get(group, "grip_impulses")?,
                absorbed: get(group, "absorbed")?,
                works: get(group, "works")?,
            },
            earlier_work: get_scalar(group, "earlier_work")?,
            refined: get(group, "refined")?,
            outruns: get_scalar(group, "outruns")?,
            broken_bonds: get_rows(group, "broken_bonds")?,
            parted_bonds: get_bonds(&group.group("parted_bonds")?)?,
            joins: get(group, "joins")?,
            last_advance: get_scalar(group, "last_advance")?,
            farthest_tip: get_scalar(group, "farthest_tip")?,
            damage_front: get_scalar(group, "damage_front")?,
            branched: get_scalar(group, "branched")?,
            left_plane: get_scalar(group, "left_plane")?,
        })
    }
}
