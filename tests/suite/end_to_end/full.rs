//! Nowhere to write: what was published stays, and the rest is computed when there is room again.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::{PATIENCE, Program, RESULTS, Said, Workspace, assert_same_results};

/// Bytes of what a case has left on disk.
fn results(run: &Path) -> Vec<Vec<u8>> {
    RESULTS.iter().map(|name| fs::read(run.join(name)).unwrap()).collect()
}

/// `cgaft study COMMAND` where no file may become larger than this.
fn with_files_up_to(place: &Workspace, kibibytes: u32, command: &str, words: &[&str]) -> Said {
    // The shell counts blocks of 512 bytes. Ignored, the signal becomes the error that a full disk gives.
    let limited = format!("trap '' XFSZ; ulimit -f {}; exec \"$@\"", 2 * kibibytes);
    let run = place.command(command, words);
    let mut shell = Command::new("sh");
    shell
        .args(["-c", &limited, "sh"])
        .arg(run.get_program())
        .args(run.get_args());
    shell.current_dir(place.folder.path());
    shell.env("CGAFT_SOLVE", env!("CARGO_BIN_EXE_cgaft-solve"));
    Program::start(&mut shell, place).wait(PATIENCE)
}

#[test]
fn a_case_that_cannot_be_written_fails_with_advice_and_goes_on_when_there_is_room() {
    let place = Workspace::restless();
    let whole = Workspace::restless();
    whole.cgaft("run", &[]).succeeded();
    place.cgaft("run", &["--only", "coarse"]).succeeded();
    let published = results(&place.case("coarse"));

    // Larger than the files of the coarse case, smaller than the frames of the others and than a picture of the report.
    let full = with_files_up_to(&place, 60, "run", &[]).ended_with(5);
    for told in [
        "atoms: failed: the output could not be written (exit code 5)",
        "could not be written: File too large; make room",
        "the run goes on from its last checkpoint",
    ] {
        assert!(full.stderr.contains(told), "no `{told}` in {}", full.stderr);
    }
    assert_eq!(place.states(), ["done", "failed", "failed"]);

    place.cgaft("run", &[]).succeeded();
    for case in ["coarse", "mixed", "atoms"] {
        assert_same_results(&place.case(case), &whole.case(case));
    }
    assert!(results(&place.case("coarse")) == published);
}

#[test]
fn a_case_computed_afresh_keeps_the_run_before_until_it_is_written_whole() {
    let place = Workspace::restless();
    place.cgaft("run", &["--only", "atoms"]).succeeded();
    let published = results(&place.case("atoms"));
    with_files_up_to(&place, 60, "run", &["--only", "atoms", "--fresh"]).ended_with(1);
    assert!(results(&place.case("atoms")) == published);
    assert_eq!(place.states()[2], "done");
}

#[test]
fn a_report_that_cannot_be_written_tells_which_file_and_what_to_do_and_is_built_when_there_is_room() {
    let place = Workspace::new();
    place.cgaft("run", &["--only", "mixed"]).succeeded();
    let page = fs::read(place.results().join("report.md")).unwrap();
    // Smaller than a table, than a picture, and than the page itself.
    for (kibibytes, file) in [(1, "tables/"), (40, "figures/slab-"), (100, "report.html")] {
        let full = with_files_up_to(&place, kibibytes, "report", &[]).ended_with(5);
        let told = format!("the report: cannot write results/slab/{file}");
        for words in [told.as_str(), "File too large", "make room", "`cgaft study report`"] {
            assert!(full.stderr.contains(words), "no `{words}` in {}", full.stderr);
        }
        assert!(!full.stderr.contains("defect"), "{}", full.stderr);
    }
    place.cgaft("run", &["--only", "mixed"]).succeeded();
    assert!(fs::read(place.results().join("report.md")).unwrap() == page);
}

/// A file system of its own; `None` for who may not mount one.
struct Disk {
    folder: PathBuf,
}

impl Disk {
    fn of(folder: &Path, kibibytes: u32) -> Option<Disk> {
        fs::create_dir_all(folder).unwrap();
        let size = format!("size={kibibytes}k");
        let mount = Command::new("mount")
            .args(["-t", "tmpfs", "-o", &size, "tmpfs"])
            .arg(folder)
            .output();
        let disk = Disk {
            folder: folder.to_owned(),
        };
        mount.is_ok_and(|mount| mount.status.success()).then_some(disk)
    }

    fn grow(&self, kibibytes: u32) {
        let size = format!("remount,size={kibibytes}k");
        let grown = Command::new("mount").args(["-o", &size]).arg(&self.folder).status();
        assert!(grown.unwrap().success());
    }
}

impl Drop for Disk {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(&self.folder).output();
    }
}

/// A disk that is full before the first file, and in the middle of one case and another, KiB.
const SIZES: [u32; 4] = [4, 140, 700, 1300];
/// Enough for the study twice over, KiB.
const ROOM: u32 = 200_000;

#[test]
fn a_full_disk_ends_a_study_with_advice_and_one_with_room_finishes_it() {
    let whole = Workspace::restless();
    whole.cgaft("run", &[]).succeeded();
    for size in SIZES {
        let place = Workspace::restless();
        let Some(disk) = Disk::of(&place.path("results"), size) else {
            return;
        };
        let full = place.cgaft("run", &["--threads", "1"]).ended_with(5);
        assert!(full.stderr.contains("No space left on device"), "{}", full.stderr);
        let done = place.states().iter().filter(|state| *state == "done").count();
        disk.grow(ROOM);
        let again = place.cgaft("run", &[]).succeeded();
        assert_eq!(
            again.stdout.matches(": done (unchanged)").count(),
            done,
            "{}",
            again.stdout
        );
        for case in ["coarse", "mixed", "atoms"] {
            assert_same_results(&place.case(case), &whole.case(case));
        }
    }
}
