//! Study files as people write them, good and bad.
//!
//! Every file of `tests/study_files/bad` begins with what is to be reported, a line a mistake, in the order of the file:
//! `# 5:14 message` for a place, `# - message` for the file as a whole, and `#   help: …` where the help matters.

use cgaft::{
    plan::{plan, starter, write_case},
    study::{self, Mistake, StudyError},
};
use std::{
    fs,
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

fn yaml_files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "yaml"))
        .collect();
    files.sort();
    files
}

fn check(path: &Path) -> Result<cgaft::plan::Plan, StudyError> {
    plan(&study::read(path.to_str().unwrap())?)
}

fn check_text(text: &str) -> Result<cgaft::plan::Plan, StudyError> {
    plan(&study::read_text("study.yaml", text)?)
}

/// The lines of the leading comment that state what is to be reported.
fn expected(text: &str) -> Vec<String> {
    text.lines()
        .map_while(|line| line.strip_prefix('#'))
        .filter(|line| !line.trim().is_empty())
        .map(|line| line.strip_prefix(' ').unwrap_or(line).to_owned())
        .collect()
}

fn stated(mistake: &Mistake) -> [String; 2] {
    let place = match (mistake.line, mistake.column) {
        (Some(line), Some(column)) => format!("{line}:{column}"),
        _ => "-".into(),
    };
    [
        format!("{place} {}", mistake.message),
        format!("  help: {}", mistake.help.as_deref().unwrap_or("")),
    ]
}

#[test]
fn every_bad_file_is_answered_with_the_mistakes_it_states() {
    let files = yaml_files("tests/study_files/bad");
    assert!(files.len() >= 25);
    let mut failed = String::new();
    for path in files {
        let expected = expected(&fs::read_to_string(&path).unwrap());
        let reported: Vec<[String; 2]> = check(&path)
            .expect_err(path.to_str().unwrap())
            .mistakes()
            .iter()
            .map(stated)
            .collect();
        let with_help = |index: usize| expected.get(index).is_some_and(|line| line.starts_with("  help: "));
        let mut at = 0;
        let mut told = Vec::new();
        for [message, help] in reported {
            told.push(message);
            at += 1;
            if with_help(at) {
                told.push(help);
                at += 1;
            }
        }
        if told != expected {
            failed += &format!("{}\n  expected {expected:#?}\n  reported {told:#?}\n", path.display());
        }
    }
    assert!(failed.is_empty(), "{failed}");
}

#[test]
fn every_mistake_says_what_to_do_next() {
    for path in yaml_files("tests/study_files/bad") {
        for mistake in check(&path).unwrap_err().mistakes() {
            let steers = ["write", "did you mean"]
                .iter()
                .any(|word| mistake.message.contains(word));
            assert!(
                mistake.help.is_some() || steers || mistake.message.contains("such as"),
                "{}: {mistake:?}",
                path.display()
            );
        }
    }
}
