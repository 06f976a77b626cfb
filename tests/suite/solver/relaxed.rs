//! Specimens that come to rest before they move.

use std::sync::atomic::AtomicBool;

use cgaft::loading::{Grip, Stretching};
use cgaft::mesh::cut::Crack;
use cgaft::mesh::region::{Region, Shape};
use cgaft::mesh::sites::Layout;
use cgaft::mesh::{Mesh, Plan};
use cgaft::potential::AtCutoff;
use cgaft::solver::{Ending, RunError, Settings, Solver, SolverError, Until};

use super::super::specimens::{lennard_jones, nearest_neighbours, slab};
use super::{ENERGY_ERROR, Keeper, run, settings};

#[test]
fn a_specimen_relaxed_under_a_strain_starts_in_equilibrium_and_goes_on_from_its_checkpoints() {
    /// The bonds of the grips are not stretched as the mean of all.
    const EQUILIBRIUM: f64 = 1e-4;
    /// What the grips add in one unit of time at 1e-5, over the strain of 1e-2.
    const DRIFT: f64 = 2e-3;
    let material = lennard_jones(1.9, AtCutoff::Smooth { from: 1.5 });
    let band = Region {
        shape: Shape::Band {
            half_width: 9.0 * material.spacing,
        },
        element: 1,
    };
    let relaxed = |end: f64| {
        let mesh = slab(10, vec![band], material.spacing);
        let loading = Stretching::new(&mesh, 1e-5, Grip::Clamped, false).from_strain(0.01);
        let settings = Settings {
            relax: true,
            until: Until {
                time: Some(end),
                strain: Some(0.5),
                ..Until::default()
            },
            ..settings(1.0)
        };
        Solver::new(mesh, material, loading, settings).unwrap()
    };
    let mut whole = relaxed(6.0);
    let (kept, _) = run(&mut whole);
    let start = kept.probes[0];
    assert_eq!((start.time, start.strain, start.work), (0.0, 0.01, 0.0));
    // In equilibrium the grips pull as the virial says: that has a height of 1.01.
    let grip_stress = start.sigma_yy / 1.01;
    assert!((start.grip_stress / grip_stress - 1.0).abs() < EQUILIBRIUM, "{start:?}");
    let drift = kept.probes[1].sigma_yy / start.sigma_yy - 1.0;
    assert!(drift.abs() < DRIFT, "{drift}");
    let error = whole.ledger().relative_error().unwrap();
    assert!(error < ENERGY_ERROR, "energy error {error:e}");

    let mut first = relaxed(3.0);
    let (early, _) = run(&mut first);
    let mut second = relaxed(6.0);
    second.restore(early.checkpoints.last().unwrap()).unwrap();
    // The run before ended at 3 ps, and gave its last probe there.
    run(&mut second);
    assert!(second.checkpoint().position == whole.checkpoint().position);
    assert_eq!(second.ledger().start(), whole.ledger().start());
}

#[test]
fn a_run_can_be_stopped_while_its_specimen_comes_to_rest() {
    let material = nearest_neighbours();
    let mesh = slab(1, vec![], material.spacing);
    let loading = Stretching::new(&mesh, 1e-3, Grip::Clamped, true).from_strain(0.3);
    let settings = Settings {
        relax: true,
        ..settings(0.4)
    };
    let mut solver = Solver::new(mesh, material, loading, settings).unwrap();
    let stopped = AtomicBool::new(true);
    let ending = solver.run(&mut Keeper::default(), &stopped).unwrap();
    assert_eq!(ending, Ending::Interrupted);
    assert_eq!(solver.step_count(), 0);
}

#[test]
fn a_crack_that_runs_while_its_specimen_comes_to_rest_is_told() {
    let material = nearest_neighbours();
    let mesh = Mesh::new(&Plan {
        layout: Layout {
            block: 10,
            rows: 6,
            triangles: 9,
        },
        element: 1,
        regions: vec![],
        crack: Some(Crack::of_length(25.0)),
        grip_rows: 10,
        spacing: material.spacing,
    });
    let loading = Stretching::new(&mesh, 1e-3, Grip::Clamped, true).from_strain(0.04);
    let settings = Settings {
        relax: true,
        ..settings(0.1)
    };
    let mut solver = Solver::new(mesh, material, loading, settings).unwrap();
    let ended = solver.run(&mut Keeper::default(), &AtomicBool::new(false));
    let Err(RunError::Physics(error)) = ended else {
        panic!("the crack cannot stay where it is")
    };
    let SolverError::RanWhileResting { notch, tip, strain } = error else {
        panic!("{error}")
    };
    assert!(tip > notch + 5.0 && strain == 0.04, "{error}");
}
