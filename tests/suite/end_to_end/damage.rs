//! Published files that change on the disk afterwards.

use std::fs;
use std::path::Path;

use cgaft::store::{State, Store};

use super::{PATIENCE, Program, STUDY, Workspace, assert_same_results, files, send, wait_for};
use crate::suite::published::put_in_the_place_of;
use crate::suite::specimens::Noise;

/// Another bit in the middle of a file, whose size stays.
fn flip_a_bit(file: &Path) {
    let mut bytes = fs::read(file).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    put_in_the_place_of(file, bytes);
}

#[test]
fn a_flipped_bit_is_told_by_the_report_and_the_next_run_computes_the_case_again() {
    for name in ["series.h5", "fields.vtkhdf"] {
        let place = Workspace::new();
        let whole = Workspace::new();
        for place in [&place, &whole] {
            place.cgaft("run", &["--only", "coarse"]).succeeded();
        }
        let told = place.cgaft("status", &["--verify"]).succeeded();
        assert!(told.stdout.contains("1 case: as published"), "{}", told.stdout);

        flip_a_bit(&place.case("coarse").join(name));
        let report = place.cgaft("report", &[]).ended_with(1);
        let why = format!("coarse: damaged: {name} no longer holds what was published");
        for words in [why.as_str(), "`cgaft study run` computes it again"] {
            assert!(report.stderr.contains(words), "no `{words}` in {}", report.stderr);
        }
        let page = fs::read_to_string(place.results().join("report.md")).unwrap();
        assert!(page.contains("no longer holds what was published"), "{page}");

        let again = place.cgaft("run", &["--only", "coarse"]).succeeded();
        assert!(again.stdout.contains("coarse: runs (corrupt: "), "{}", again.stdout);
        assert!(again.started("coarse"));
        assert_same_results(&place.case("coarse"), &whole.case("coarse"));
        assert_eq!(place.states()[0], "done");
    }
}

#[test]
fn who_asks_for_it_is_told_of_damage_by_words_json_and_exit_code() {
    let place = Workspace::new();
    place.cgaft("run", &["--only", "coarse"]).succeeded();
    flip_a_bit(&place.case("coarse").join("checkpoint.h5"));
    assert_eq!(place.states()[0], "done", "a look at the sizes does not tell");
    let json = place.cgaft("status", &["--verify", "--json"]).ended_with(1).json();
    assert_eq!(json["cases"][0]["state"], "corrupt");
    let told = place.cgaft("status", &["--verify"]).ended_with(1).stdout;
    for words in [
        "checkpoint.h5 no longer holds what was published; `cgaft study run` computes it again",
        "1 case: damaged\n",
    ] {
        assert!(told.contains(words), "no `{words}` in {told}");
    }
}

#[test]
fn a_manifest_that_was_changed_is_told_at_every_look() {
    let place = Workspace::new();
    place.cgaft("run", &["--only", "coarse"]).succeeded();
    let manifest = place.case("coarse").join("manifest.json");
    let text = fs::read_to_string(&manifest).unwrap();
    let length = text.find(" nm\"").expect("a length of the case");
    let mut bytes = text.into_bytes();
    bytes[length + 1] = b'f';
    put_in_the_place_of(&manifest, bytes);
    assert_eq!(place.states()[0], "corrupt");
    let again = place.cgaft("run", &["--only", "coarse"]).succeeded();
    assert!(
        again
            .stdout
            .contains("coarse: runs (corrupt: manifest.json no longer holds what was published"),
        "{}",
        again.stdout
    );
    assert_eq!(place.states()[0], "done");
}

/// So many bits of each file are turned, one at a time.
const FLIPS: usize = 200;

/// A file with one bit turned, which `noise` chooses, and the place of that bit.
fn with_a_flip(whole: &[u8], noise: &mut Noise) -> (Vec<u8>, usize) {
    let bits = 8 * whole.len();
    let place = (0.5 * (noise.next() + 1.0) * bits as f64) as usize % bits;
    let mut bytes = whole.to_vec();
    bytes[place / 8] ^= 1 << (place % 8);
    (bytes, place)
}

#[test]
fn any_flipped_bit_of_any_file_of_a_run_is_found() {
    let place = Workspace::new();
    place.cgaft("run", &["--only", "coarse"]).succeeded();
    let store = Store::open(&place.path("results"), "slab").unwrap();
    let folder = place.case("coarse");
    let id = folder.file_name().unwrap().to_str().unwrap();
    // A program that another test is just starting has this one's lock for a moment.
    let verified = || {
        let states = std::iter::repeat_with(|| store.verified_state(id));
        let mut known = states.filter(|state| !matches!(state, State::Running(_)));
        known.next().expect("states never end")
    };
    let mut noise = Noise(7);
    let mut files: Vec<_> = fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    files.sort();
    assert!(files.len() >= 5, "{files:?}");
    for file in files {
        let whole = fs::read(&file).unwrap();
        for _ in 0..FLIPS {
            let (bytes, place) = with_a_flip(&whole, &mut noise);
            put_in_the_place_of(&file, bytes);
            let state = verified();
            assert!(
                matches!(state, State::Corrupt { .. }),
                "{}: bit {place}: {state:?}",
                file.display()
            );
        }
        put_in_the_place_of(&file, whole);
        assert!(matches!(verified(), State::Done(_)), "{}", file.display());
    }
}

/// A run that somebody has stopped, and the file in which it tells how far it is.
fn interrupted() -> (Workspace, &'static str) {
    let place = Workspace::restless();
    let run = Program::start(&mut place.command("run", &["--only", "atoms"]), &place);
    wait_for("a checkpoint", || {
        files(&place.results())
            .iter()
            .any(|path| path.ends_with("checkpoint.h5"))
    });
    send("-INT", run.child.id());
    run.wait(PATIENCE).ended_with(130);
    (place, "attempt.json")
}

/// A run whose physics failed, and the file in which it tells why.
fn failed() -> (Workspace, &'static str) {
    // Just below the limit of the crystal at rest, which the breaking one undercuts.
    let place = Workspace::with(&STUDY.replace("atoms: {", "atoms: {run: {time-step: 108 fs}, "));
    place.cgaft("run", &["--only", "atoms"]).ended_with(1);
    (place, "failure.json")
}

#[test]
fn no_flipped_bit_of_what_an_unfinished_run_tells_of_itself_is_in_the_way() {
    for (place, name) in [interrupted(), failed()] {
        let state = || place.states()[2].clone();
        let whole_state = state();
        let file = files(&place.results())
            .into_iter()
            .find(|path| path.ends_with(name))
            .unwrap();
        let whole = fs::read(&file).unwrap();
        let mut noise = Noise(11);
        for flip in 0..FLIPS {
            let (bytes, at) = with_a_flip(&whole, &mut noise);
            fs::write(&file, &bytes).unwrap();
            let found = state();
            // What cannot be read says nothing, and the run goes on from its checkpoint.
            assert!(
                [whole_state.as_str(), "partial"].contains(&found.as_str()),
                "{name}: bit {at}: {found}"
            );
            // These take longer, so a share of the flips must do.
            if flip % 20 == 0 {
                place.cgaft("report", &[]).succeeded();
                place.cgaft("plan", &[]).succeeded();
            }
        }
        let code = place.cgaft("run", &["--only", "atoms"]).status.code();
        assert_eq!(code, Some(i32::from(name == "failure.json")), "{name}");
    }
}
