use std::fs;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

use cgaft::executor::share::Share;
use cgaft::executor::{self, Ending, Errand, Job, Progress, Settings, Stop, Watcher};
use cgaft::store::{Reached, State, Store};
use jiff::Timestamp;
use serde_json::json;
use tempfile::TempDir;

/// Long enough for a loaded machine; nothing waits so long when all is well.
const PATIENCE: Duration = Duration::from_secs(20);

fn store() -> (TempDir, Store) {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(folder.path(), "slab").unwrap();
    store.prepare().unwrap();
    (folder, store)
}

fn job(name: &str, behaviour: &str) -> Job {
    Job {
        name: name.to_owned(),
        id: format!("id-{name}"),
        case_text: format!("case: {name}\nfake: {behaviour}\n"),
        case: json!({ "name": name }),
        seconds: 1.0,
        ranks: None,
        threads: None,
        fresh: None,
    }
}

fn settings(jobs: usize) -> Settings {
    let solver = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/suite/fake-solver.sh");
    Settings {
        solver,
        share: Share {
            jobs,
            threads: 3,
            cores: None,
        },
        worth_a_restart: Duration::ZERO,
        slurm_job: None,
    }
}

fn starts(store: &Store) -> Vec<String> {
    let text = fs::read_to_string(store.root().join("starts.txt")).unwrap_or_default();
    text.lines().map(str::to_owned).collect()
}

#[derive(Default)]
struct Notes {
    events: Vec<String>,
    stop_when_running: Option<Stop>,
}

impl Watcher for Notes {
    fn submitted(&mut self, job: &Job, id: &str) {
        self.events.push(format!("{} submitted as {id}", job.name));
    }

    fn queued(&mut self, job: &Job, why: &str) {
        self.events.push(format!("{} queued ({why})", job.name));
    }

    fn reached(&mut self, job: &Job, reached: &Reached) {
        self.events.push(format!("{} at step {}", job.name, reached.step));
    }

    fn started(&mut self, job: &Job) {
        self.events.push(format!("{} started", job.name));
    }

    fn widened(&mut self, job: &Job, cores: usize) {
        self.events.push(format!("{} goes on with {cores} cores", job.name));
    }

    fn progress(&mut self, job: &Job, progress: &Progress) {
        self.events.push(format!("{} {} %", job.name, progress.percent));
        if let Some(stop) = self.stop_when_running.take() {
            stop.request();
        }
    }

    fn waiting(&mut self, job: &Job) {
        self.events.push(format!("{} waits", job.name));
    }

    fn stopping(&mut self) {
        self.events.push("stopping".to_owned());
    }

    fn ended(&mut self, job: &Job, ending: &Ending) {
        self.events.push(format!("{} {}", job.name, word(ending)));
    }
}

fn word(ending: &Ending) -> &'static str {
    match ending {
        Ending::Done(_) => "done",
        Ending::DoneElsewhere(_) => "elsewhere",
        Ending::Failed(_) => "failed",
        Ending::Interrupted(_) => "interrupted",
        Ending::NotStarted => "not started",
        Ending::HandedOver(_) => "handed over",
    }
}

fn run(store: &Store, jobs: &[Job], at_once: usize) -> (Vec<Ending>, Vec<String>) {
    let mut notes = Notes::default();
    let endings = executor::run(
        Errand::new(store, jobs, &mut notes),
        &settings(at_once),
        &Stop::default(),
    )
    .unwrap();
    (endings, notes.events)
}

fn words(endings: &[Ending]) -> Vec<&'static str> {
    endings.iter().map(word).collect()
}

#[test]
fn a_case_is_started_watched_and_published() {
    let (_folder, store) = store();
    let (endings, events) = run(&store, &[job("A", "well")], 1);
    assert_eq!(words(&endings), ["done"]);
    assert_eq!(events, ["A started", "A 40 %", "A done"]);
    assert_eq!(starts(&store), ["id-A.partial threads=3"]);
    let State::Done(manifest) = store.state("id-A") else {
        panic!("it was published")
    };
    assert_eq!((manifest.outcome.steps, manifest.threads), (100, 3));
    assert_eq!(store.linked("A").as_deref(), Some("id-A"));
    let log = fs::read_to_string(store.run_folder("id-A").join("log.txt")).unwrap();
    assert!(
        log.contains("--into") && log.contains("a word that is no progress"),
        "{log}"
    );
}

#[test]
fn a_failing_case_does_not_stop_the_others() {
    let (_folder, store) = store();
    let (endings, _) = run(&store, &[job("A", "fail"), job("B", "well"), job("C", "empty")], 2);
    assert_eq!(words(&endings), ["failed", "done", "failed"]);
    let Ending::Failed(failure) = &endings[0] else {
        unreachable!()
    };
    assert!(failure.meaning.starts_with("the physics failed"), "{}", failure.meaning);
    assert_eq!(failure.log_tail.len(), 20);
    assert_eq!(failure.log_tail.last().map(String::as_str), Some("log line 30"));
    let Ending::Failed(empty) = &endings[2] else {
        unreachable!()
    };
    assert!(empty.meaning.contains("without a result"), "{}", empty.meaning);
}

#[test]
fn the_longest_case_is_started_first() {
    let (_folder, store) = store();
    let cases = [("A", 1.0), ("B", 9.0), ("C", 3.0)].map(|(name, seconds)| Job {
        seconds,
        ..job(name, "well")
    });
    let (_, events) = run(&store, &cases, 1);
    let started: Vec<_> = events.iter().filter(|event| event.ends_with("started")).collect();
    assert_eq!(started, ["B started", "C started", "A started"]);
}

#[test]
fn no_more_cases_run_at_once_than_allowed() {
    let (_folder, store) = store();
    let cases = ["A", "B", "C"].map(|name| job(name, "pause"));
    let (_, events) = run(&store, &cases, 2);
    let mut running = 0_i32;
    let mut most = 0;
    for event in &events {
        running += i32::from(event.ends_with("started")) - i32::from(event.ends_with("done"));
        most = most.max(running);
    }
    assert_eq!(most, 2, "{events:?}");
}

#[test]
fn a_case_left_alone_goes_on_from_its_checkpoint_with_all_cores() {
    let (_folder, store) = store();
    let mut notes = Notes::default();
    let cases = [job("A", "long"), job("B", "pause")];
    let share = Share {
        jobs: 2,
        threads: 1,
        cores: Some(2),
    };
    let settings = Settings { share, ..settings(2) };
    let errand = Errand::new(&store, &cases, &mut notes);
    let endings = executor::run(errand, &settings, &Stop::default()).unwrap();
    assert_eq!(words(&endings), ["done", "done"]);
    assert!(
        notes.events.contains(&"A goes on with 2 cores".to_owned()),
        "{:?}",
        notes.events
    );
    let mut started = starts(&store);
    started.sort();
    let expected = [
        "id-A.partial threads=1",
        "id-A.partial threads=2",
        "id-B.partial threads=1",
    ];
    assert_eq!(started, expected);
    let Ending::Done(manifest) = &endings[0] else {
        panic!("it is done")
    };
    assert_eq!((manifest.attempts, manifest.threads), (2, 2));
}

#[test]
fn two_runners_of_one_study_share_the_work() {
    let (_folder, store) = store();
    let cases = ["A", "B", "C"].map(|name| job(name, "pause"));
    let (first, second) = thread::scope(|scope| {
        let first = scope.spawn(|| run(&store, &cases, 1).0);
        let second = scope.spawn(|| run(&store, &cases, 1).0);
        (first.join().unwrap(), second.join().unwrap())
    });
    for endings in [first, second] {
        assert!(
            endings
                .iter()
                .all(|ending| matches!(ending, Ending::Done(_) | Ending::DoneElsewhere(_)))
        );
    }
    let mut started = starts(&store);
    started.sort();
    assert_eq!(
        started,
        ["A", "B", "C"].map(|name| format!("id-{name}.partial threads=3")),
        "each is computed once"
    );
}

#[test]
fn a_request_to_stop_reaches_the_solver_which_leaves_a_checkpoint() {
    let (_folder, store) = store();
    let stop = Stop::default();
    let mut notes = Notes {
        stop_when_running: Some(stop.clone()),
        ..Notes::default()
    };
    let cases = [job("A", "slow"), job("B", "well")];
    let start = Instant::now();
    let endings = executor::run(Errand::new(&store, &cases, &mut notes), &settings(1), &stop).unwrap();
    assert!(start.elapsed() < PATIENCE);
    assert_eq!(words(&endings), ["interrupted", "not started"]);
    assert_eq!(notes.events, ["A started", "A 40 %", "stopping", "A interrupted"]);
    assert!(store.partial_folder("id-A").join("checkpoint.h5").exists());
    let State::Partial(Some(attempt)) = store.state("id-A") else {
        panic!("it was interrupted")
    };
    assert_eq!(attempt.reached.map(|reached| reached.step), Some(40));
}

#[test]
fn a_failed_case_is_tried_again_and_a_done_one_is_not() {
    let (_folder, store) = store();
    run(&store, &[job("A", "fail")], 1);
    let repaired = Job {
        case_text: "case: A\n".to_owned(),
        ..job("A", "well")
    };
    let (endings, _) = run(&store, std::slice::from_ref(&repaired), 1);
    let Ending::Done(manifest) = &endings[0] else {
        panic!("{endings:?}")
    };
    assert_eq!(manifest.attempts, 2);
    let (endings, _) = run(&store, std::slice::from_ref(&repaired), 1);
    assert_eq!(words(&endings), ["elsewhere"]);
    let (endings, _) = run(
        &store,
        &[Job {
            fresh: Some(Timestamp::now()),
            ..repaired
        }],
        1,
    );
    assert_eq!(words(&endings), ["done"]);
    assert_eq!(starts(&store).len(), 3);
}

#[test]
fn a_solver_that_cannot_be_started_is_an_error_with_its_name() {
    let (_folder, store) = store();
    let settings = Settings {
        solver: PathBuf::from("no-such-solver"),
        ..settings(1)
    };
    let (jobs, mut notes) = ([job("A", "well")], Notes::default());
    let failed = executor::run(Errand::new(&store, &jobs, &mut notes), &settings, &Stop::default());
    assert!(failed.unwrap_err().to_string().contains("no-such-solver"));
}
