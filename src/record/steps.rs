//! The time steps of a transient grid: their times, and where in each array they begin.

use hdf5::Group;

use super::arrays::{Packing, new_group, put};
use super::field::{cell_fields, point_fields};
use super::frames::Vector;

/// What the file says of every step.
#[derive(Default)]
pub(super) struct Steps {
    time: Vec<f64>,
    step: Vec<u64>,
    strain: Vec<f64>,
}

impl Steps {
    pub(super) fn push(&mut self, step: u64, time: f64, strain: f64) {
        self.step.push(step);
        self.time.push(time);
        self.strain.push(strain);
    }

    /// Writes the groups `Steps` and `FieldData` of a grid with so many points and cells.
    pub(super) fn put<V: Vector>(&self, grid: &Group, points: usize, cells: usize) -> hdf5::Result<()> {
        let count = self.time.len();
        // Where a step's stretch begins in an array that holds `rows` rows a step; 0 rows: the same for all.
        let put_offsets = |group: &Group, name: &str, rows: usize, shape: &[usize]| {
            let offsets: Vec<i64> = (0..count).map(|step| (step * rows) as i64).collect();
            put(group, name, "1", shape, &offsets, Packing::Deflated)
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
        put_offsets(&steps, "PartOffsets", 0, &[count])?;
        put_offsets(&steps, "PointOffsets", 0, &[count])?;
        put_offsets(&steps, "CellOffsets", 0, &[count, 1])?;
        put_offsets(&steps, "ConnectivityIdOffsets", 0, &[count, 1])?;

        let group = new_group(&steps, "PointDataOffsets")?;
        for field in point_fields::<V>() {
            put_offsets(&group, field.name, points, &[count])?;
        }
        let group = new_group(&steps, "CellDataOffsets")?;
        put_offsets(&group, "element_size", 0, &[count])?;
        for field in cell_fields::<V>() {
            put_offsets(&group, field.name, cells, &[count])?;
        }
        let group = new_group(&steps, "FieldDataOffsets")?;
        put_offsets(&group, "step", 1, &[count])?;
        put_offsets(&group, "strain", 1, &[count])
    }
}
