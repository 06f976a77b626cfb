//! Pictures of a mesh that changes: each with its own cells.

use cgaft::record::frames::{FieldMesh, Frame};
use cgaft::record::{FIELDS_FILE, publish_fields, read_fields, write_frame};
use serde_json::json;
use tempfile::tempdir;

use super::others::{ask_python, single};
use super::{frame, mesh};

/// Steps and how many triangles their meshes have; the second has the mesh of the first.
const PICTURES: [(u64, u32); 4] = [(0, 5), (40, 5), (80, 7), (120, 3)];

fn picture((step, triangles): (u64, u32)) -> Frame {
    let mesh = mesh(triangles);
    Frame {
        mesh: Some(mesh.clone()),
        ..frame(step, &mesh)
    }
}

#[test]
fn vtk_and_the_report_see_every_picture_on_its_own_cells() {
    let dir = tempdir().unwrap();
    for number in PICTURES {
        write_frame(dir.path(), &picture(number)).unwrap();
    }
    // Of no use where every picture has its own.
    publish_fields(dir.path(), "1f", &FieldMesh::<[f64; 2]>::default()).unwrap();
    let path = dir.path().join(FIELDS_FILE);
    let seen = ask_python("read_fields.py", &path);
    let (first, frames) = read_fields::<[f64; 2]>(&path).unwrap();
    assert_eq!(first, mesh(5));
    for (index, number) in PICTURES.into_iter().enumerate() {
        let mesh = mesh(number.1);
        let written = frame(number.0, &mesh);
        let seen = &seen["steps"][index];
        let points: Vec<_> = mesh.points.iter().map(|[x, y]| [*x, *y, 0.0]).collect();
        let ends = mesh.offsets.windows(2);
        let cells: Vec<_> = ends
            .map(|end| &mesh.connectivity[end[0] as usize..end[1] as usize])
            .collect();
        assert_eq!(seen["points"], json!(points), "{number:?}");
        assert_eq!(seen["cells"], json!(cells), "{number:?}");
        assert_eq!(
            seen["cell_data"]["element_size"],
            json!(mesh.element_size),
            "{number:?}"
        );
        let damage: Vec<_> = written.damage.iter().map(|damage| single(*damage)).collect();
        assert_eq!(seen["cell_data"]["damage"], json!(damage), "{number:?}");
        let moved = written.displacement.iter().map(|[x, y]| [single(*x), single(*y), 0.0]);
        let moved: Vec<_> = moved.collect();
        assert_eq!(seen["point_data"]["displacement"], json!(moved), "{number:?}");
        let read = frames.frame(index).unwrap();
        assert_eq!(read.mesh, Some(mesh), "{number:?}");
        assert_eq!(
            [read.displacement.len(), read.stress.len()],
            [written.displacement.len(), written.stress.len()]
        );
        assert_eq!(
            read.damage.last().map(|last| *last as f32),
            written.damage.last().map(|last| *last as f32)
        );
    }
}
