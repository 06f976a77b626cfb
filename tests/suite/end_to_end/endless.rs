//! Pipes in the place of files: whoever opened one would wait for ever.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use super::{Program, Workspace};

/// A command that looks at three cases takes a fraction of a second, a run of one of them about one.
const PROMPT: Duration = Duration::from_secs(30);

/// What a study command may end with.
const DOCUMENTED: [i32; 5] = [0, 1, 2, 3, 5];

fn put_pipe(path: &Path) {
    // That there is nothing to remove is the only way in which this fails.
    let _ = fs::remove_file(path);
    assert!(Command::new("mkfifo").arg(path).status().unwrap().success());
}

#[test]
fn a_pipe_in_the_place_of_the_format_mark_is_told_at_once() {
    let place = Workspace::new();
    fs::create_dir_all(place.results()).unwrap();
    put_pipe(&place.results().join("store.json"));
    for command in ["status", "plan", "report", "clean", "run"] {
        let told = Program::start(&mut place.command(command, &[]), &place)
            .wait(PROMPT)
            .ended_with(2);
        for words in ["store.json: it is a pipe or a device and no file", "--results DIR"] {
            assert!(
                told.stderr.contains(words),
                "{command}: no `{words}` in {}",
                told.stderr
            );
        }
    }
}

#[test]
fn no_command_waits_for_a_pipe_in_the_place_of_a_file_of_a_run() {
    let whole = Workspace::new();
    whole.cgaft("run", &["--only", "coarse"]).succeeded();
    let folder = whole.case("coarse");
    let id = folder.file_name().unwrap().to_str().unwrap().to_owned();
    let places = [
        format!("runs/{id}/manifest.json"),
        format!("runs/{id}/series.h5"),
        format!("runs/{id}/damage.txt"),
        format!("runs/{id}.partial/attempt.json"),
        format!("runs/{id}.partial/failure.json"),
        format!("runs/{id}.partial/cost.json"),
        format!("runs/{id}.partial/log.txt"),
        format!("runs/{id}.partial/checkpoint.h5"),
        format!("runs/{id}.partial/.solver-lock"),
        format!(".locks/{id}"),
        format!(".slurm/{id}.json"),
        ".report-of".to_owned(),
        "report.html".to_owned(),
    ];
    for file in places {
        let place = Workspace::new();
        let copied = Command::new("cp")
            .arg("-a")
            .arg(whole.path("results"))
            .arg(place.path("results"))
            .status();
        assert!(copied.unwrap().success());
        let path = place.results().join(&file);
        if file.contains(".partial") {
            let published = place.results().join("runs").join(&id);
            fs::rename(published, path.parent().unwrap()).unwrap();
        }
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        put_pipe(&path);
        for (command, arguments) in [
            ("status", &["--verify"][..]),
            ("report", &[]),
            ("run", &["--only", "coarse"]),
        ] {
            let said = Program::start(&mut place.command(command, arguments), &place).wait(PROMPT);
            let code = said.status.code().unwrap_or(-1);
            assert!(DOCUMENTED.contains(&code), "{file}: {command}: {code}: {}", said.stderr);
            assert!(!said.stderr.contains("panicked"), "{file}: {command}: {}", said.stderr);
        }
    }
}
