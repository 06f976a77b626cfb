//! Damping of all motion but even stretching.

use cgaft::loading::{Grip, Sponge, Stretching};
use cgaft::potential::AtCutoff;
use cgaft::solver::{Settings, Solver};

use super::{ENERGY_ERROR, QUARTER, run, settings};
use crate::suite::specimens::{all_meshes, lennard_jones, nearest_neighbours, slab};

const RATE: f64 = 1e-3;

#[test]
fn the_ledger_closes_on_every_mesh_whatever_damping_takes() {
    let material = lennard_jones(1.9, AtCutoff::Smooth { from: 1.5 });
    for (name, mesh) in all_meshes(material.spacing) {
        let damping = Sponge::new(&mesh, RATE, None, 0.2);
        let loading = Stretching::new(&mesh, RATE, Grip::Clamped, true).with_sponge(Some(damping));
        let settings = Settings {
            time_step: QUARTER,
            ..settings(0.08)
        };
        let mut solver = Solver::new(mesh, material, loading, settings).unwrap();
        let (keeper, _) = run(&mut solver);
        assert!(keeper.bonds.iter().any(|event| event.broken), "{name}: nothing broke");
        let error = solver.ledger().relative_error().unwrap();
        assert!(error < ENERGY_ERROR, "{name}: energy error {error:e}");
    }
}

#[test]
fn a_damped_slab_breaks_with_less_heat_and_what_is_taken_is_missing_in_the_work() {
    let material = nearest_neighbours();
    let broken = |damping: Option<f64>| {
        let mesh = slab(1, vec![], material.spacing);
        let sponge = damping.map(|damping| Sponge::new(&mesh, RATE, None, damping));
        let loading = Stretching::new(&mesh, RATE, Grip::Clamped, true).with_sponge(sponge);
        let mut solver = Solver::new(mesh, material, loading, settings(0.06)).unwrap();
        let (keeper, _) = run(&mut solver);
        *keeper.probes.last().unwrap()
    };
    let [free, damped] = [None, Some(0.2)].map(broken);
    assert!(
        damped.temperature < 0.5 * free.temperature,
        "{damped:?} beside {free:?}"
    );
    assert!(damped.work < free.work, "{damped:?} beside {free:?}");
}
