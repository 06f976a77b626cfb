use std::fs;
use std::path::Path;

use cgaft::analysis::series::Series;
use cgaft::analysis::series::{CrackFrom, Setting};
use cgaft::record::{
    FIELDS_FILE, RecordError, SERIES_FILE, cut_back, publish_fields, publish_series, read_fields, read_segments,
    read_series, write_frame, write_segment,
};
use tempfile::tempdir;

use super::{assert_same_series, frame, mesh, number, series, setting};

/// Published fields are in single precision: half a unit in its last place, and one for the change of units.
const SINGLE: f64 = 1.5 * f32::EPSILON as f64;

fn names(dir: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(dir)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// Two segments of 5 probes, steps 0 to 40 and 50 to 90; three frames at steps 0, 40, 80.
fn write_pieces(dir: &Path) {
    write_segment(dir, 0, &series(0..5, 4)).unwrap();
    write_segment(dir, 5, &series(5..10, 4)).unwrap();
    for step in [0, 40, 80] {
        write_frame(dir, &frame(step, &mesh(3))).unwrap();
    }
}

#[test]
fn segments_read_back_as_one_series_to_the_bit() {
    let dir = tempdir().unwrap();
    assert_same_series(&read_segments(dir.path()).unwrap(), &Default::default());
    write_pieces(dir.path());
    assert_same_series(&read_segments(dir.path()).unwrap(), &series(0..10, 4));
}

#[test]
fn a_stretch_without_probes_leaves_no_file() {
    let dir = tempdir().unwrap();
    write_segment(dir.path(), 7, &Series::default()).unwrap();
    assert_eq!(names(dir.path()), Vec::<String>::new());
}

#[test]
fn a_missing_segment_is_a_gap() {
    let dir = tempdir().unwrap();
    write_segment(dir.path(), 0, &series(0..5, 4)).unwrap();
    write_segment(dir.path(), 6, &series(6..9, 4)).unwrap();
    assert!(matches!(
        read_segments::<Series>(dir.path()),
        Err(RecordError::Gap { .. })
    ));
    assert!(matches!(
        publish_series(dir.path(), "1f", &setting(None)),
        Err(RecordError::Gap { .. })
    ));
    assert_eq!(names(dir.path()).len(), 2);
}

#[test]
fn cutting_back_keeps_everything_up_to_the_checkpoint() {
    let dir = tempdir().unwrap();
    write_pieces(dir.path());
    for leftover in ["checkpoint.h5.tmp", "frame-0000000000000120.h5.tmp", "series.h5.tmp"] {
        fs::write(dir.path().join(leftover), "half").unwrap();
    }
    fs::write(dir.path().join("notes.tmp"), "not ours").unwrap();

    cut_back::<Series>(dir.path(), Some(90)).unwrap();
    assert_same_series(&read_segments(dir.path()).unwrap(), &series(0..10, 4));
    cut_back::<Series>(dir.path(), Some(40)).unwrap();
    assert_same_series(&read_segments(dir.path()).unwrap(), &series(0..5, 4));
    let left = [
        "frame-0000000000000000.h5",
        "frame-0000000000000040.h5",
        "notes.tmp",
        "series-0000000000000000-0000000000000040.h5",
    ];
    assert_eq!(names(dir.path()), left);
}

#[test]
fn cutting_back_into_a_segment_keeps_its_first_rows() {
    let dir = tempdir().unwrap();
    write_pieces(dir.path());
    cut_back::<Series>(dir.path(), Some(65)).unwrap();
    assert_same_series(&read_segments(dir.path()).unwrap(), &series(0..7, 4));
    // The run goes on from there and writes the same rows again.
    write_segment(dir.path(), 7, &series(7..12, 4)).unwrap();
    assert_same_series(&read_segments(dir.path()).unwrap(), &series(0..12, 4));
}

#[test]
fn cutting_back_to_nothing_removes_everything_recorded() {
    let dir = tempdir().unwrap();
    write_pieces(dir.path());
    publish_series(dir.path(), "1f", &setting(None)).unwrap();
    fs::write(dir.path().join("case.yaml"), "kept").unwrap();
    cut_back::<Series>(dir.path(), None).unwrap();
    assert_eq!(names(dir.path()), ["case.yaml"]);
}

#[test]
fn a_run_published_past_its_checkpoint_is_not_cut_silently() {
    let dir = tempdir().unwrap();
    write_pieces(dir.path());
    publish_series(dir.path(), "1f", &setting(None)).unwrap();
    cut_back::<Series>(dir.path(), Some(90)).unwrap();
    assert!(matches!(
        cut_back::<Series>(dir.path(), Some(80)),
        Err(RecordError::Gap { .. })
    ));
}

#[test]
fn a_published_series_reads_back_to_the_bit() {
    let [edge, center] = [number(20), number(21)];
    let sides = [CrackFrom::Left, CrackFrom::Right { edge }, CrackFrom::Inside { center }];
    let without = [(None, CrackFrom::Left)].into_iter();
    for (crack_row, crack_from) in without.chain(sides.map(|side| (Some(-3), side))) {
        let written = Setting {
            crack_from,
            ..setting(crack_row)
        };
        let dir = tempdir().unwrap();
        write_pieces(dir.path());
        publish_series(dir.path(), "1f", &written).unwrap();
        let (read_setting, read) = read_series::<Setting>(&dir.path().join(SERIES_FILE)).unwrap();
        assert_eq!(read_setting, written);
        assert_same_series(&read, &series(0..10, 4));
    }
}

#[test]
fn published_fields_read_back_frame_by_frame() {
    let dir = tempdir().unwrap();
    write_pieces(dir.path());
    publish_fields(dir.path(), "1f", &mesh(3)).unwrap();
    let (read_mesh, frames) = read_fields::<[f64; 2]>(&dir.path().join(FIELDS_FILE)).unwrap();
    assert_eq!(read_mesh, mesh(3));
    assert_eq!(frames.steps(), [0, 40, 80]);
    assert_eq!(frames.times(), [0, 40, 80].map(|step| frame(step, &mesh(3)).time));
    for (index, step) in [0, 40, 80].into_iter().enumerate() {
        let (read, written) = (frames.frame(index).unwrap(), frame(step, &mesh(3)));
        assert_eq!(
            (read.step, read.time, read.strain),
            (written.step, written.time, written.strain)
        );
        assert_close(read.displacement.as_flattened(), written.displacement.as_flattened());
        assert_close(read.velocity.as_flattened(), written.velocity.as_flattened());
        assert_close(read.stress.as_flattened(), written.stress.as_flattened());
        assert_close(&read.damage, &written.damage);
    }
    assert!(frames.frame(3).is_err());
}

fn assert_close(left: &[f64], right: &[f64]) {
    assert_eq!(left.len(), right.len());
    for (left, right) in left.iter().zip(right) {
        assert!((left - right).abs() <= SINGLE * right.abs(), "{left} is not {right}");
    }
}

#[test]
fn publishing_leaves_only_the_published_files() {
    let dir = tempdir().unwrap();
    write_pieces(dir.path());
    for _again in 0..2 {
        publish_series(dir.path(), "1f", &setting(None)).unwrap();
        publish_fields(dir.path(), "1f", &mesh(3)).unwrap();
        assert_eq!(names(dir.path()), [FIELDS_FILE, SERIES_FILE]);
    }
}

#[test]
fn publishing_is_repeatable_when_killed_while_removing_pieces() {
    let [whole, killed] = [tempdir().unwrap(), tempdir().unwrap()];
    for dir in [&whole, &killed] {
        write_pieces(dir.path());
    }
    publish_series(whole.path(), "1f", &setting(None)).unwrap();
    publish_fields(whole.path(), "1f", &mesh(3)).unwrap();
    // As a kill leaves it: published files in place, the first pieces gone.
    for name in [SERIES_FILE, FIELDS_FILE] {
        fs::copy(whole.path().join(name), killed.path().join(name)).unwrap();
    }
    fs::remove_file(killed.path().join("frame-0000000000000000.h5")).unwrap();
    fs::remove_file(killed.path().join("series-0000000000000000-0000000000000040.h5")).unwrap();

    cut_back::<Series>(killed.path(), Some(90)).unwrap();
    publish_series(killed.path(), "1f", &setting(None)).unwrap();
    publish_fields(killed.path(), "1f", &mesh(3)).unwrap();
    assert_eq!(names(killed.path()), [FIELDS_FILE, SERIES_FILE]);
    for name in [SERIES_FILE, FIELDS_FILE] {
        assert_eq!(
            fs::read(whole.path().join(name)).unwrap(),
            fs::read(killed.path().join(name)).unwrap()
        );
    }
}

#[test]
fn pieces_newer_than_the_published_file_are_not_thrown_away() {
    let dir = tempdir().unwrap();
    write_pieces(dir.path());
    publish_series(dir.path(), "1f", &setting(None)).unwrap();
    publish_fields(dir.path(), "1f", &mesh(3)).unwrap();
    write_segment(dir.path(), 10, &series(10..12, 4)).unwrap();
    write_frame(dir.path(), &frame(120, &mesh(3))).unwrap();
    assert!(matches!(
        publish_series(dir.path(), "1f", &setting(None)),
        Err(RecordError::Gap { .. })
    ));
    assert!(matches!(
        publish_fields(dir.path(), "1f", &mesh(3)),
        Err(RecordError::Gap { .. })
    ));
    assert_eq!(names(dir.path()).len(), 4);
}

#[test]
fn a_run_without_frames_publishes_no_pictures() {
    let dir = tempdir().unwrap();
    publish_fields(dir.path(), "1f", &mesh(3)).unwrap();
    assert!(matches!(
        read_fields::<[f64; 2]>(&dir.path().join(FIELDS_FILE)),
        Err(RecordError::Absent { .. })
    ));
}

#[test]
fn a_frame_of_another_mesh_is_refused_and_nothing_is_lost() {
    let dir = tempdir().unwrap();
    write_pieces(dir.path());
    assert!(matches!(
        publish_fields(dir.path(), "1f", &mesh(4)),
        Err(RecordError::Gap { .. })
    ));
    assert_eq!(names(dir.path()).len(), 5);
}

#[test]
fn a_damaged_piece_is_refused_and_nothing_is_lost() {
    let dir = tempdir().unwrap();
    write_pieces(dir.path());
    for name in names(dir.path()) {
        let path = dir.path().join(name);
        let whole = fs::read(&path).unwrap();
        fs::write(&path, &whole[..whole.len() - 1]).unwrap();
    }
    assert!(matches!(
        publish_series(dir.path(), "1f", &setting(None)),
        Err(RecordError::Damaged { .. })
    ));
    assert!(matches!(
        publish_fields(dir.path(), "1f", &mesh(3)),
        Err(RecordError::Damaged { .. })
    ));
    assert_eq!(names(dir.path()).len(), 5);
}

#[test]
fn damaged_pictures_are_an_error() {
    let dir = tempdir().unwrap();
    let path = dir.path().join(FIELDS_FILE);
    fs::write(&path, "not HDF5").unwrap();
    assert!(matches!(
        read_fields::<[f64; 2]>(&path),
        Err(RecordError::Damaged { .. })
    ));
}

#[test]
fn equal_runs_publish_equal_bytes() {
    // Enough rows for several chunks, and the clock has moved between the two.
    let publish = || {
        let dir = tempdir().unwrap();
        let mesh = mesh(3000);
        write_segment(dir.path(), 0, &series(0..100, 200)).unwrap();
        for step in [0, 10, 20, 30] {
            write_frame(dir.path(), &frame(step, &mesh)).unwrap();
        }
        publish_series(dir.path(), "1f", &setting(Some(9))).unwrap();
        publish_fields(dir.path(), "1f", &mesh).unwrap();
        [SERIES_FILE, FIELDS_FILE].map(|name| fs::read(dir.path().join(name)).unwrap())
    };
    let first = publish();
    std::thread::sleep(std::time::Duration::from_millis(1100));
    assert!(first == publish(), "the bytes differ");
}
