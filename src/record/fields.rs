//! The published pictures: a transient unstructured grid in VTKHDF 2.0, which ParaView opens as it is.
//!
//! The mesh stands in the file once; every step refers to it with offsets of 0, and to its own stretch of each
//! field. Fields are in single precision (7 digits), which halves the file; points are in double precision.

use std::path::Path;

use hdf5::types::FixedAscii;
use hdf5::{Dataset, Group};
use ndarray::{ArrayView1, ArrayView2, s};

use super::arrays::{DEFLATE, Packing, chunk, name_unit, new_group, put};
use super::frames::{FieldMesh, Frame};
use super::pieces::FramePiece;
use super::segments::read_frame;
use super::{RecordError, file};

/// 1 eV/nm^3 in GPa (exact: the elementary charge in 1e-19 C, divided by ten).
pub(super) const EV_PER_NM3_IN_GPA: f64 = 0.160_217_663_4;
/// 1 nm/ps in m/s.
pub(super) const NM_PER_PS_IN_M_PER_S: f64 = 1000.0;

/// A field as ParaView shows it.
struct Field {
    name: &'static str,
    unit: &'static str,
    /// Numbers a node or cell: 3 a vector, 6 a symmetric tensor xx, yy, zz, xy, yz, xz.
    width: usize,
    of: fn(&Frame) -> Vec<f32>,
}

const POINT_FIELDS: [Field; 2] = [
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

const CELL_FIELDS: [Field; 3] = [
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

/// Writes mesh and frames into a new file at `path`; holds one frame at a time.
pub(super) fn assemble(path: &Path, mesh: &FieldMesh, frames: &[FramePiece]) -> Result<(), RecordError> {
    let cannot_write = |cause: hdf5::Error| RecordError::cannot_write(path, cause);
    let types = cell_types(mesh).map_err(|what| RecordError::gap(path, what))?;
    let file = file::create(path, 0).map_err(cannot_write)?;
    let grid = new_group(&file, "VTKHDF").map_err(cannot_write)?;
    put_mesh(&grid, mesh, &types).map_err(cannot_write)?;

    let fields = Fields::create(&grid, mesh, frames.len()).map_err(cannot_write)?;
    let mut steps = Steps::default();
    for (index, piece) in frames.iter().enumerate() {
        let frame = read_frame(&piece.path)?;
        if frame.displacement.len() != mesh.points.len() || frame.stress.len() != types.len() {
            return Err(RecordError::gap(
                &piece.path,
                "the frame has other nodes or cells than the mesh",
            ));
        }
        fields.write(index, &frame).map_err(cannot_write)?;
        steps.push(&frame);
    }
    steps.put(&grid, mesh.points.len(), types.len()).map_err(cannot_write)?;
    file.close().map_err(cannot_write)
}

fn put_mesh(grid: &Group, mesh: &FieldMesh, types: &[u8]) -> hdf5::Result<()> {
    grid.new_attr_builder().with_data(&[2_i64, 0]).create("Version")?;
    let kind = FixedAscii::<16>::from_ascii("UnstructuredGrid").map_err(|cause| cause.to_string())?;
    grid.new_attr::<FixedAscii<16>>().create("Type")?.write_scalar(&kind)?;

    let points: Vec<f64> = mesh.points.iter().flat_map(|[x, y]| [*x, *y, 0.0]).collect();
    let connectivity: Vec<i64> = mesh.connectivity.iter().map(|node| i64::from(*node)).collect();
    let offsets: Vec<i64> = mesh.offsets.iter().map(|offset| i64::from(*offset)).collect();
    for (name, count) in [
        ("NumberOfPoints", mesh.points.len()),
        ("NumberOfCells", types.len()),
        ("NumberOfConnectivityIds", connectivity.len()),
    ] {
        put(grid, name, "1", &[1], &[count as i64], Packing::Plain)?;
    }
    put(
        grid,
        "Points",
        "nm",
        &[mesh.points.len(), 3],
        &points,
        Packing::Deflated,
    )?;
    put(
        grid,
        "Connectivity",
        "1",
        &[connectivity.len()],
        &connectivity,
        Packing::Deflated,
    )?;
    put(grid, "Offsets", "1", &[offsets.len()], &offsets, Packing::Deflated)?;
    put(grid, "Types", "1", &[types.len()], types, Packing::Deflated)?;

    let cells = new_group(grid, "CellData")?;
    put(
        &cells,
        "element_size",
        "1",
        &[types.len()],
        &mesh.element_size,
        Packing::Deflated,
    )
}

/// VTK's number for each cell, or what is wrong with the mesh.
fn cell_types(mesh: &FieldMesh) -> Result<Vec<u8>, String> {
    const VTK_VERTEX: u8 = 1;
    const VTK_TRIANGLE: u8 = 5;
    if mesh.offsets.len() != mesh.element_size.len() + 1 {
        return Err("the mesh has not one more offset than it has cells".to_owned());
    }
    let cell = |(index, ends): (usize, &[u32])| match ends[1].wrapping_sub(ends[0]) {
        1 => Ok(VTK_VERTEX),
        3 => Ok(VTK_TRIANGLE),
        nodes => Err(format!(
            "cell {index} of the mesh has {nodes} nodes, neither an atom's 1 nor a triangle's 3"
        )),
    };
    mesh.offsets.windows(2).enumerate().map(cell).collect()
}

/// The datasets that hold a field for all steps, one after the other.
struct Fields(Vec<(&'static Field, Dataset)>);

impl Fields {
    fn create(grid: &Group, mesh: &FieldMesh, frames: usize) -> hdf5::Result<Fields> {
        let points = (
            new_group(grid, "PointData")?,
            mesh.points.len(),
            POINT_FIELDS.as_slice(),
        );
        let cells = (grid.group("CellData")?, mesh.element_size.len(), CELL_FIELDS.as_slice());
        let mut datasets = Vec::new();
        for (group, rows, fields) in [points, cells] {
            for field in fields {
                datasets.push((field, field.create(&group, rows * frames)?));
            }
        }
        Ok(Fields(datasets))
    }

    fn write(&self, index: usize, frame: &Frame) -> hdf5::Result<()> {
        for (field, dataset) in &self.0 {
            let numbers = (field.of)(frame);
            let rows = numbers.len() / field.width;
            let place = index * rows..(index + 1) * rows;
            if field.width == 1 {
                dataset.write_slice(ArrayView1::from(&numbers), place)?;
            } else {
                dataset.write_slice(ArrayView2::from_shape((rows, field.width), &numbers)?, s![place, ..])?;
            }
        }
        Ok(())
    }
}

impl Field {
    fn create(&self, group: &Group, rows: usize) -> hdf5::Result<Dataset> {
        let shape = if self.width == 1 {
            vec![rows]
        } else {
            vec![rows, self.width]
        };
        let mut builder = group.new_dataset::<f32>().obj_track_times(false);
        if rows > 0 {
            builder = builder.chunk(chunk(&shape)).shuffle().deflate(DEFLATE);
        }
        let dataset = builder.shape(shape).create(self.name)?;
        name_unit(&dataset, self.unit)?;
        Ok(dataset)
    }
}

/// What the file says of every step.
#[derive(Default)]
struct Steps {
    time: Vec<f64>,
    step: Vec<u64>,
    strain: Vec<f64>,
}

impl Steps {
    fn push(&mut self, frame: &Frame) {
        self.time.push(frame.time);
        self.step.push(frame.step);
        self.strain.push(frame.strain);
    }

    fn put(&self, grid: &Group, points: usize, cells: usize) -> hdf5::Result<()> {
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
        for field in &POINT_FIELDS {
            put_offsets(&group, field.name, points, &[count])?;
        }
        let group = new_group(&steps, "CellDataOffsets")?;
        put_offsets(&group, "element_size", 0, &[count])?;
        for field in &CELL_FIELDS {
            put_offsets(&group, field.name, cells, &[count])?;
        }
        let group = new_group(&steps, "FieldDataOffsets")?;
        put_offsets(&group, "step", 1, &[count])?;
        put_offsets(&group, "strain", 1, &[count])
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
