//! The published pictures, read back one by one.

use std::marker::PhantomData;
use std::ops::Range;
use std::path::{Path, PathBuf};

use hdf5::Group;
use ndarray::s;

use super::arrays::{get, get_column};
use super::field::from_vtk;
use super::frames::{FieldMesh, Frame, Vector};
use super::mesh::get_mesh;
use super::{RecordError, file};
use crate::units::{EV_PER_NM3_IN_GPA, NM_PER_PS_IN_M_PER_S};

/// Mesh and frames of a published file. The mesh is read to the bit, the frames to single precision.
pub fn read_fields<V: Vector>(path: &Path) -> Result<(FieldMesh<V>, FrameReader<V>), RecordError> {
    std::fs::metadata(path).map_err(|cause| RecordError::reading(path, &cause))?;
    let read = || {
        let grid = file::open(path)?.group("VTKHDF")?;
        let mesh = get_mesh(&grid)?;
        let frames = FrameReader::new(path, grid, &mesh)?;
        Ok((mesh, frames))
    };
    read().map_err(|cause: hdf5::Error| RecordError::damaged(path, cause))
}

/// Frames by index, each read when it is asked for.
pub struct FrameReader<V = [f64; 2]> {
    path: PathBuf,
    grid: Group,
    points: usize,
    cells: usize,
    times: Vec<f64>,
    steps: Vec<u64>,
    strains: Vec<f64>,
    space: PhantomData<fn() -> V>,
}

impl<V: Vector> FrameReader<V> {
    /// Times of the frames, ps.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    pub fn steps(&self) -> &[u64] {
        &self.steps
    }

    /// Nominal strains of the frames.
    pub fn strains(&self) -> &[f64] {
        &self.strains
    }

    /// The frame at `index`, counted from 0, in internal units.
    pub fn frame(&self, index: usize) -> Result<Frame<V>, RecordError> {
        if index >= self.times.len() {
            let what = format!("frame {index} was asked for and it has {}", self.times.len());
            return Err(RecordError::damaged(&self.path, what));
        }
        self.get_frame(index)
            .map_err(|cause| RecordError::damaged(&self.path, cause))
    }

    fn new(path: &Path, grid: Group, mesh: &FieldMesh<V>) -> hdf5::Result<Self> {
        let times: Vec<f64> = get(&grid, "Steps/Values")?;
        Ok(Self {
            path: path.to_owned(),
            points: mesh.points.len(),
            cells: mesh.element_size.len(),
            steps: get_column(&grid, "FieldData/step", times.len())?,
            strains: get_column(&grid, "FieldData/strain", times.len())?,
            times,
            grid,
            space: PhantomData,
        })
    }

    fn get_frame(&self, index: usize) -> hdf5::Result<Frame<V>> {
        let stretch = |rows: usize| index * rows..(index + 1) * rows;
        let scaled = |rows: Vec<[f64; 3]>, scale: f64| rows.iter().map(|row| V::of(&row.map(|x| x / scale))).collect();
        let stress: Vec<[f64; 6]> = self.slice("CellData/virial_stress", stretch(self.cells))?;
        let damage = self
            .grid
            .dataset("CellData/damage")?
            .read_slice_1d::<f32, _>(stretch(self.cells))?;
        Ok(Frame {
            step: self.steps[index],
            time: self.times[index],
            strain: self.strains[index],
            displacement: scaled(self.slice("PointData/displacement", stretch(self.points))?, 1.0),
            velocity: scaled(
                self.slice("PointData/velocity", stretch(self.points))?,
                NM_PER_PS_IN_M_PER_S,
            ),
            stress: stress
                .iter()
                .map(|tensor| from_vtk(tensor.map(|component| component / EV_PER_NM3_IN_GPA)))
                .collect(),
            damage: damage.iter().map(|damage| f64::from(*damage)).collect(),
        })
    }

    /// Some rows of a field.
    fn slice<const WIDTH: usize>(&self, name: &str, rows: Range<usize>) -> hdf5::Result<Vec<[f64; WIDTH]>> {
        let numbers = self.grid.dataset(name)?.read_slice_2d::<f32, _>(s![rows, ..])?;
        if numbers.ncols() != WIDTH {
            return Err(format!("`{name}` has rows of {} numbers instead of {WIDTH}", numbers.ncols()).into());
        }
        let row = |row: ndarray::ArrayView1<f32>| std::array::from_fn(|component| f64::from(row[component]));
        Ok(numbers.rows().into_iter().map(row).collect())
    }
}
