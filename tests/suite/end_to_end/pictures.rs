//! The pictures of a run for ParaView and the report.

use cgaft::record::{FIELDS_FILE, read_fields};

use super::Workspace;

/// Single precision of a place some 20 nm from the left edge.
const ROUNDING: f64 = 1e-5;

#[test]
fn nothing_has_moved_in_the_first_picture_and_what_moves_then_goes_with_the_grips() {
    let place = Workspace::new();
    place.cgaft("run", &[]).succeeded();
    for case in ["coarse", "mixed", "atoms"] {
        let (mesh, frames) = read_fields::<[f64; 2]>(&place.case(case).join(FIELDS_FILE)).unwrap();
        let first = frames.frame(0).unwrap();
        let still = first.displacement.iter().flatten().all(|moved| moved.abs() < ROUNDING);
        assert!(still, "{case}: it has moved at the start");
        let early = frames.frame(1).unwrap();
        let top = mesh.points.iter().fold(0.0, |top: f64, point| top.max(point[1]));
        for (point, moved) in mesh.points.iter().zip(&early.displacement) {
            // The lower half goes down, the upper one up, none farther than a grip.
            let farthest = early.strain * top + 0.5 * early.strain * top;
            assert!(moved[1].abs() < farthest, "{case}: {moved:?} at {point:?}");
            let is_at_grip = point[1].abs() > 0.9 * top;
            assert!(
                !is_at_grip || moved[1] * point[1] > 0.0,
                "{case}: {moved:?} at {point:?}"
            );
        }
        // Every cell is as wide as its atoms, where nothing has parted yet.
        for (cell, ends) in mesh.offsets.windows(2).enumerate() {
            let nodes = &mesh.connectivity[ends[0] as usize..ends[1] as usize];
            let size = f64::from(mesh.element_size[cell]);
            for pair in nodes.windows(2) {
                let [a, b] = [pair[0] as usize, pair[1] as usize];
                let edge = [0, 1].map(|axis| {
                    mesh.points[a][axis] + early.displacement[a][axis]
                        - mesh.points[b][axis]
                        - early.displacement[b][axis]
                });
                let spacings = edge[0].hypot(edge[1]) / 0.2556;
                assert!(
                    (spacings / (size - 1.0) - 1.0).abs() < 0.1,
                    "{case}, cell {cell}: {spacings}"
                );
            }
        }
    }
}
