//! Programs of others read the published files: VTK, on which ParaView is built, and h5py.

use std::path::{Path, PathBuf};
use std::process::Command;

use cgaft::record::{
    FIELDS_FILE, SERIES_FILE, publish_fields, publish_series, read_fields, write_frame, write_segment,
};
use serde_json::{Value, json};
use tempfile::tempdir;

use super::{frame, mesh, series, setting};

const VTK_VERTEX: u64 = 1;
const VTK_TRIANGLE: u64 = 5;

/// What a script of `tests/python` prints about a file.
pub fn ask_python(script: &str, file: &Path) -> Value {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let python =
        std::env::var_os("CGAFT_TEST_PYTHON").map_or_else(|| root.join("target/python/bin/python"), PathBuf::from);
    assert!(
        python.exists(),
        "{} with the packages h5py and vtk is needed to check that others can read our files; type `make test-setup`",
        python.display()
    );
    let output = Command::new(&python)
        .arg(root.join("tests/python").join(script))
        .arg(file)
        .output()
        .unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success(),
        "{script} failed; if a package is missing, type `make test-setup`\n{errors}"
    );
    serde_json::from_slice(&output.stdout).unwrap()
}

/// What a published file says of itself.
pub fn attributes() -> Value {
    json!({
        "case": "1f",
        "program": concat!("cgaft ", env!("CARGO_PKG_VERSION")),
        "units": "in the attribute `units` of each dataset",
    })
}

#[test]
fn vtk_reads_every_time_step_of_the_fields() {
    let dir = tempdir().unwrap();
    let mesh = mesh(5);
    for step in [0, 40, 80] {
        write_frame(dir.path(), &frame(step, &mesh)).unwrap();
    }
    publish_fields(dir.path(), "1f", &mesh).unwrap();
    let path = dir.path().join(FIELDS_FILE);
    let seen = ask_python("read_fields.py", &path);
    let (_, frames) = read_fields::<[f64; 2]>(&path).unwrap();

    assert_eq!(seen["attributes"], attributes());
    assert_eq!(seen["times"], json!(frames.times()));
    let points: Vec<_> = mesh.points.iter().map(|[x, y]| [*x, *y, 0.0]).collect();
    let cells: Vec<_> = mesh
        .offsets
        .windows(2)
        .map(|end| &mesh.connectivity[end[0] as usize..end[1] as usize])
        .collect();
    let types: Vec<_> = cells
        .iter()
        .map(|cell| if cell.len() == 1 { VTK_VERTEX } else { VTK_TRIANGLE })
        .collect();
    for (index, step) in [0, 40, 80].into_iter().enumerate() {
        let written = frame(step, &mesh);
        let seen = &seen["steps"][index];
        assert_eq!(seen["class"], "vtkUnstructuredGrid");
        assert_eq!(seen["points"], json!(points));
        assert_eq!(seen["cells"], json!(cells));
        assert_eq!(seen["cell_types"], json!(types));
        assert_eq!(seen["field_data"]["step"], json!([step]));
        assert_eq!(seen["field_data"]["strain"], json!([written.strain]));

        let vectors = |rows: &[[f64; 2]], scale: f64| {
            rows.iter()
                .map(|[x, y]| [single(x * scale), single(y * scale), 0.0])
                .collect::<Vec<_>>()
        };
        assert_eq!(
            seen["point_data"]["displacement"],
            json!(vectors(&written.displacement, 1.0))
        );
        assert_eq!(
            seen["point_data"]["velocity"],
            json!(vectors(&written.velocity, 1000.0))
        );

        let giga_pascal = |stress: f64| single(stress * 0.1602176634);
        let tensor = |[xx, yy, xy]: &[f64; 3]| [*xx, *yy, 0.0, *xy, 0.0, 0.0].map(giga_pascal);
        let sigma_yy: Vec<_> = written.stress.iter().map(|stress| giga_pascal(stress[1])).collect();
        assert_eq!(
            seen["cell_data"]["virial_stress"],
            json!(written.stress.iter().map(tensor).collect::<Vec<_>>())
        );
        assert_eq!(seen["cell_data"]["sigma_yy"], json!(sigma_yy));
        let damage: Vec<_> = written.damage.iter().map(|damage| single(*damage)).collect();
        assert_eq!(seen["cell_data"]["damage"], json!(damage));
        assert_eq!(seen["cell_data"]["element_size"], json!(mesh.element_size));
    }
}

/// A number as the file holds it.
pub fn single(number: f64) -> f64 {
    f64::from(number as f32)
}

#[test]
fn vtk_reads_a_file_with_many_chunks() {
    let dir = tempdir().unwrap();
    // Frames that begin within a chunk.
    let mesh = mesh(2500);
    for step in [0, 40, 80] {
        write_frame(dir.path(), &frame(step, &mesh)).unwrap();
    }
    publish_fields(dir.path(), "1f", &mesh).unwrap();
    let seen = ask_python("read_fields.py", &dir.path().join(FIELDS_FILE));
    for (index, step) in [0, 40, 80].into_iter().enumerate() {
        let written: Vec<_> = frame(step, &mesh)
            .displacement
            .iter()
            .map(|[x, y]| [single(*x), single(*y), 0.0])
            .collect();
        assert!(
            seen["steps"][index]["point_data"]["displacement"] == json!(written),
            "step {step} differs"
        );
    }
}

#[test]
fn h5py_reads_the_series_with_units() {
    let dir = tempdir().unwrap();
    let written = series(0..7, 4);
    write_segment(dir.path(), 0, &written).unwrap();
    publish_series(dir.path(), "1f", &setting(Some(-3))).unwrap();
    let seen = ask_python("read_series.py", &dir.path().join(SERIES_FILE));

    let sigma_yy: Vec<_> = written.probes.iter().map(|probe| probe.sigma_yy).collect();
    assert_eq!(seen["probes/sigma_yy"], json!({"units": "eV/nm^3", "values": sigma_yy}));
    let time: Vec<_> = written.probes.iter().map(|probe| probe.time).collect();
    assert_eq!(seen["probes/time"], json!({"units": "ps", "values": time}));
    assert_eq!(seen["probes/step"]["values"], json!([0, 10, 20, 30, 40, 50, 60]));
    assert_eq!(
        seen["probes/temperature"],
        json!({"units": "K", "values": [null, null, null, null, null, null, null]})
    );
    assert_eq!(seen["profiles/x"], json!({"units": "nm", "values": written.profile_x}));
    let profiles: Vec<_> = written.profiles.chunks(4).collect();
    assert_eq!(seen["profiles/stress"], json!({"units": "eV/nm^3", "values": profiles}));
    assert_eq!(seen["bonds/probe"]["values"], json!([0, 3, 6]));
    assert_eq!(seen["bonds/column"]["values"], json!([0, -3, -6]));
    assert_eq!(seen["bonds/broken"]["values"], json!([true, false, true]));
    assert_eq!(seen["/"], attributes());
    assert_eq!(seen["setting/crack_row"], json!({"units": "1", "values": -3}));
    // A crack from the left is told by nothing, as in runs of versions that knew no other.
    for of_others in ["setting/crack_from_right_edge", "setting/crack_center"] {
        assert!(seen.get(of_others).is_none(), "{of_others}");
    }
    assert_eq!(
        seen["setting/spacing"],
        json!({"units": "nm", "values": setting(None).spacing})
    );
}
