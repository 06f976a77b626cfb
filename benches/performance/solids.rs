//! Solids: a step in blocks, in atoms beside LAMMPS, and what comes before the first step.

use cgaft::domain::Ranks;
use cgaft::setup;
use cgaft::solver::{Solid, Solver};

use super::demand::{self, Demand};
use super::steps::MILLIONS;
use super::{clock, commands, peer, specimens};

/// Steps of a sample, and how many samples there are.
const STEPS: u64 = 100;
const SAMPLES: usize = 5;

pub fn measure() {
    let most = |most: f64, aim: f64| Demand::Below { most, aim: Some(aim) };
    let least = |least: f64, aim: f64| Demand::AtLeast { least, aim };
    let film = clock::with_threads(1, || {
        let mut film = solver("film");
        1e-6 * film.setting().represented_atoms as f64 / seconds_of_a_step(&mut film)
    });
    demand::record(demand::SOLID_STEP, film, MILLIONS, least(1500.0, 4000.0));
    let (set_up, step) = clock::with_threads(1, || {
        let mut bar = None;
        let set_up = clock::median_of(SAMPLES, || clock::core_seconds(|| bar = Some(solver("bar"))));
        (set_up, seconds_of_a_step(bar.as_mut().expect("it is set up")))
    });
    demand::record(demand::BAR_STEP, step, commands::SECONDS, most(0.01, 0.003));
    demand::record(demand::BAR_SET_UP, set_up, commands::SECONDS, most(0.5, 0.1));
    let ratio = peer::in_turns("solids", "lammps-solid", our_seconds);
    demand::record(demand::SOLID_PEER, ratio, "times", least(1.5, 3.0));
}

fn solver(name: &str) -> Solver<Solid, 3> {
    let case = specimens::case("solids", name);
    let solid = case.solid().expect("it is a solid");
    setup::solid::solver(&case, solid, Ranks::alone()).expect("the case starts")
}

fn seconds_of_a_step(solver: &mut Solver<Solid, 3>) -> f64 {
    let sample = || clock::core_seconds(|| solver.advance_by(STEPS).expect("the step is stable")) / STEPS as f64;
    clock::median_of(SAMPLES, sample)
}

/// Seconds of a core that so many steps of the atoms take, and how many atoms there are.
fn our_seconds(steps: u32) -> [f64; 2] {
    clock::with_threads(1, || {
        let mut solver = solver("atoms");
        let work = || solver.advance_by(u64::from(steps)).expect("the step is stable");
        [clock::core_seconds(work), solver.setting().represented_atoms as f64]
    })
}
