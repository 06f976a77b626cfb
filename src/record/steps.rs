//! The time steps of a transient grid: their times, and where in each array they begin.

use hdf5::Group;

use super::arrays::{Packing, new_group, put};
use super::field::{cell_fields, point_fields};
use super::frames::Vector;
use super::mesh::Sizes;

/// What the file says of every step.
#[derive(Default)]
pub(super) struct Steps {
    time: Vec<f64>,
    step: Vec<u64>,
    strain: Vec<f64>,
    /// The number of its mesh.
    part: Vec<usize>,
}

impl Steps {
    pub(super) fn push(&mut self, step: u64, time: f64, strain: f64, part: usize) {
        self.part.push(part);
        self.step.push(step);
        self.time.push(time);
        self.strain.push(strain);
    }

    /// Writes the groups `Steps` and `FieldData` of a grid whose meshes have these sizes.
    pub(super) fn put<V: Vector>(&self, grid: &Group, sizes: &[Sizes]) -> hdf5::Result<()> {
        let count = self.time.len();
        let put_offsets = |group: &Group, name: &str, offsets: Vec<usize>, shape: &[usize]| {
            let offsets: Vec<i64> = offsets.into_iter().map(|offset| offset as i64).collect();
            put(group, name, "1", shape, &offsets, Packing::Deflated)
        };
        // Where the mesh of each step begins among all of them, and its stretch of an array that holds one a step.
        let of_mesh = |of: fn(&Sizes) -> usize| -> Vec<usize> {
            self.part.iter().map(|&part| of(&Sizes::sum(&sizes[..part]))).collect()
        };
        let of_step = |of: fn(&Sizes) -> usize| -> Vec<usize> {
            let lengths = self.part.iter().map(|&part| of(&sizes[part]));
            let ends = lengths.scan(0, |end, length| Some(std::mem::replace(end, *end + length)));
            ends.collect()
        };
        let fields = new_group(grid, "FieldData")?;
        put(&fields, "step", "1", &[count], &self.step, Packing::Deflated)?;
        put(&fields, "strain", "1", &[count], &self.strain, Packing::Deflated)?;

        let steps = new_group(grid, "Steps")?;
        steps
            .new_attr::<i64>()
            .create("NSteps")?
            .write_scalar(&(count as i64))?;
        put(&steps, "Values", "ps", &[count], &self.time, Packing::Deflated)?;
        put(
            &steps,
            "NumberOfParts",
            "1",
            &[count],
            &vec![1_i64; count],
            Packing::Deflated,
        )?;
        let (points, cells) = (|sizes: &Sizes| sizes.points, |sizes: &Sizes| sizes.cells);
        put_offsets(&steps, "PartOffsets", self.part.clone(), &[count])?;
        put_offsets(&steps, "PointOffsets", of_mesh(points), &[count])?;
        put_offsets(&steps, "CellOffsets", of_mesh(cells), &[count, 1])?;
        let connectivity = of_mesh(|sizes| sizes.connectivity);
        put_offsets(&steps, "ConnectivityIdOffsets", connectivity, &[count, 1])?;

        let group = new_group(&steps, "PointDataOffsets")?;
        for field in point_fields::<V>() {
            put_offsets(&group, field.name, of_step(points), &[count])?;
        }
        let group = new_group(&steps, "CellDataOffsets")?;
        put_offsets(&group, "element_size", of_mesh(cells), &[count])?;
        for field in cell_fields::<V>() {
            put_offsets(&group, field.name, of_step(cells), &[count])?;
        }
        let group = new_group(&steps, "FieldDataOffsets")?;
        put_offsets(&group, "step", (0..count).collect(), &[count])?;
        put_offsets(&group, "strain", (0..count).collect(), &[count])
    }
}
