//! Nothing is lost and nothing is read wrongly when the disk fills up or the program is killed in the middle of a file.
//!
//! The writing is done by a child process. A limit on the length of files, set there, stands for the full disk: a write beyond it fails as one
//! without room does.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use cgaft::analysis::series::Series;
use cgaft::record::{
    CHECKPOINT_FILE, FIELDS_FILE, RecordError, SERIES_FILE, checkpoint, cut_back, publish_fields, publish_series,
    write_frame, write_segment,
};
use tempfile::tempdir;

use super::{checkpoint as some_checkpoint, frame, mesh, series, setting};

/// Tells the child which folder to work in.
const FOLDER: &str = "CGAFT_TEST_CHILD_FOLDER";
/// Exit code of a child whose write failed as it should.
const WRITE_FAILURE: i32 = 5;
/// Limits that are tried for each file, evenly up to its full length.
const LIMITS: u64 = 12;

/// Runs the test `name` again as a child that may write files of up to `length` bytes; did it write?
fn writes_within(name: &str, folder: &Path, length: u64) -> bool {
    const BLOCK: u64 = 512;
    let setup = format!("trap '' XFSZ; ulimit -f {};", length / BLOCK);
    match start_child(name, folder, &setup).wait().unwrap().code() {
        Some(0) => true,
        Some(WRITE_FAILURE) => false,
        other => panic!("the child ended with {other:?}"),
    }
}

/// Starts the test `name` again as a child, after a line of shell.
fn start_child(name: &str, folder: &Path, setup: &str) -> Child {
    Command::new("sh")
        .args(["-c", &format!("{setup} exec \"$0\" \"$@\"")])
        .arg(std::env::current_exe().unwrap())
        .args(["--exact", &format!("suite::record::interrupted::{name}"), "--nocapture"])
        .env(FOLDER, folder)
        .stdout(Stdio::null())
        .spawn()
        .unwrap()
}

/// In the child: does `write` in the folder and ends. In the parent: nothing.
fn in_child(write: impl FnOnce(&Path) -> Result<(), RecordError>) {
    if let Some(folder) = std::env::var_os(FOLDER).map(PathBuf::from) {
        std::process::exit(match write(&folder) {
            Ok(()) => 0,
            Err(error) if error.is_write_failure() => WRITE_FAILURE,
            Err(error) => panic!("{error}"),
        });
    }
}

#[test]
fn a_checkpoint_that_does_not_fit_leaves_the_one_before() {
    in_child(|folder| checkpoint::write(&folder.join(CHECKPOINT_FILE), "abc", &some_checkpoint(2000)));
    let dir = tempdir().unwrap();
    let path = dir.path().join(CHECKPOINT_FILE);
    checkpoint::write(&path, "abc", &some_checkpoint(2000)).unwrap();
    let full = fs::metadata(&path).unwrap().len();
    for share in 0..=LIMITS {
        checkpoint::write(&path, "abc", &some_checkpoint(3)).unwrap();
        let name = "a_checkpoint_that_does_not_fit_leaves_the_one_before";
        let written = writes_within(name, dir.path(), full * share / LIMITS);
        let nodes = if written { 2000 } else { 3 };
        assert_eq!(
            checkpoint::read(&path, "abc").unwrap(),
            some_checkpoint(nodes),
            "share {share}"
        );
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
    }
}

const FRAMES: [u64; 3] = [0, 40, 80];
const LAST_STEP: u64 = 490;

fn write_pieces(dir: &Path) {
    write_segment(dir, 0, &series(0..20, 100)).unwrap();
    write_segment(dir, 20, &series(20..50, 100)).unwrap();
    for step in FRAMES {
        write_frame(dir, &frame(step, &mesh(1500))).unwrap();
    }
}

fn publish(dir: &Path) -> Result<(), RecordError> {
    publish_series(dir, "1f", &setting(None))?;
    publish_fields(dir, "1f", &mesh(1500))
}

/// The published files of `dir`, which must be all there is.
fn published(dir: &Path) -> [Vec<u8>; 2] {
    assert_eq!(fs::read_dir(dir).unwrap().count(), 2);
    [SERIES_FILE, FIELDS_FILE].map(|name| fs::read(dir.join(name)).unwrap())
}

fn published_undisturbed() -> [Vec<u8>; 2] {
    let dir = tempdir().unwrap();
    write_pieces(dir.path());
    publish(dir.path()).unwrap();
    published(dir.path())
}

#[test]
fn publishing_without_room_loses_nothing() {
    in_child(publish);
    let whole = published_undisturbed();
    for share in 0..=LIMITS {
        let dir = tempdir().unwrap();
        write_pieces(dir.path());
        writes_within(
            "publishing_without_room_loses_nothing",
            dir.path(),
            whole[1].len() as u64 * share / LIMITS,
        );
        // Now there is room.
        publish(dir.path()).unwrap();
        assert!(published(dir.path()) == whole, "the bytes differ, share {share}");
    }
}

#[test]
fn publishing_that_is_killed_anywhere_can_be_repeated() {
    in_child(publish);
    let whole = published_undisturbed();
    // Ever later, until the child is done before it is killed.
    for delay in (0..).step_by(4).map(Duration::from_millis) {
        let dir = tempdir().unwrap();
        write_pieces(dir.path());
        let done = kill_after(delay, "publishing_that_is_killed_anywhere_can_be_repeated", dir.path());
        cut_back::<Series>(dir.path(), Some(LAST_STEP)).unwrap();
        publish(dir.path()).unwrap();
        assert!(
            published(dir.path()) == whole,
            "the bytes differ, killed after {delay:?}"
        );
        if done {
            break;
        }
    }
}

#[test]
fn a_checkpoint_is_whole_whenever_its_writer_is_killed() {
    in_child(|folder| {
        for nodes in (0..).map(|round| 1000 + round % 7) {
            checkpoint::write(&folder.join(CHECKPOINT_FILE), "abc", &some_checkpoint(nodes))?;
        }
        Ok(())
    });
    let dir = tempdir().unwrap();
    let path = dir.path().join(CHECKPOINT_FILE);
    checkpoint::write(&path, "abc", &some_checkpoint(1000)).unwrap();
    for delay in (10..60).step_by(5).map(Duration::from_millis) {
        kill_after(delay, "a_checkpoint_is_whole_whenever_its_writer_is_killed", dir.path());
        let read = checkpoint::read(&path, "abc").unwrap();
        assert_eq!(read, some_checkpoint(read.position[0].len() as u64));
        // The next run removes what was half written.
        cut_back::<Series>(dir.path(), Some(read.step)).unwrap();
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
    }
}

/// Runs the test `name` again as a child and kills it after a while; was it done before?
fn kill_after(delay: Duration, name: &str, folder: &Path) -> bool {
    let mut child = start_child(name, folder, "");
    std::thread::sleep(delay);
    let done = child.try_wait().unwrap().is_some();
    child.kill().unwrap();
    child.wait().unwrap();
    done
}
