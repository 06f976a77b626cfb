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
    for told in ["another number of nodes", "starting afresh"] {
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
