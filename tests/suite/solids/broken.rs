//! What breaks in a solid, as its probes count it.

use super::{last, meshes, pulled, run, settings, solver};

#[test]
fn a_solid_that_is_torn_apart_has_broken_bonds_and_open_interfaces_and_slow_stretching_breaks_none() {
    for (name, mesh) in meshes() {
        let broken = |speed: f64| {
            let mut solver = solver(&mesh, pulled(&mesh, speed, false), settings(6.0));
            let (keeper, _) = run(&mut solver);
            ["broken_bonds", "open_interfaces"].map(|column| last(&keeper.columns, column))
        };
        assert_eq!(broken(0.02), [0.0; 2], "{name}");
        let [bonds, interfaces] = broken(1.0);
        assert!(
            bonds > 100.0 && (interfaces > 0.0) == (mesh.parts > 0),
            "{name}: {bonds} {interfaces}"
        );
    }
}
