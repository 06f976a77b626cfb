//! A slab under a pulse that is stopped and goes on.

use cgaft::setup::slab::solver;
use cgaft::solver::{Solver, SolverError};
use cgaft::study::case::Case;
use cgaft::{plan, study};

/// Steps of the whole, and of the part before it is stopped, which ends while the pulse is on.
const STEPS: [u64; 2] = [400, 150];

fn case(name: &str) -> Case {
    let text = include_str!("../../studies/pulse.yaml");
    let read = study::read_text("pulse.yaml", text).unwrap();
    let planned = plan::plan(&read).unwrap_or_else(|error| panic!("{error}"));
    let found = planned.cases.into_iter().find(|case| case.name == name);
    found.expect("it has this case").case
}

fn made(name: &str) -> Solver {
    let case = case(name);
    solver(&case, case.slab().expect("it is a slab")).unwrap()
}

#[test]
fn a_slab_under_a_pulse_goes_on_from_a_checkpoint_with_the_same_bits_and_the_same_work() {
    for name in ["coarse", "mixed"] {
        let mut whole = made(name);
        whole.advance_by(STEPS[0]).unwrap();
        let mut first = made(name);
        first.advance_by(STEPS[1]).unwrap();
        let kept = first.checkpoint();
        assert!(
            kept.kept.booked.works.iter().any(|work| *work > 0.0),
            "the pulse has worked by then"
        );
        let mut second = made(name);
        second.restore(&kept).unwrap();
        second.advance_by(STEPS[0] - STEPS[1]).unwrap();
        assert!(second.checkpoint() == whole.checkpoint(), "{name}");
    }
}

#[test]
fn gauges_stand_where_the_study_wants_them() {
    assert_eq!(made("coarse").gauge_places(), [[40.0, 0.0], [90.0, 0.0]]);
}

#[test]
fn a_checkpoint_of_another_load_is_refused_and_changes_nothing() {
    let mut own = made("coarse");
    let before = own.checkpoint();
    let mut foreign = before.clone();
    foreign.kept.booked.works.push(0.0);
    let refused = own.restore(&foreign);
    assert!(matches!(refused, Err(SolverError::OtherSpecimen(_))), "{refused:?}");
    assert!(own.checkpoint() == before);
}
