//! Steps that nobody looks at: nodes move on with their forces.

use cgaft::potential::AtCutoff;
use cgaft::solver::Settings;

use super::{all_meshes, lennard_jones, nearest_neighbours, settings, solver};

#[test]
fn steps_that_nobody_looks_at_have_the_same_bits_on_any_number_of_threads_while_the_specimen_breaks() {
    const STEPS: u64 = 120;
    const ROUNDS: usize = 12;
    for material in [nearest_neighbours(), lennard_jones(1.9, AtCutoff::Smooth { from: 1.5 })] {
        for (name, mesh) in all_meshes(material.spacing) {
            for consistent_mass in [0.0, 0.65] {
                let settings = Settings {
                    consistent_mass,
                    ..settings(0.08)
                };
                let new = || solver(mesh.clone(), material, settings.clone());
                let [mut looked_at, mut alone, mut threaded] = [new(), new(), new()];
                let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build();
                let pool = pool.expect("threads can be started");
                for round in 0..ROUNDS {
                    (0..STEPS).for_each(|_| looked_at.advance().expect("the step is stable"));
                    alone.advance_by(STEPS).expect("the step is stable");
                    pool.install(|| threaded.advance_by(STEPS)).expect("the step is stable");
                    let label = format!("{name}, {consistent_mass} consistent, round {round}");
                    assert!(looked_at.checkpoint() == alone.checkpoint(), "{label}");
                    assert!(looked_at.checkpoint() == threaded.checkpoint(), "{label}, threads");
                }
                let opened = looked_at.checkpoint().open_interfaces.len();
                let has_triangles = looked_at.mesh().triangles > 0;
                assert!(!has_triangles || opened > 0, "{name}: nothing broke");
            }
        }
    }
}
