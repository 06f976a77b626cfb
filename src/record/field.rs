//! The fields that ParaView shows, and their units.

use hdf5::Group;

use super::frames::{Row, Tensor, Vector};
use super::packed::Packed;
use super::snapshots::{DAMAGE, DISPLACEMENT, STRESS, VELOCITY};
use crate::units::{EV_PER_NM3_IN_GPA, NM_PER_PS_IN_M_PER_S};

/// A field as ParaView shows it.
pub(super) struct Field {
    pub name: &'static str,
    pub unit: &'static str,
    /// Numbers a node or cell: 3 a vector, 6 a symmetric tensor xx, yy, zz, xy, yz, xz.
    pub width: usize,
    /// Whether it has a row a node; otherwise it has one a cell.
    pub on_points: bool,
    /// Where a picture of the run has what it is made of, and how many numbers a node or cell these are.
    pub source: (&'static str, usize),
    /// Makes it of some of these.
    pub of: fn(&[f64]) -> Vec<f32>,
}

pub(super) fn point_fields<V: Vector>() -> [Field; 2] {
    [
        Field {
            name: "displacement",
            unit: "nm",
            width: 3,
            on_points: true,
            source: (DISPLACEMENT, V::WIDTH),
            of: |numbers| vectors::<V>(numbers, 1.0),
        },
        Field {
            name: "velocity",
            unit: "m/s",
            width: 3,
            on_points: true,
            source: (VELOCITY, V::WIDTH),
            of: |numbers| vectors::<V>(numbers, NM_PER_PS_IN_M_PER_S),
        },
    ]
}

pub(super) fn cell_fields<V: Vector>() -> [Field; 3] {
    [
        Field {
            name: "virial_stress",
            unit: "GPa",
            width: 6,
            on_points: false,
            source: (STRESS, V::Stress::WIDTH),
            of: |numbers| tensors::<V::Stress>(numbers).flatten().map(giga_pascal).collect(),
        },
        Field {
            name: "sigma_yy",
            unit: "GPa",
            width: 1,
            on_points: false,
            source: (STRESS, V::Stress::WIDTH),
            of: |numbers| {
                tensors::<V::Stress>(numbers)
                    .map(|stress| giga_pascal(stress[1]))
                    .collect()
            },
        },
        Field {
            name: "damage",
            unit: "1",
            width: 1,
            on_points: false,
            source: (DAMAGE, 1),
            of: |numbers| numbers.iter().map(|&damage| damage as f32).collect(),
        },
    ]
}

impl Field {
    /// An empty dataset that holds the field for all steps, one after the other.
    pub(super) fn create(&self, group: &Group, rows: usize) -> hdf5::Result<Packed<f32>> {
        let shape: &[usize] = if self.width == 1 { &[rows] } else { &[rows, self.width] };
        Packed::create(group, self.name, self.unit, shape)
    }
}

/// With zeros for the axes that the space does not have.
pub(super) fn padded<R: Row>(row: R) -> [f64; 3] {
    let numbers = R::flat(std::slice::from_ref(&row)).iter();
    let mut padded = [0.0; 3];
    padded
        .iter_mut()
        .zip(numbers)
        .for_each(|(place, &number)| *place = number);
    padded
}

fn vectors<V: Vector>(numbers: &[f64], scale: f64) -> Vec<f32> {
    let rows = numbers.chunks_exact(V::WIDTH);
    rows.flat_map(|row| padded(V::of(row)).map(|component| (component * scale) as f32))
        .collect()
}

/// In VTK's order, with zeros for what the tensors do not have.
fn tensors<T: Tensor>(numbers: &[f64]) -> impl Iterator<Item = [f64; 6]> {
    let tensors = numbers.chunks_exact(T::WIDTH);
    tensors.map(|components| T::IN_VTK.map(|component| component.map_or(0.0, |component| components[component])))
}

/// Counterpart of [`tensors`].
pub(super) fn from_vtk<T: Tensor>(components: [f64; 6]) -> T {
    let mut stress = vec![0.0; T::WIDTH];
    let in_vtk = T::IN_VTK.into_iter().zip(components);
    in_vtk.for_each(|(place, number)| place.into_iter().for_each(|place| stress[place] = number));
    T::of(&stress)
}

fn giga_pascal(stress: f64) -> f32 {
    (stress * EV_PER_NM3_IN_GPA) as f32
}
