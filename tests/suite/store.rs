use std::collections::BTreeSet;
use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::time::Duration;

use cgaft::store::{Account, FolderLock, Leftover, Outcome, Phase, Reached, Spent, State, Store, StoreError};
use serde_json::json;
use tempfile::TempDir;

use super::published::put_in_the_place_of;

fn store() -> (TempDir, Store) {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(folder.path(), "slab").unwrap();
    store.prepare().unwrap();
    (folder, store)
}

fn outcome() -> Outcome {
    Outcome {
        end_reason: "strain 0.01 reached".to_owned(),
        steps: 100,
        time_step_ps: 1e-3,
        stability_limit_ps: 1.5e-3,
        energy_error_relative: None,
        closest_approach_spacings: None,
        peak_memory_bytes: None,
        core_seconds: None,
        cost: Vec::new(),
        messages: None,
    }
}

fn publish(store: &Store, id: &str) {
    let mut claim = store.claim(id).unwrap().unwrap();
    claim.begin("case: A\n", true).unwrap();
    fs::write(claim.folder().join("series.h5"), "rows").unwrap();
    outcome().write(&claim.folder()).unwrap();
    let found = claim.outcome().unwrap();
    claim
        .publish(found, "A", &json!({"crack": "none"}), 1, 2, None)
        .unwrap();
}

#[test]
fn a_run_killed_just_before_it_was_published_is_published_whole() {
    let (_folder, store) = store();
    publish(&store, "1f");
    fs::rename(store.run_folder("1f"), store.partial_folder("1f")).unwrap();
    let mut claim = store.claim("1f").unwrap().unwrap();
    assert_eq!(claim.state(), State::Partial(None));
    claim.begin("case: A\n", false).unwrap();
    claim
        .publish(outcome(), "A", &json!({"crack": "none"}), 1, 2, None)
        .unwrap();
    assert!(matches!(store.state("1f"), State::Done(_)), "{:?}", store.state("1f"));
}

#[test]
fn nobody_may_write_a_published_file_and_a_new_run_takes_its_place_all_the_same() {
    let (_folder, store) = store();
    for _ in 0..2 {
        publish(&store, "1f");
        for name in ["case.yaml", "series.h5", "manifest.json"] {
            let mode = fs::metadata(store.run_folder("1f").join(name))
                .unwrap()
                .permissions()
                .mode();
            assert_eq!(mode & 0o222, 0, "{name}: {mode:o}");
        }
    }
    store.clean(&set(&[]), &set(&[]), &set(&[])).unwrap();
    assert!(!store.run_folder("1f").exists(), "and it can be removed");
}

fn set(names: &[&str]) -> BTreeSet<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

#[test]
fn a_published_run_tells_where_it_came_from() {
    let (_folder, store) = store();
    assert_eq!(store.state("1f"), State::Missing);
    publish(&store, "1f");
    let State::Done(manifest) = store.state("1f") else {
        panic!("it was published")
    };
    assert_eq!(manifest.program.version, env!("CARGO_PKG_VERSION"));
    assert_eq!((manifest.attempts, manifest.ranks, manifest.threads), (1, 1, 2));
    assert!(manifest.started <= manifest.ended && manifest.wall_seconds > 0.0);
    assert_eq!(manifest.outcome, outcome());
    assert_eq!(manifest.case, json!({"crack": "none"}));
    assert_eq!(manifest.files.keys().collect::<Vec<_>>(), ["case.yaml", "series.h5"]);
    assert!(!store.partial_folder("1f").exists());
    for left_over in ["attempt.json", "outcome.json", ".solver-lock"] {
        assert!(!store.run_folder("1f").join(left_over).exists(), "{left_over}");
    }
}

#[test]
fn only_one_at_a_time_works_on_a_run() {
    let (_folder, store) = store();
    let first = store.claim("1f").unwrap();
    assert!(first.is_some());
    assert!(store.claim("1f").unwrap().is_none());
    assert!(matches!(store.state("1f"), State::Running(None)));
    assert!(store.claim("2e").unwrap().is_some(), "another run is free");
    drop(first);
    assert!(store.claim("1f").unwrap().is_some());
}

#[test]
fn a_solver_that_outlives_its_runner_keeps_its_folder() {
    let (_folder, store) = store();
    let mut claim = store.claim("1f").unwrap().unwrap();
    claim.begin("case: A\n", false).unwrap();
    let solver = FolderLock::take(&claim.folder(), Duration::ZERO).unwrap().unwrap();
    assert!(FolderLock::take(&claim.folder(), Duration::ZERO).unwrap().is_none());
    drop(claim);
    assert!(matches!(store.state("1f"), State::Running(Some(_))));
    assert!(store.claim("1f").unwrap().is_none());
    drop(solver);
    assert!(store.claim("1f").unwrap().is_some());
}

#[test]
fn an_interrupted_run_remembers_how_far_it_was() {
    let (_folder, store) = store();
    let reached = Reached {
        step: 40,
        of: 100,
        percent: 40.0,
    };
    let mut claim = store.claim("1f").unwrap().unwrap();
    claim.begin("case: A\n", false).unwrap();
    claim.note(Some(reached)).unwrap();
    fs::write(claim.folder().join("checkpoint.h5"), "state").unwrap();
    drop(claim);
    let State::Partial(Some(attempt)) = store.state("1f") else {
        panic!("it was interrupted")
    };
    assert_eq!((attempt.reached, attempt.attempts), (Some(reached), 1));

    let mut claim = store.claim("1f").unwrap().unwrap();
    claim.begin("case: A\n", false).unwrap();
    assert!(claim.folder().join("checkpoint.h5").exists(), "it goes on from there");
    assert_eq!(claim.note(None).unwrap().attempts, 2);
    claim.begin("case: A\n", true).unwrap();
    assert!(!claim.folder().join("checkpoint.h5").exists(), "it starts over");
}

#[test]
fn a_failed_run_keeps_its_output_and_its_reason() {
    let (_folder, store) = store();
    let mut claim = store.claim("1f").unwrap().unwrap();
    claim.begin("case: A\n", false).unwrap();
    fs::write(claim.folder().join("log.txt"), "step 7 blew up").unwrap();
    claim
        .fail(
            Some(4),
            "the physics failed".to_owned(),
            vec!["step 7 blew up".to_owned()],
        )
        .unwrap();
    let State::Failed(failure) = store.state("1f") else {
        panic!("it failed")
    };
    assert_eq!(
        (failure.exit_code, failure.meaning.as_str()),
        (Some(4), "the physics failed")
    );
    assert!(store.partial_folder("1f").join("log.txt").exists());
}

#[test]
fn damage_to_a_published_run_is_seen() {
    for (damage, words) in [
        (remove_series as fn(&Path), "series.h5 cannot be read"),
        (cut_series, "series.h5 has 1 bytes instead of 4"),
        (remove_manifest, "manifest.json cannot be read"),
        (cut_manifest, "manifest.json is damaged"),
    ] {
        let (_folder, store) = store();
        publish(&store, "1f");
        damage(&store.run_folder("1f"));
        let State::Corrupt { why } = store.state("1f") else {
            panic!("{words}")
        };
        assert!(why.contains(words), "{why}");
        publish(&store, "1f");
        assert!(matches!(store.state("1f"), State::Done(_)), "a new run takes its place");
    }
}

/// Another byte in the place of the first.
fn flip_a_bit(file: &Path) {
    let mut bytes = fs::read(file).unwrap();
    bytes[0] ^= 1;
    put_in_the_place_of(file, bytes);
}

#[test]
fn a_flipped_bit_is_found_by_who_looks_for_it_and_remembered_until_the_file_is_whole_again() {
    let (_folder, store) = store();
    publish(&store, "1f");
    assert!(matches!(store.verified_state("1f"), State::Done(_)));
    let series = store.run_folder("1f").join("series.h5");
    flip_a_bit(&series);
    assert!(matches!(store.state("1f"), State::Done(_)), "its size is right");
    let damaged = State::Corrupt {
        why: "series.h5 no longer holds what was published".to_owned(),
    };
    assert_eq!(store.verified_state("1f"), damaged);
    assert_eq!(store.state("1f"), damaged, "who asks later is told too");

    flip_a_bit(&series);
    assert!(matches!(store.verified_state("1f"), State::Done(_)));
    assert!(matches!(store.state("1f"), State::Done(_)));

    flip_a_bit(&series);
    store.verified_state("1f");
    publish(&store, "1f");
    assert!(matches!(store.state("1f"), State::Done(_)), "a new run takes its place");
}

#[test]
fn a_run_that_is_just_being_replaced_is_not_looked_into() {
    let (_folder, store) = store();
    publish(&store, "1f");
    flip_a_bit(&store.run_folder("1f").join("series.h5"));
    let at_work = store.claim("1f").unwrap().unwrap();
    assert!(matches!(store.verified_state("1f"), State::Done(_)));
    drop(at_work);
    assert!(matches!(store.verified_state("1f"), State::Corrupt { .. }));
    assert_eq!(store.verified_state("2e"), State::Missing);
}

#[test]
fn a_run_published_before_there_were_checksums_is_judged_by_its_sizes() {
    let (_folder, store) = store();
    publish(&store, "1f");
    let path = store.run_folder("1f").join("manifest.json");
    let mut manifest: serde_json::Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
    assert_eq!(manifest["blake3"].as_object().unwrap().len(), 2);
    for later in ["blake3", "seal"] {
        manifest.as_object_mut().unwrap().remove(later).unwrap();
    }
    put_in_the_place_of(&path, manifest.to_string());
    flip_a_bit(&store.run_folder("1f").join("series.h5"));
    let State::Done(manifest) = store.verified_state("1f") else {
        panic!("its sizes are right")
    };
    assert!(manifest.blake3.is_empty());
    cut_series(&store.run_folder("1f"));
    assert!(matches!(store.verified_state("1f"), State::Corrupt { .. }));
}

fn remove_series(run: &Path) {
    fs::remove_file(run.join("series.h5")).unwrap();
}

fn cut_series(run: &Path) {
    put_in_the_place_of(&run.join("series.h5"), "r");
}

fn remove_manifest(run: &Path) {
    fs::remove_file(run.join("manifest.json")).unwrap();
}

fn cut_manifest(run: &Path) {
    put_in_the_place_of(&run.join("manifest.json"), "{\"id\":");
}

#[test]
fn a_case_points_at_its_latest_run() {
    let (_folder, store) = store();
    publish(&store, "1f");
    publish(&store, "2e");
    store.link("A", "1f").unwrap();
    store.link("A", "2e").unwrap();
    assert_eq!(store.linked("A").as_deref(), Some("2e"));
    assert!(store.root().join("cases/A/manifest.json").exists());
    assert_eq!(
        fs::read_link(store.root().join("cases/A")).unwrap(),
        Path::new("../runs/2e")
    );
}

#[test]
fn clean_takes_what_is_not_needed_and_leaves_what_is() {
    let (_folder, store) = store();
    for id in ["1f", "2e"] {
        publish(&store, id);
    }
    store.link("A", "1f").unwrap();
    store.link("old", "2e").unwrap();
    for id in ["3d", "4c"] {
        store.claim(id).unwrap().unwrap().begin("case: A\n", false).unwrap();
    }
    let _at_work = store.claim("4c").unwrap().unwrap();
    let told = |leftovers: &[Leftover]| -> Vec<_> {
        leftovers
            .iter()
            .map(|leftover| (leftover.what, leftover.in_use))
            .collect()
    };
    let expected = [("superseded", false), ("unpublished", false), ("unpublished", true)];
    let current = set(&["1f", "3d", "4c"]);
    assert_eq!(told(&store.leftovers(&current, &BTreeSet::new()).unwrap()), expected);
    assert!(matches!(store.state("2e"), State::Done(_)), "looking removes nothing");
    assert_eq!(
        told(&store.clean(&current, &BTreeSet::new(), &set(&["A"])).unwrap()),
        expected
    );
    assert!(matches!(store.state("1f"), State::Done(_)));
    assert_eq!([store.state("2e"), store.state("3d")], [State::Missing, State::Missing]);
    assert!(
        matches!(store.state("4c"), State::Running(_)),
        "what is at work is not touched"
    );
    assert_eq!(
        [store.linked("A").as_deref(), store.linked("old").as_deref()],
        [Some("1f"), None]
    );
}

#[test]
fn an_account_adds_up_what_the_attempts_cost() {
    let folder = tempfile::tempdir().unwrap();
    let phase = |name: &str, calls, seconds| Phase {
        name: name.to_owned(),
        calls,
        seconds,
    };
    let spent = |core_seconds, phases: &[Phase]| Spent {
        core_seconds,
        phases: phases.to_vec(),
    };
    let first = Account::open(folder.path());
    first.save(&spent(1.5, &[phase("forces", 10, 1.0)])).unwrap();
    // The same attempt, further on.
    first
        .save(&spent(6.0, &[phase("forces", 40, 4.0), phase("output", 1, 0.5)]))
        .unwrap();
    let second = Account::open(folder.path());
    assert_eq!(
        second.total(&spent(0.75, &[phase("forces", 2, 0.25)])),
        spent(6.75, &[phase("forces", 42, 4.25), phase("output", 1, 0.5)])
    );
    fs::write(folder.path().join("cost.json"), "{").unwrap();
    assert_eq!(Account::open(folder.path()).total(&Spent::default()), Spent::default());
}

#[test]
fn results_of_another_format_are_refused_with_advice() {
    let (folder, store) = store();
    for (mark, found) in [("{\"format\": 99}", "99"), ("no json", "unknown")] {
        fs::write(store.root().join("store.json"), mark).unwrap();
        let error = Store::open(folder.path(), "slab").unwrap_err();
        let text = error.to_string();
        assert!(
            text.contains(&format!("format {found}")) && text.contains("--results"),
            "{text}"
        );
    }
}

#[test]
fn a_place_that_cannot_be_written_is_told_with_advice() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("results");
    fs::write(&file, "in the way").unwrap();
    let store = Store::open(&folder.path().join("elsewhere"), "slab").unwrap();
    assert!(!store.root().exists(), "looking leaves no trace");
    let blocked = Store::open(&file, "slab");
    let error = blocked.and_then(|store| store.prepare()).unwrap_err();
    assert!(error.to_string().contains("--results DIR"), "{error}");
}

#[test]
fn a_read_only_folder_is_an_error_and_no_panic() {
    let folder = tempfile::tempdir().unwrap();
    fs::set_permissions(folder.path(), Permissions::from_mode(0o555)).unwrap();
    let store = Store::open(folder.path(), "slab").unwrap();
    // The superuser may write everywhere.
    if let Err(error) = store.prepare() {
        assert!(matches!(error, StoreError::Write { .. }));
        assert!(error.to_string().contains("writable"), "{error}");
    }
    fs::set_permissions(folder.path(), Permissions::from_mode(0o755)).unwrap();
}
