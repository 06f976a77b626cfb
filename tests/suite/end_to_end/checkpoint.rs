//! Checkpoints that are whole as files and of no use as states.

use std::fs;
use std::path::PathBuf;

use cgaft::plan;
use cgaft::record::{CHECKPOINT_FILE, checkpoint};
use cgaft::solver::checkpoint::Checkpoint;

use super::{PATIENCE, Program, Said, Workspace, assert_same_results};

/// A study that has been computed, and what a solver makes of its case with the checkpoint changed.
struct Changed {
    place: Workspace,
    into: PathBuf,
    said: Said,
}

fn solve_with(change: impl FnOnce(&mut Checkpoint)) -> Changed {
    let place = Workspace::new();
    place.cgaft("run", &["--only", "coarse"]).succeeded();
    let whole = place.case("coarse");
    let case = whole.join("case.yaml");
    let id = plan::read_case(case.to_str().unwrap()).unwrap().cases[0].id.to_string();
    let mut state = checkpoint::read(&whole.join(CHECKPOINT_FILE), &id).unwrap();
    change(&mut state);
    let into = place.path("alone");
    fs::create_dir(&into).unwrap();
    checkpoint::write(&into.join(CHECKPOINT_FILE), &id, &state).unwrap();
    let said = Program::start(&mut place.solver(&case, &into, &[]), &place).wait(PATIENCE);
    Changed { place, into, said }
}

#[test]
fn a_checkpoint_with_too_few_numbers_is_told_and_the_case_starts_afresh() {
    let Changed { place, into, said } = solve_with(|state| state.velocity[1].truncate(3));
    let said = said.succeeded();
    for told in ["unequal numbers of coordinates", "starting afresh"] {
        assert!(said.stderr.contains(told), "no `{told}` in {}", said.stderr);
    }
    assert_same_results(&into, &place.case("coarse"));
}

#[test]
fn a_checkpoint_of_a_specimen_that_has_exploded_is_a_failure_of_the_physics() {
    let Changed { said, .. } = solve_with(|state| state.position[0][0] = f64::NAN);
    let said = said.ended_with(4);
    assert!(said.stderr.contains("kept in"), "{}", said.stderr);
}

/// What a failing disk does to a file: one bit is another one, or the rest is gone.
#[derive(Clone, Copy, Debug)]
enum Damage {
    Bit(usize),
    Length(usize),
}

#[test]
fn a_damaged_checkpoint_is_told_and_the_case_starts_afresh() {
    let place = Workspace::new();
    place.cgaft("run", &["--only", "coarse"]).succeeded();
    let whole = place.case("coarse");
    let sound = fs::read(whole.join(CHECKPOINT_FILE)).unwrap();
    let into = place.path("alone");
    // In the title, the identity, the checksum, the first bytes of HDF5, the numbers and the end.
    let bits = [2, 25, 60, 515, sound.len() / 2, sound.len() - 1].map(Damage::Bit);
    let lengths = [0, 10, 511, sound.len() / 2, sound.len() - 1].map(Damage::Length);
    for damage in bits.into_iter().chain(lengths) {
        let mut bytes = sound.clone();
        match damage {
            Damage::Bit(at) => bytes[at] ^= 1,
            Damage::Length(length) => bytes.truncate(length),
        }
        fs::create_dir(&into).unwrap();
        fs::write(into.join(CHECKPOINT_FILE), bytes).unwrap();
        let solve = &mut place.solver(&whole.join("case.yaml"), &into, &[]);
        let said = Program::start(solve, &place).wait(PATIENCE).succeeded();
        assert!(said.stderr.contains("; starting afresh"), "{damage:?}: {}", said.stderr);
        assert_same_results(&into, &whole);
        fs::remove_dir_all(&into).unwrap();
    }
}
