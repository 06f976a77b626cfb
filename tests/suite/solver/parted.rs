//! Where the specimen has parted, and its pieces collide.

use std::sync::atomic::AtomicBool;

use cgaft::loading::{Grip, Stretching};
use cgaft::mesh::cut::Crack;
use cgaft::mesh::sites::Layout;
use cgaft::mesh::{Mesh, Plan};
use cgaft::solver::{Ending, Settings, Solver};

use super::super::specimens::nearest_neighbours;
use super::{Keeper, settings};

/// What an automatic time step may lose of the work while pieces collide.
const ENERGY_ERROR: f64 = 0.01;

/// A slab of 30 x 22 nm of the source's crystal with a crack of 10 nm, in units of its potential.
fn slab(element: u16, spacing: f64) -> Mesh {
    let layout = Layout {
        block: 10,
        rows: 10,
        triangles: 21,
    };
    Mesh::new(&Plan {
        layout,
        element,
        regions: vec![],
        crack: Some(Crack::of_length(39.1)),
        grip_rows: 10,
        spacing,
    })
}

#[test]
fn an_automatic_time_step_follows_pieces_that_collide() {
    let material = nearest_neighbours();
    // 2e9 and 2e10 /s.
    for (element, rate) in [(10, 2.04e-3), (1, 2.04e-2)] {
        let mesh = slab(element, material.spacing);
        let loading = Stretching::new(&mesh, rate, Grip::Clamped, true);
        let settings = Settings {
            probe_every: 0.005 / rate,
            ..settings(0.6)
        };
        let mut solver = Solver::new(mesh, material, loading, settings).unwrap();
        let [at_first, _] = solver.time_step();
        let ending = solver.run(&mut Keeper::default(), &AtomicBool::new(false)).unwrap();
        assert!(matches!(ending, Ending::Strain(_)), "n = {element}: {ending}");
        let error = solver.ledger().relative_error().unwrap();
        assert!(error < ENERGY_ERROR, "n = {element}: energy error {error:e}");
        assert!(solver.time_step()[0] < at_first, "n = {element}: nothing collided");
    }
}
