//! Where the grips pull so fast that the energy is at stake.

use std::sync::atomic::AtomicBool;

use cgaft::loading::{Grip, Stretching};
use cgaft::material::WaveSpeeds;
use cgaft::solver::{Ending, Settings, Solver, SolverError, TimeStep};

use super::super::specimens::{nearest_neighbours, slab};
use super::{Keeper, settings};

/// What grips that outrun the specimen by a hundredth of the spacing a step may lose of the work.
const ENERGY_ERROR: f64 = 0.01;

/// A slab at rest whose grips part at this share of the speed of sound each.
fn pulled(element: u16, share: f64, settings: Settings) -> Result<Solver, SolverError> {
    let material = nearest_neighbours();
    let mesh = slab(element, vec![], material.spacing);
    let [low, high] = mesh.grip_edges();
    let rate = 2.0 * share * WaveSpeeds::of(&material).longitudinal / (high - low);
    let loading = Stretching::new(&mesh, rate, Grip::Clamped, false);
    let probe_every = 0.02 / rate;
    Solver::new(
        mesh,
        material,
        loading,
        Settings {
            probe_every,
            ..settings
        },
    )
}

#[test]
fn grips_that_are_torn_off_a_specimen_at_rest_leave_its_energy_right() {
    for element in [1, 10] {
        // 6e11, 3e11 and 5e10 /s of the source's material in 6.7 nm.
        for share in [0.99, 0.5, 0.08] {
            let mut solver = pulled(element, share, settings(0.2)).expect("the run starts");
            let ending = solver.run(&mut Keeper::default(), &AtomicBool::new(false)).unwrap();
            let label = format!("n = {element}, {share} of the speed of sound");
            assert!(matches!(ending, Ending::Strain(_)), "{label}: {ending}");
            let error = solver.ledger().relative_error().unwrap();
            assert!(error < ENERGY_ERROR, "{label}: energy error {error:e}");
        }
    }
}

#[test]
fn a_given_step_in_which_the_grips_outrun_the_specimen_is_refused_and_the_longest_is_told() {
    let given = |step| Settings {
        time_step: TimeStep::Given(step),
        ..settings(0.2)
    };
    let Err(SolverError::OutrunByGrips { longest, .. }) = pulled(1, 0.5, given(0.05)) else {
        panic!("it must be refused")
    };
    let just = pulled(1, 0.5, given(longest)).expect("the longest is not too long");
    let auto = pulled(1, 0.5, settings(0.2)).expect("the run starts");
    assert_eq!(just.time_step()[0], auto.time_step()[0]);
}
