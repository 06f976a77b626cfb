//! Steps near the stability limit, which follow the bonds.

use cgaft::forces::Forces;
use cgaft::potential::AtCutoff;
use cgaft::solver::{Settings, TimeStep};
use cgaft::state::State;

use super::super::specimens::{Noise, slab};
use super::{all_meshes, lennard_jones, nearest_neighbours, run, settings, solver};

/// What a small slab that is torn at a high rate may lose of the work at nine tenths of the limit; 0.8 % is measured. At a quarter it
/// is [`super::ENERGY_ERROR`].
const ENERGY_ERROR: f64 = 0.01;

fn long(fraction: f64) -> Settings {
    Settings {
        time_step: TimeStep::Auto { fraction },
        ..settings(0.1)
    }
}

#[test]
fn steps_of_nine_tenths_of_the_limit_hold_while_every_mesh_breaks() {
    for material in [nearest_neighbours(), lennard_jones(1.9, AtCutoff::Smooth { from: 1.5 })] {
        for (name, mesh) in all_meshes(material.spacing) {
            let mut solver = solver(mesh, material, long(0.9));
            run(&mut solver);
            let error = solver.ledger().relative_error().expect("work is done");
            assert!(error < ENERGY_ERROR, "{name}: energy error {error:e}");
        }
    }
}

#[test]
fn a_restart_with_a_time_step_that_follows_the_bonds_goes_on_to_the_bit() {
    const STEPS: u64 = 1200;
    let material = nearest_neighbours();
    for (name, mesh) in all_meshes(material.spacing) {
        let new = || solver(mesh.clone(), material, long(0.95));
        let mut whole = new();
        whole.advance_by(STEPS).expect("the steps are stable");
        let mut changes = 0;
        for stop in [400, 401, 419, 420, 777] {
            let mut first = new();
            first.advance_by(stop).expect("the steps are stable");
            changes += u32::from(first.time_step()[0] < new().time_step()[0]);
            let mut second = new();
            second.restore(&first.checkpoint()).expect("it is the same specimen");
            second.advance_by(STEPS - stop).expect("the steps are stable");
            assert!(
                second.checkpoint() == whole.checkpoint(),
                "{name}, stopped after {stop} steps"
            );
        }
        assert!(changes > 0, "{name}: the time step has never changed");
    }
}

#[test]
fn close_bonds_of_atoms_add_no_more_to_the_highest_frequency_than_is_said() {
    const AMPLITUDE: f64 = 0.12;
    const NEARLY_CLOSE: f64 = 0.9401;
    let material = nearest_neighbours();
    let mesh = slab(1, vec![], material.spacing);
    let masses = mesh.lumped_masses().into_iter().map(|mass| mass * material.site_mass);
    let mut state = State::at_rest(mesh.node_positions(), masses.collect());
    let mut forces = Forces::new(mesh, material);
    let mut bounds = |state: &State| {
        let [mut position, mut force] = [state.position.clone(), state.force.clone()];
        forces.compute(&mut position, &mut force).expect("positions are sound");
        [
            forces.squared_frequency_bound(state),
            forces.close_bonds().squared_frequency(),
        ]
    };
    // All bonds as short as bonds may be that are not close.
    state.position.iter_mut().flatten().for_each(|x| *x *= NEARLY_CLOSE);
    let [before, none] = bounds(&state);
    let mut noise = Noise(17);
    for x in state.position.iter_mut().flatten() {
        *x += AMPLITUDE * material.spacing * noise.next();
    }
    let [found, added] = bounds(&state);
    assert!(none == 0.0 && found > before, "{none}, {found} from {before}");
    assert!(found <= before + added, "{found} above {before} and {added}");
}
