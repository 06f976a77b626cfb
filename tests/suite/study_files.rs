//! Study files as people write them, good and bad.
//!
//! Every file of `tests/study_files/bad` begins with what is to be reported, a line a mistake, in the order of the file:
//! `# 5:14 message` for a place, `# - message` for the file as a whole, and `#   help: …` where the help matters.

mod language_server;
mod mutations;
mod schema;
mod shipped;

use cgaft::{
    plan::{PlannedCase, RunId, plan, read_case, starter, write_case},
    setup,
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

/// Every study that is right: those that are shipped, and those of the tests.
fn right_studies() -> Vec<PathBuf> {
    ["studies", "tests/studies", "tests/study_files/good"]
        .into_iter()
        .flat_map(yaml_files)
        .collect()
}

fn check(path: &Path) -> Result<cgaft::plan::Plan, StudyError> {
    plan(&study::read(path.to_str().unwrap())?)
}

fn check_text(text: &str) -> Result<cgaft::plan::Plan, StudyError> {
    plan(&study::read_text("study.yaml", text)?)
}

/// What is wrong with a file, also what only material and mesh reveal.
fn mistakes(path: &Path) -> Vec<Mistake> {
    let plan = match check(path) {
        Ok(plan) => plan,
        Err(error) => return error.mistakes(),
    };
    let refused = |case: &PlannedCase| {
        setup::Estimator::default()
            .estimate(&case.case)
            .err()
            .map(|why| why.refusal())
    };
    let refusals = plan
        .cases
        .iter()
        .filter_map(|case| Some((case.name.as_str(), refused(case)?)));
    plan.refuse(refusals).mistakes()
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
        let reported: Vec<[String; 2]> = mistakes(&path).iter().map(stated).collect();
        assert!(!reported.is_empty(), "{}", path.display());
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
        for mistake in mistakes(&path) {
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

#[test]
fn every_right_study_gives_cases() {
    for path in right_studies() {
        let plan = check(&path).unwrap_or_else(|error| panic!("{}\n{error}", path.display()));
        assert!(!plan.cases.is_empty());
    }
}

#[test]
fn a_reference_is_for_all_that_a_sweep_makes_of_its_case() {
    let plan = check(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/study_files/good/models.yaml")).unwrap();
    let [comparison] = plan.comparisons.as_slice() else {
        panic!("{:?}", plan.comparisons)
    };
    assert_eq!((comparison.name.as_str(), comparison.table), ("k-ic", "summary"));
    let of_b: Vec<_> = comparison
        .values
        .iter()
        .filter(|expected| expected.value == 1.71)
        .map(|expected| expected.case.as_str())
        .collect();
    assert_eq!(of_b, ["B-element-5", "B-element-10", "B-element-20"]);
    assert_eq!(comparison.values.len(), 9);
}

#[test]
fn a_reference_by_swept_values_is_for_all_cases_that_have_them() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(
        folder.path().join("starts.csv"),
        "crack_length_nm,initiation_strain\n46,0.012\n50.0,0.011\n",
    )
    .unwrap();
    let path = folder.path().join("study.yaml");
    let sweep =
        "\nsweep:\n  crack.length: [46 nm, 0.05 um]\n  probes.every: [1 ps, 2 ps]\ncompare: {starts: starts.csv}\n";
    fs::write(&path, starter("fresh") + sweep).unwrap();
    let plan = check(&path).unwrap();
    let [comparison] = plan.comparisons.as_slice() else {
        panic!("{:?}", plan.comparisons)
    };
    let of = |value: f64| comparison.values.iter().filter(move |expected| expected.value == value);
    assert_eq!(comparison.table, "summary");
    assert_eq!([of(0.012).count(), of(0.011).count()], [plan.cases.len() / 2; 2]);
    assert!(of(0.011).all(|expected| expected.case.contains("length-50nm")));
}

#[test]
fn the_starter_study_is_right_as_it_is() {
    let plan = check_text(&starter("crack-speed")).unwrap();
    assert_eq!(plan.study, "crack-speed");
    assert_eq!(plan.cases.len(), 2);
}

#[test]
fn a_written_case_reads_back_to_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    let plans = right_studies().into_iter().map(|path| check(&path).unwrap());
    for planned in plans.flat_map(|plan| plan.cases) {
        let path = folder.path().join("case.yaml");
        fs::write(&path, write_case(&planned)).unwrap();
        // It is a study of its own, so that one case can be repeated from its folder alone; there it has nothing beside it.
        let alone = PlannedCase {
            id: RunId::of(&planned.case),
            origin: planned.name.clone(),
            swept: Vec::new(),
            repeat_of: None,
            ..planned
        };
        assert_eq!(read_case(path.to_str().unwrap()).unwrap().cases, [alone]);
    }
}

/// Time in which any answer must come, on a busy machine too.
const PROMPT: Duration = Duration::from_secs(2);

/// What is reported of bytes that are no study at all.
fn answer(bytes: &[u8]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.yaml");
    fs::write(&path, bytes).unwrap();
    let start = Instant::now();
    let error = check(&path).unwrap_err();
    let text = error.render(false);
    assert!(start.elapsed() < PROMPT, "{:?}", start.elapsed());
    assert!(error.mistakes().iter().all(|mistake| mistake.help.is_some()), "{text}");
    text
}

#[test]
fn a_file_that_is_no_study_gets_a_clear_answer() {
    assert!(answer(b"").contains("the file is empty"));
    assert!(answer(b"# nothing here\n\n").contains("the file is empty"));
    assert!(answer(b"study: \xff\xfe\n").contains("not UTF-8 text (line 1)"));
    assert!(answer(&vec![b'a'; 3_000_000]).contains("larger than 1 MB"));
    assert!(answer("[".repeat(900_000).as_bytes()).contains("more than 32 deep"));
    assert!(answer("a: {".repeat(200_000).as_bytes()).contains("more than 32 deep"));
    assert!(answer("- ".repeat(400_000).as_bytes()).contains("deep"));
    assert!(answer(&vec![b'a'; 900_000]).contains("this is not a study"));
    assert!(answer(b"study: a\0b\n").contains("mistake"));
    assert!(answer("x: 1\n".repeat(90_000).as_bytes()).contains("stands twice"));
    let keys: String = (0..60_000).map(|key| format!("key{key}: 1\n")).collect();
    assert!(keys.len() < 1_000_000);
    assert!(answer("x: 1\n".repeat(150_000).as_bytes()).contains("more than 200000 values"));
    assert!(answer(keys.as_bytes()).contains("1000 or more mistakes"));
}

#[test]
fn a_huge_file_is_refused_without_being_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.yaml");
    // 100 GB that take no room on the disk.
    fs::File::create(&path).unwrap().set_len(100_000_000_000).unwrap();
    let start = Instant::now();
    assert!(check(&path).unwrap_err().to_string().contains("larger than 1 MB"));
    assert!(start.elapsed() < PROMPT);
}

#[test]
fn a_pipe_in_the_place_of_a_study_or_of_a_table_is_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe.csv");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().unwrap();
    assert!(made.success());
    let told = check(&pipe).unwrap_err().to_string();
    assert!(told.contains("it is a pipe or a device and no file"), "{told}");
    let study = folder.path().join("study.yaml");
    fs::write(&study, starter("fresh") + "\ncompare: {x: pipe.csv}\n").unwrap();
    let told = check(&study).unwrap_err().to_string();
    assert!(told.contains("pipe.csv cannot be read: it is a pipe"), "{told}");
}

#[test]
fn a_million_nodes_are_checked_within_two_seconds() {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/quickstart.yaml")).unwrap();
    let larger = text.replace("length: 115 nm, width: 35.4 nm", "length: 600 nm, width: 110 nm");
    let start = Instant::now();
    let plan = check_text(&larger).unwrap();
    let atoms = plan.cases.iter().find(|planned| planned.name == "atoms").unwrap();
    let estimate = setup::Estimator::default().estimate(&atoms.case).unwrap();
    assert!(estimate.nodes > 1_000_000);
    assert!(start.elapsed() < Duration::from_secs(2), "{:?}", start.elapsed());
}

#[test]
fn a_folder_and_a_missing_file_are_named() {
    let folder = tempfile::tempdir().unwrap();
    assert!(
        check(folder.path())
            .unwrap_err()
            .to_string()
            .contains("a folder, not a file")
    );
    let missing = check(&folder.path().join("absent.yaml")).unwrap_err();
    assert!(missing.to_string().contains("there is no such file"), "{missing}");
    assert!(missing.to_string().contains("quickstart.yaml"), "{missing}");
}

#[test]
fn line_ends_of_windows_and_a_byte_order_mark_are_no_matter() {
    let text = starter("windows");
    let unix = check_text(&text).unwrap();
    let windows = check_text(&format!("\u{feff}{}", text.replace('\n', "\r\n"))).unwrap();
    assert_eq!(unix.cases, windows.cases);
}

#[test]
fn a_place_is_counted_in_characters() {
    let error =
        check_text("study: a\nquestion: Größe\nbase: {specimen: {length: 3 Ångström, width: 1}}\n").unwrap_err();
    let places: Vec<_> = error
        .mistakes()
        .iter()
        .filter_map(|mistake| Some((mistake.line?, mistake.column?)))
        .collect();
    assert!(places.contains(&(3, 27)) && places.contains(&(3, 46)), "{error}");
}

#[test]
fn a_thousand_cases_are_planned_in_no_time() {
    let sweep = "sweep:\n  loading.strain-rate.rate: {from: 1e6 /s, to: 1e8 /s, step: 1e6 /s}\n  crack.length: {from: 30 nm, to: 75 nm, step: 5 nm}\n";
    let text = starter("many")
        .replace("cases: ", "# ")
        .replace("  slow: {}", "")
        .replace("  fast: ", "# ")
        + sweep;
    let start = Instant::now();
    let plan = check_text(&text).unwrap();
    assert_eq!(plan.cases.len(), 1000);
    assert!(start.elapsed() < PROMPT / 2, "{:?}", start.elapsed());
}

#[test]
fn the_report_points_at_both_places_of_a_clash() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/study_files/bad/crack_longer_than_specimen.yaml");
    let report = check(&path).unwrap_err().render(false);
    assert!(report.contains("crack_longer_than_specimen.yaml:"), "{report}");
    assert!(
        report.contains("─── the specimen") || report.contains("╰── the specimen"),
        "{report}"
    );
    assert!(!report.contains('\u{1b}'));
    assert!(check(&path).unwrap_err().render(true).contains('\u{1b}'));
}
