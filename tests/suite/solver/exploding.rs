//! A specimen that explodes between two probes.

use std::sync::atomic::AtomicBool;

use cgaft::solver::{RunError, Settings, SolverError};

use super::super::specimens::{nearest_neighbours, slab};
use super::{Keeper, settings, solver};

#[test]
fn an_atom_that_flies_away_between_two_probes_ends_the_run_at_once_and_is_named() {
    let material = nearest_neighbours();
    let settings = Settings {
        probe_every: 10.0,
        ..settings(0.1)
    };
    let mut solver = solver(slab(1, vec![], material.spacing), material, settings);
    let mut checkpoint = solver.checkpoint();
    let node = checkpoint.position[0].len() / 2;
    let place = [0, 1].map(|axis| checkpoint.position[axis][node]);
    checkpoint.velocity[0][node] = 1e6;
    (checkpoint.step, checkpoint.time) = (1, checkpoint.time_step);
    solver.restore(&checkpoint).unwrap();
    let mut keeper = Keeper::default();
    let ended = solver.run(&mut keeper, &AtomicBool::new(false));
    let Err(RunError::Physics(error)) = ended else {
        panic!("nothing holds that atom")
    };
    let told = error.to_string();
    let SolverError::BlowUp { step, place: found, .. } = error else {
        panic!("{told}")
    };
    assert_eq!((step, keeper.probes.len()), (2, 0), "{told}");
    let x = place[0] - solver.setting().left_x;
    assert!((found[0] - x).abs() < 1e-9, "{told}");
    assert!(told.contains("try a smaller fraction"), "{told}");
}
