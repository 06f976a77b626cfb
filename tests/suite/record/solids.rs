//! Series, pictures and checkpoints of solids.

use cgaft::analysis::columns::{Columns, SolidSetting};
use cgaft::record::frames::{FieldMesh, Frame};
use cgaft::record::{
    FIELDS_FILE, SERIES_FILE, checkpoint, cut_back, publish_fields, publish_series, read_fields, read_segments,
    read_series, write_frame, write_segment,
};
use cgaft::solver::checkpoint::Checkpoint;
use cgaft::solver::solid::Kept;
use serde_json::json;
use tempfile::tempdir;

use super::number;
use super::others::{ask_python, attributes, single};

/// Of a tetrahedron, a pyramid and an atom.
const VTK_TYPES: [u64; 3] = [10, 14, 1];

fn columns(rows: std::ops::Range<u64>) -> Columns {
    let names = [("time", "ps"), ("sigma_zz", "eV/nm^3"), ("ball_force_z", "eV/nm")];
    let mut columns = Columns::named(names.map(|(name, unit)| (name.to_owned(), unit)));
    for row in rows {
        columns.push(10 * row, &[number(row), number(row + 7), f64::NAN]);
    }
    columns
}

fn setting() -> SolidSetting {
    SolidSetting {
        spacing: number(1),
        volume: number(2),
        length: number(3),
        along: [0.0, number(4), 1.0],
        strain_rate: f64::NAN,
        nodes: 14,
        elements: 3,
        represented_atoms: u64::MAX,
    }
}

#[test]
fn segments_of_columns_come_together_and_are_cut_back_and_published_to_the_bit() {
    let dir = tempdir().unwrap();
    for (first, last) in [(0, 4), (4, 9)] {
        write_segment(dir.path(), first, &columns(first..last)).unwrap();
    }
    let same = |left: &Columns, right: &Columns| assert_eq!(format!("{left:?}"), format!("{right:?}"));
    same(&read_segments(dir.path()).unwrap(), &columns(0..9));
    cut_back::<Columns>(dir.path(), Some(65)).unwrap();
    same(&read_segments(dir.path()).unwrap(), &columns(0..7));
    publish_series(dir.path(), "1f", &setting()).unwrap();
    let (read_setting, read) = read_series::<SolidSetting>(&dir.path().join(SERIES_FILE)).unwrap();
    same(&read, &columns(0..7));
    assert_eq!(format!("{read_setting:?}"), format!("{:?}", setting()));
    cut_back::<Columns>(dir.path(), Some(60)).unwrap();
    assert!(
        cut_back::<Columns>(dir.path(), Some(50)).is_err(),
        "it was published up to step 60"
    );
}

#[test]
fn a_checkpoint_of_a_solid_reads_back_to_the_bit() {
    let dir = tempdir().unwrap();
    let path = dir.path().join("checkpoint.h5");
    let plane = |from: u64| (from..from + 50).map(number).collect::<Vec<f64>>();
    let written: Checkpoint<Kept, 3> = Checkpoint {
        step: 7,
        time: number(1),
        time_step: number(2),
        step_after_next: number(4),
        longest_step: 0.0375,
        stability_limit: number(3),
        position: [plane(10), plane(20), plane(30)],
        velocity: [plane(40), plane(50), plane(60)],
        open_interfaces: vec![3, u32::MAX],
        closest_approach: number(9),
        start: [number(4), number(5), number(6)],
        peak_work: number(7),
        peak_imbalance: number(8),
        refined_energy: 0.0,
        looks: 0,
        probes: 3,
        snapshots: 1,
        kept: Kept {
            works: plane(70),
            last_strain: number(9),
        },
    };
    checkpoint::write(&path, "abc", &written).unwrap();
    assert_eq!(checkpoint::read::<Kept, 3>(&path, "abc").unwrap(), written);
}

/// A tetrahedron, a pyramid and an atom.
fn mesh() -> FieldMesh<[f64; 3]> {
    FieldMesh {
        points: (0..10)
            .map(|node| [number(node), number(node + 1), number(node + 2)])
            .collect(),
        connectivity: (0..10).collect(),
        offsets: vec![0, 4, 9, 10],
        element_size: vec![6, 6, 1],
    }
}

fn frame(step: u64) -> Frame<[f64; 3]> {
    let vector = |from: u64| [number(from), number(from + step), number(from * step)];
    Frame {
        step,
        time: 0.5 * step as f64,
        strain: number(step),
        displacement: (0..10).map(vector).collect(),
        velocity: (10..20).map(vector).collect(),
        stress: (0..3)
            .map(|cell| [0, 1, 2, 3, 4, 5].map(|part| number(10 * cell + part + step)))
            .collect(),
        damage: vec![0.0, 0.5, 1.0],
        mesh: None,
    }
}

#[test]
fn vtk_reads_tetrahedra_pyramids_and_atoms_with_their_vectors_and_tensors() {
    let dir = tempdir().unwrap();
    for step in [0, 40] {
        write_frame(dir.path(), &frame(step)).unwrap();
    }
    publish_fields(dir.path(), "1f", &mesh()).unwrap();
    let path = dir.path().join(FIELDS_FILE);
    let seen = ask_python("read_fields.py", &path);
    assert_eq!(seen["attributes"], attributes());
    for (index, step) in [0, 40].into_iter().enumerate() {
        let (written, seen) = (frame(step), &seen["steps"][index]);
        assert_eq!(seen["cell_types"], json!(VTK_TYPES));
        assert_eq!(seen["points"], json!(mesh().points));
        let vectors = |rows: &[[f64; 3]], scale: f64| {
            let rows = rows.iter().map(|row| row.map(|component| single(component * scale)));
            json!(rows.collect::<Vec<_>>())
        };
        assert_eq!(seen["point_data"]["displacement"], vectors(&written.displacement, 1.0));
        assert_eq!(seen["point_data"]["velocity"], vectors(&written.velocity, 1000.0));
        // VTK has xx, yy, zz, xy, yz, xz.
        let tensor = |[xx, yy, zz, yz, xz, xy]: [f64; 6]| {
            [xx, yy, zz, xy, yz, xz].map(|component| single(component * 0.1602176634))
        };
        let tensors: Vec<[f64; 6]> = written.stress.iter().map(|&stress| tensor(stress)).collect();
        assert_eq!(seen["cell_data"]["virial_stress"], json!(tensors));
    }
    let (read_mesh, frames) = read_fields::<[f64; 3]>(&path).unwrap();
    assert_eq!(read_mesh, mesh());
    let read = frames.frame(1).unwrap();
    for (read, written) in read.stress.iter().zip(frame(40).stress) {
        let is_near = |part: usize| (read[part] / written[part] - 1.0).abs() < SINGLE;
        assert!((0..6).all(is_near), "{read:?} {written:?}");
    }
}

/// What single precision leaves of a number.
const SINGLE: f64 = 1e-6;
