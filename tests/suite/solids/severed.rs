//! Solids with a plane that is severed over a half: its faces collide and part again.

use cgaft::loading::Course;
use cgaft::mesh::solid::Solid as Mesh;
use cgaft::mesh::solid::cut::Cut;
use cgaft::solver::{Settings, TimeStep};

use super::{last, meshes_with, pushed, run, settings, solver};

/// Between the second and the third of four blocks, over one of two.
const CUT: Cut = Cut {
    normal: [0, 0, 1],
    layer: 12,
    into: [1, 0, 0],
    end: 6,
};

fn severed() -> [(&'static str, Mesh); 3] {
    meshes_with(Some(CUT))
}

/// Of the work, at a quarter of the stability limit: collisions are stiffer than the crystal.
const ENERGY_ERROR: f64 = 5e-3;

#[test]
fn energy_is_kept_while_the_faces_of_a_cut_collide() {
    for (name, mesh) in severed() {
        let push = || pushed(&mesh, [0.1, 0.0, -0.6], Course::HalfSine { duration: 1.0 });
        let error = |fraction: f64| {
            let settings = Settings {
                time_step: TimeStep::Auto { fraction },
                ..settings(6.0)
            };
            let mut solver = solver(&mesh, push(), settings);
            let (keeper, _) = run(&mut solver);
            let work = last(&keeper.columns, "work");
            assert!(work > 1.0, "{name}: work {work:e}");
            assert!(last(&keeper.columns, "cutoff_release").abs() < 0.1 * work, "{name}");
            solver.ledger().relative_error().expect("work was done")
        };
        let quarter = error(0.25);
        assert!(quarter < ENERGY_ERROR, "{name}: {quarter:e}");
        let eighth = error(0.125);
        assert!(
            eighth < super::AT_HALF_THE_STEP * quarter || eighth < 1e-5,
            "{name}: {quarter:e}, then {eighth:e}"
        );
    }
}

#[test]
fn a_severed_solid_goes_on_from_a_checkpoint_with_the_same_bits() {
    for (name, mesh) in severed() {
        let push = || pushed(&mesh, [0.3, 0.0, -1.0], Course::HalfSine { duration: 1.0 });
        let mut whole = solver(&mesh, push(), settings(4.0));
        run(&mut whole);
        let mut first = solver(&mesh, push(), settings(1.5));
        run(&mut first);
        let mut second = solver(&mesh, push(), settings(4.0));
        second.restore(&first.checkpoint()).expect("it is the same solid");
        run(&mut second);
        let [one, other] = [whole.checkpoint(), second.checkpoint()];
        assert_eq!(one.open_interfaces, other.open_interfaces, "{name}");
        assert!(
            one.position == other.position && one.velocity == other.velocity,
            "{name}"
        );
    }
}

#[test]
fn severed_bonds_and_interfaces_are_not_among_those_that_break() {
    for (name, mesh) in severed() {
        let mut solver = solver(
            &mesh,
            pushed(&mesh, [0.0, 0.0, 0.05], Course::Rise { within: 1.0 }),
            settings(0.5),
        );
        let (keeper, _) = run(&mut solver);
        assert_eq!(last(&keeper.columns, "broken_bonds"), 0.0, "{name}");
        assert_eq!(last(&keeper.columns, "open_interfaces"), 0.0, "{name}");
    }
}
