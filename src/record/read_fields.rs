//! The published pictures, read back one by one.

use std::marker::PhantomData;
use std::ops::Range;
use std::path::{Path, PathBuf};

use hdf5::Group;
use ndarray::s;

use super::arrays::{get, get_column};
use super::field::from_vtk;
use super::frames::{FieldMesh, Frame, Vector};
use super::mesh::{Sizes, get_mesh, get_sizes};
use super::{RecordError, file};
use crate::units::{EV_PER_NM3_IN_GPA, NM_PER_PS_IN_M_PER_S};

/// The mesh of the first frame of a published file, and its frames. Meshes are read to the bit, frames to single precision.
pub fn read_fields<V: Vector>(path: &Path) -> Result<(FieldMesh<V>, FrameReader<V>), RecordError> {
    std::fs::metadata(path).map_err(|cause| RecordError::reading(path, &cause))?;
    let read = || {
        let grid = file::open(path)?.group("VTKHDF")?;
        let sizes = get_sizes(&grid)?;
        let mesh = get_mesh(&grid, &sizes, 0)?;
        Ok((mesh, FrameReader::new(path, grid, sizes)?))
    };
    read().map_err(|cause: hdf5::Error| RecordError::damaged(path, cause))
}

/// Frames by index, each read when it is asked for.
pub struct FrameReader<V = [f64; 2]> {
    path: PathBuf,
    grid: Group,
    sizes: Vec<Sizes>,
    /// The number of the mesh of each frame.
    parts: Vec<usize>,
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

    fn new(path: &Path, grid: Group, sizes: Vec<Sizes>) -> hdf5::Result<Self> {
        let times: Vec<f64> = get(&grid, "Steps/Values")?;
        let parts: Vec<i64> = get_column(&grid, "Steps/PartOffsets", times.len())?;
        let parts: Vec<usize> = parts.into_iter().map(|part| part as usize).collect();
        if parts.iter().any(|&part| part >= sizes.len()) {
            return Err("a step has a mesh that is not there".into());
        }
        Ok(Self {
            path: path.to_owned(),
            sizes,
            parts,
            steps: get_column(&grid, "FieldData/step", times.len())?,
            strains: get_column(&grid, "FieldData/strain", times.len())?,
            times,
            grid,
            space: PhantomData,
        })
    }

    fn get_frame(&self, index: usize) -> hdf5::Result<Frame<V>> {
        let part = self.parts[index];
        let before: Vec<Sizes> = self.parts[..index].iter().map(|&part| self.sizes[part]).collect();
        let (before, own) = (Sizes::sum(&before), self.sizes[part]);
        let points = before.points..before.points + own.points;
        let cells = before.cells..before.cells + own.cells;
        let changes = self.sizes.len() > 1;
        let mesh = changes.then(|| get_mesh(&self.grid, &self.sizes, part)).transpose()?;
        let scaled = |rows: Vec<[f64; 3]>, scale: f64| rows.iter().map(|row| V::of(&row.map(|x| x / scale))).collect();
        let stress: Vec<[f64; 6]> = self.slice("CellData/virial_stress", cells.clone())?;
        let damage = self.grid.dataset("CellData/damage")?.read_slice_1d::<f32, _>(cells)?;
        Ok(Frame {
            step: self.steps[index],
            time: self.times[index],
            strain: self.strains[index],
            displacement: scaled(self.slice("PointData/displacement", points.clone())?, 1.0),
            velocity: scaled(self.slice("PointData/velocity", points)?, NM_PER_PS_IN_M_PER_S),
            stress: stress
                .iter()
                .map(|tensor| from_vtk(tensor.map(|component| component / EV_PER_NM3_IN_GPA)))
                .collect(),
            damage: damage.iter().map(|damage| f64::from(*damage)).collect(),
            mesh,
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
