//! The published pictures: a transient unstructured grid in VTKHDF 2.0, which ParaView opens as it is.
//!
//! The mesh stands in the file once; every step refers to it with offsets of 0, and to its own stretch of each
//! field. Fields are in single precision (7 digits), which halves the file; points are in double precision.

use std::path::Path;

use hdf5::Group;

use super::arrays::new_group;
use super::field::{Field, cell_fields, point_fields};
use super::frames::{FieldMesh, Frame, Vector};
use super::mesh::{check_mesh, put_mesh};
use super::packed::Packed;
use super::pieces::FramePiece;
use super::provenance::put_provenance;
use super::snapshots::read_frame;
use super::steps::Steps;
use super::{RecordError, file};

/// Writes mesh and frames into a new file at `path`; holds one frame at a time.
pub(super) fn assemble<V: Vector>(
    path: &Path,
    case_id: &str,
    mesh: &FieldMesh<V>,
    frames: &[FramePiece],
) -> Result<(), RecordError> {
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
        let frame: Frame<V> = read_frame(&piece.path)?;
        let [nodes, velocities] = [frame.displacement.len(), frame.velocity.len()];
        if [nodes, velocities, frame.stress.len()] != [mesh.points.len(), mesh.points.len(), cells] {
            let what = "the frame has other nodes or cells than the mesh";
            return Err(RecordError::gap(&piece.path, what));
        }
        fields.append(&frame).map_err(cannot_write)?;
        steps.push(frame.step, frame.time, frame.strain);
    }
    fields.finish().map_err(cannot_write)?;
    steps.put::<V>(&grid, mesh.points.len(), cells).map_err(cannot_write)?;
    file::finish(file).map_err(cannot_write)
}

/// The datasets that hold a field for all steps, one after the other.
struct Fields<V: Vector>(Vec<(Field<V>, Packed<f32>)>);

impl<V: Vector> Fields<V> {
    fn create(grid: &Group, mesh: &FieldMesh<V>, frames: usize) -> hdf5::Result<Self> {
        let points = new_group(grid, "PointData")?;
        let cells = grid.group("CellData")?;
        let mut datasets = Vec::new();
        for field in point_fields() {
            let packed = field.create(&points, mesh.points.len() * frames)?;
            datasets.push((field, packed));
        }
        for field in cell_fields() {
            let packed = field.create(&cells, mesh.element_size.len() * frames)?;
            datasets.push((field, packed));
        }
        Ok(Fields(datasets))
    }

    fn append(&mut self, frame: &Frame<V>) -> hdf5::Result<()> {
        let mut fields = self.0.iter_mut();
        fields.try_for_each(|(field, packed)| packed.append(&(field.of)(frame)))
    }

    fn finish(self) -> hdf5::Result<()> {
        self.0.into_iter().try_for_each(|(_, packed)| packed.finish())
    }
}
