//! The published pictures: a transient unstructured grid in VTKHDF 2.0, which ParaView opens as it is.
//!
//! A mesh stands in the file once; every step refers to its mesh, and to its own stretch of each field. A mesh that does
//! not change is the only one. Fields are in single precision (7 digits), which halves the file; points are in double precision.

use std::path::Path;

use hdf5::Group;

use super::arrays::new_group;
use super::field::{Field, cell_fields, point_fields};
use super::frames::{FieldMesh, Vector};
use super::mesh::{BLOCK_ROWS, Parts, Sizes, check_mesh};
use super::packed::Packed;
use super::pieces::FramePiece;
use super::provenance::put_provenance;
use super::snapshots::OpenFrame;
use super::steps::Steps;
use super::{RecordError, file};

/// Writes mesh and frames into a new file at `path`; holds one field at a time. Frames with cells of their own bring them
/// along; those that follow each other share what is the same.
pub(super) fn assemble<V: Vector>(
    path: &Path,
    case_id: &str,
    mesh: &FieldMesh<V>,
    frames: &[FramePiece],
) -> Result<(), RecordError> {
    let cannot_write = |cause: hdf5::Error| RecordError::cannot_write(path, cause);
    let (sizes, parts) = lay_out(path, mesh, frames)?;
    let file = file::create(path, 0).map_err(cannot_write)?;
    put_provenance(&file, case_id).map_err(cannot_write)?;
    let grid = new_group(&file, "VTKHDF").map_err(cannot_write)?;
    let mut meshes = Parts::create(&grid, &sizes).map_err(cannot_write)?;
    let mut fields = Fields::create::<V>(&grid, &sizes, &parts).map_err(cannot_write)?;
    let mut steps = Steps::default();
    let mut written = 0;
    for (piece, part) in frames.iter().zip(parts) {
        let frame = OpenFrame::open(&piece.path)?;
        let Sizes { points, cells, .. } = sizes[part];
        if written == part {
            let own = frame.cells()?;
            meshes.append(own.as_ref().unwrap_or(mesh)).map_err(cannot_write)?;
            written += 1;
        }
        for (field, packed) in &mut fields.0 {
            let rows = if field.on_points { points } else { cells };
            let (name, width) = field.source;
            let numbers = frame.numbers(name, rows * width)?;
            let mut blocks = numbers.chunks(BLOCK_ROWS * width);
            blocks
                .try_for_each(|block| packed.append(&(field.of)(block)))
                .map_err(cannot_write)?;
        }
        let (step, time, strain) = frame.moment()?;
        steps.push(step, time, strain, part);
    }
    meshes.finish().map_err(cannot_write)?;
    fields.finish().map_err(cannot_write)?;
    steps.put::<V>(&grid, &sizes).map_err(cannot_write)?;
    file::finish(file).map_err(cannot_write)
}

/// The sizes of all meshes in the order of the frames, and the number of that of each frame.
fn lay_out<V: Vector>(
    path: &Path,
    mesh: &FieldMesh<V>,
    frames: &[FramePiece],
) -> Result<(Vec<Sizes>, Vec<usize>), RecordError> {
    let mut sizes = Vec::new();
    let mut last: Option<Option<FieldMesh<V>>> = None;
    let mut parts = Vec::new();
    for piece in frames {
        // Either all frames of a run have cells of their own or none.
        if last != Some(None) {
            let cells = OpenFrame::open(&piece.path)?.cells()?;
            if last.as_ref() != Some(&cells) {
                let mesh = cells.as_ref().unwrap_or(mesh);
                check_mesh(mesh).map_err(|what| RecordError::gap(path, what))?;
                sizes.push(Sizes::of(mesh));
                last = Some(cells);
            }
        }
        parts.push(sizes.len() - 1);
    }
    Ok((sizes, parts))
}

/// The datasets that hold a field for all steps, one after the other.
struct Fields(Vec<(Field, Packed<f32>)>);

impl Fields {
    /// For frames on these of the meshes of such sizes.
    fn create<V: Vector>(grid: &Group, sizes: &[Sizes], parts: &[usize]) -> hdf5::Result<Self> {
        let of_frames: Vec<Sizes> = parts.iter().map(|&part| sizes[part]).collect();
        let all = Sizes::sum(&of_frames);
        let points = new_group(grid, "PointData")?;
        let cells = grid.group("CellData")?;
        let mut datasets = Vec::new();
        for field in point_fields::<V>() {
            let packed = field.create(&points, all.points)?;
            datasets.push((field, packed));
        }
        for field in cell_fields::<V>() {
            let packed = field.create(&cells, all.cells)?;
            datasets.push((field, packed));
        }
        Ok(Fields(datasets))
    }

    fn finish(self) -> hdf5::Result<()> {
        self.0.into_iter().try_for_each(|(_, packed)| packed.finish())
    }
}
