//! The fields that ParaView shows, and their units.

use hdf5::Group;

use super::frames::Frame;
use super::packed::Packed;
use crate::units::{EV_PER_NM3_IN_GPA, NM_PER_PS_IN_M_PER_S};

/// A field as ParaView shows it.
pub(super) struct Field {
    pub name: &'static str,
    pub unit: &'static str,
    /// Numbers a node or cell: 3 a vector, 6 a symmetric tensor xx, yy, zz, xy, yz, xz.
    pub width: usize,
    pub of: fn(&Frame) -> Vec<f32>,
}

pub(super) const POINT_FIELDS: [Field; 2] = [
    Field {
        name: "displacement",
        unit: "nm",
        width: 3,
        of: |frame| vectors(&frame.displacement, 1.0),
    },
    Field {
        name: "velocity",
        unit: "m/s",
        width: 3,
        of: |frame| vectors(&frame.velocity, NM_PER_PS_IN_M_PER_S),
    },
];

pub(super) const CELL_FIELDS: [Field; 3] = [
    Field {
        name: "virial_stress",
        unit: "GPa",
        width: 6,
        of: |frame| tensors(&frame.stress),
    },
    Field {
        name: "sigma_yy",
        unit: "GPa",
        width: 1,
        of: |frame| frame.stress.iter().map(|s| giga_pascal(s[1])).collect(),
    },
    Field {
        name: "damage",
        unit: "1",
        width: 1,
        of: |frame| frame.damage.iter().map(|d| *d as f32).collect(),
    },
];

impl Field {
    /// An empty dataset that holds the field for all steps, one after the other.
    pub(super) fn create(&self, group: &Group, rows: usize) -> hdf5::Result<Packed<f32>> {
        let shape: &[usize] = if self.width == 1 { &[rows] } else { &[rows, self.width] };
        Packed::create(group, self.name, self.unit, shape)
    }
}

fn vectors(rows: &[[f64; 2]], scale: f64) -> Vec<f32> {
    rows.iter()
        .flat_map(|[x, y]| [(x * scale) as f32, (y * scale) as f32, 0.0])
        .collect()
}

fn tensors(rows: &[[f64; 3]]) -> Vec<f32> {
    rows.iter()
        .flat_map(|s| [giga_pascal(s[0]), giga_pascal(s[1]), 0.0, giga_pascal(s[2]), 0.0, 0.0])
        .collect()
}

fn giga_pascal(stress: f64) -> f32 {
    (stress * EV_PER_NM3_IN_GPA) as f32
}
