//! The fields that ParaView shows, and their units.

use hdf5::Group;

use super::frames::{Frame, Row, Tensor, Vector};
use super::packed::Packed;
use crate::units::{EV_PER_NM3_IN_GPA, NM_PER_PS_IN_M_PER_S};

/// A field as ParaView shows it.
pub(super) struct Field<V: Vector> {
    pub name: &'static str,
    pub unit: &'static str,
    /// Numbers a node or cell: 3 a vector, 6 a symmetric tensor xx, yy, zz, xy, yz, xz.
    pub width: usize,
    pub of: fn(&Frame<V>) -> Vec<f32>,
}

pub(super) fn point_fields<V: Vector>() -> [Field<V>; 2] {
    [
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
    ]
}

pub(super) fn cell_fields<V: Vector>() -> [Field<V>; 3] {
    [
        Field {
            name: "virial_stress",
            unit: "GPa",
            width: 6,
            of: |frame| frame.stress.iter().flat_map(tensor).map(giga_pascal).collect(),
        },
        Field {
            name: "sigma_yy",
            unit: "GPa",
            width: 1,
            of: |frame| frame.stress.iter().map(|s| giga_pascal(tensor(s)[1])).collect(),
        },
        Field {
            name: "damage",
            unit: "1",
            width: 1,
            of: |frame| frame.damage.iter().map(|d| *d as f32).collect(),
        },
    ]
}

impl<V: Vector> Field<V> {
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

fn vectors<V: Vector>(rows: &[V], scale: f64) -> Vec<f32> {
    rows.iter()
        .flat_map(|&row| padded(row).map(|component| (component * scale) as f32))
        .collect()
}

/// In VTK's order, with zeros for what the tensor does not have.
fn tensor<T: Tensor>(stress: &T) -> [f64; 6] {
    let components = T::flat(std::slice::from_ref(stress));
    T::IN_VTK.map(|component| component.map_or(0.0, |component| components[component]))
}

/// Counterpart of [`tensor`].
pub(super) fn from_vtk<T: Tensor>(components: [f64; 6]) -> T {
    let mut stress = vec![0.0; T::WIDTH];
    let in_vtk = T::IN_VTK.into_iter().zip(components);
    in_vtk.for_each(|(place, number)| place.into_iter().for_each(|place| stress[place] = number));
    T::of(&stress)
}

fn giga_pascal(stress: f64) -> f32 {
    (stress * EV_PER_NM3_IN_GPA) as f32
}
