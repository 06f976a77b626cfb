use std::fs;
use std::path::Path;

use cgaft::record::{RecordError, checkpoint};
use cgaft::solver::checkpoint::Checkpoint;
use tempfile::tempdir;

use super::checkpoint as some_checkpoint;

/// A cut or a flipped bit is tried this often, bytes; the header alone holds eight such places.
const STRIDE: usize = 64;

fn read(path: &Path, case_id: &str) -> Result<Checkpoint, RecordError> {
    checkpoint::read(path, case_id)
}

#[test]
fn a_checkpoint_reads_back_to_the_bit() {
    let dir = tempdir().unwrap();
    let path = dir.path().join("checkpoint.h5");
    let quiet_with_payload = f64::from_bits(0x7ff8_0000_dead_beef);
    let signalling = f64::from_bits(0xfff0_0000_0000_0001);
    let mut written = some_checkpoint(500);
    written.velocity[1][3] = quiet_with_payload;
    written.peak_work = signalling;
    checkpoint::write(&path, "abc", &written).unwrap();

    let mut read = read(&path, "abc").unwrap();
    assert_eq!(read.velocity[1][3].to_bits(), quiet_with_payload.to_bits());
    assert_eq!(read.peak_work.to_bits(), signalling.to_bits());
    for checkpoint in [&mut read, &mut written] {
        checkpoint.velocity[1][3] = 0.0;
        checkpoint.peak_work = 0.0;
    }
    assert_eq!(read, written);
}

#[test]
fn an_empty_checkpoint_reads_back() {
    let dir = tempdir().unwrap();
    let path = dir.path().join("checkpoint.h5");
    let empty: Checkpoint = Checkpoint::default();
    checkpoint::write(&path, "", &empty).unwrap();
    assert_eq!(read(&path, "").unwrap(), empty);
}

#[test]
fn a_checkpoint_cut_anywhere_is_refused() {
    let dir = tempdir().unwrap();
    let path = dir.path().join("checkpoint.h5");
    checkpoint::write(&path, "abc", &some_checkpoint(50)).unwrap();
    let whole = fs::read(&path).unwrap();
    for length in (0..whole.len()).step_by(STRIDE).chain([whole.len() - 1]) {
        fs::write(&path, &whole[..length]).unwrap();
        let error = read(&path, "abc").unwrap_err();
        assert!(matches!(error, RecordError::Damaged { .. }), "cut at {length}: {error}");
    }
}

#[test]
fn a_checkpoint_with_any_byte_changed_is_refused() {
    let dir = tempdir().unwrap();
    let path = dir.path().join("checkpoint.h5");
    checkpoint::write(&path, "abc", &some_checkpoint(50)).unwrap();
    let whole = fs::read(&path).unwrap();
    let body = (512..whole.len()).step_by(STRIDE);
    let header = 0..whole.iter().position(|byte| *byte == 0).unwrap();
    for place in header.chain(body) {
        let mut changed = whole.clone();
        changed[place] ^= 1;
        fs::write(&path, &changed).unwrap();
        assert!(read(&path, "abc").is_err(), "byte {place} changed");
    }
}

#[test]
fn a_failed_write_keeps_the_checkpoint_before() {
    let dir = tempdir().unwrap();
    let path = dir.path().join("checkpoint.h5");
    checkpoint::write(&path, "abc", &some_checkpoint(50)).unwrap();
    // The place where the next one would be written aside is taken by a folder.
    fs::create_dir(dir.path().join("checkpoint.h5.tmp")).unwrap();
    let error = checkpoint::write(&path, "abc", &some_checkpoint(60)).unwrap_err();
    assert!(error.is_write_failure(), "{error}");
    assert_eq!(read(&path, "abc").unwrap(), some_checkpoint(50));
}

#[test]
fn each_wrong_checkpoint_has_its_own_error() {
    let dir = tempdir().unwrap();
    let path = dir.path().join("checkpoint.h5");
    assert!(matches!(read(&path, "abc"), Err(RecordError::Absent { .. })));

    checkpoint::write(&path, "abc", &some_checkpoint(5)).unwrap();
    let error = read(&path, "xyz").unwrap_err();
    assert!(
        error.to_string().contains("belongs to case abc, not to case xyz"),
        "{error}"
    );

    // A file of the next format, sealed as it should be: only its first line is read.
    let mut bytes = fs::read(&path).unwrap();
    assert!(bytes.starts_with(b"cgaft checkpoint 10\n"));
    bytes[18] = b'1';
    fs::write(&path, &bytes).unwrap();
    let error = read(&path, "abc").unwrap_err();
    assert!(
        matches!(&error, RecordError::OtherFormat { found, readable: 10, .. } if found == "11"),
        "{error}"
    );

    fs::write(&path, "step,time\n1,2\n").unwrap();
    assert!(matches!(read(&path, "abc"), Err(RecordError::NotOurs { .. })));
}

#[test]
fn a_folder_that_is_not_there_is_a_write_failure() {
    let dir = tempdir().unwrap();
    let path = dir.path().join("gone").join("checkpoint.h5");
    let error = checkpoint::write(&path, "abc", &some_checkpoint(5)).unwrap_err();
    assert!(error.is_write_failure(), "{error}");
}
