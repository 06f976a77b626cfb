//! The published pictures: a transient unstructured grid in VTKHDF 2.0, which ParaView opens as it is.
//!
//! The mesh stands in the file once; every step refers to it with offsets of 0, and to its own stretch of each
//! field. Fields are in single precision (7 digits), which halves the file; points are in double precision.

use std::path::Path;

use hdf5::Group;

use super::arrays::new_group;
use super::field::{CELL_FIELDS, Field, POINT_FIELDS};
use super::frames::{FieldMesh, Frame};
use super::mesh::{check_mesh, put_mesh};
use super::packed::Packed;
use super::pieces::FramePiece;
use super::provenance::put_provenance;
use super::snapshots::read_frame;
use super::steps::Steps;
use super::{RecordError, file};

/// Writes mesh and frames into a new file at `path`; holds one frame at a time.
pub(super) fn assemble(path: &Path, case_id: &str, mesh: &FieldMesh, frames: &[FramePiece]) -> Result<(), RecordError> {
    let cannot_write = |cause: hdf5::Error| RecordError::cannot_write(path, cause);
    check_mesh(mesh).map_err(|what| RecordError::gap(path, what))?;
    let cells = mesh.element_size.len();
    let file = file::create(path, 0).map_err(cannot_write)?;
    put_provenance(&file, case_id).map_err(cannot_write)?;
    let grid = new_group(&file, "VTKHDF").map_err(cannot_write)?;
    put_mesh(&grid, mesh).map_err(cannot_write)?;

    let mut fields = Fields::create(&grid, mesh, frames.len()).map_err(cannot_write)?;
    let mut steps = Steps::default();
    for piece in frames {
        let frame = read_frame(&piece.path)?;
        let [nodes, velocities] = [frame.displacement.len(), frame.velocity.len()];
        if [nodes, velocities, frame.stress.len()] != [mesh.points.len(), mesh.points.len(), cells] {
            let what = "the frame has other nodes or cells than the mesh";
            return Err(RecordError::gap(&piece.path, what));
        }
        fields.append(&frame).map_err(cannot_write)?;
        steps.push(&frame);
    }
    fields.finish().map_err(cannot_write)?;
    steps.put(&grid, mesh.points.len(), cells).map_err(cannot_write)?;
    file::finish(file).map_err(cannot_write)
}

/// The datasets that hold a field for all steps, one after the other.
struct Fields(Vec<(&'static Field, Packed<f32>)>);

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

    fn append(&mut self, frame: &Frame) -> hdf5::Result<()> {
        let mut fields = self.0.iter_mut();
        fields.try_for_each(|(field, packed)| packed.append(&(field.of)(frame)))
    }

    fn finish(self) -> hdf5::Result<()> {
        self.0.into_iter().try_for_each(|(_, packed)| packed.finish())
    }
}
