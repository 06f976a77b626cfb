//! What makes a beginning and daily work easy: a study to start from, its schema, man pages and completions.

use std::fs;

use super::Workspace;

#[test]
fn new_writes_a_study_that_is_right_and_never_overwrites() {
    let place = Workspace::new();
    let told = place.cgaft(&["new", "my-crack"]).succeeded().stdout;
    assert!(told.contains("my-crack.yaml and study.schema.json"), "{told}");
    let first = fs::read_to_string(place.path("my-crack.yaml")).unwrap();
    let schema = first.lines().next().unwrap().rsplit('=').next().unwrap().to_owned();
    assert_eq!(
        fs::read_to_string(place.path(&schema)).unwrap(),
        place.cgaft(&["schema"]).succeeded().stdout,
        "the schema that it names is there"
    );
    place.cgaft(&["study", "check", "my-crack.yaml"]).succeeded();
    let again = place.cgaft(&["new", "my-crack"]);
    assert_eq!(again.code, Some(2));
    assert!(again.stderr.contains("exists already"), "{}", again.stderr);
    assert_eq!(place.cgaft(&["new", "../crack"]).code, Some(2));
}

#[test]
fn both_programs_have_man_pages_and_completions() {
    let place = Workspace::new();
    place.cgaft(&["man", "pages/man1"]).succeeded();
    for (page, words) in [
        ("cgaft.1", "coarse\\-grained"),
        ("cgaft-study-run.1", "\\-\\-only"),
        ("cgaft-solve.1", "\\-\\-into"),
    ] {
        let text = fs::read_to_string(place.path("pages/man1").join(page)).unwrap();
        assert!(text.to_lowercase().contains(words), "{page}: {text}");
    }
    for shell in ["bash", "zsh", "fish"] {
        let script = place.cgaft(&["completions", shell]).succeeded().stdout;
        assert!(
            script.contains("cgaft-solve") && script.contains("parent-pipe"),
            "{shell}"
        );
    }
}
