//! Steps of the intact mesh, the same on two threads, and what comes before the first step.

use super::demand::{self, Demand};
use super::specimens;
use super::{clock, commands};

/// What a represented atom-step a second is counted in.
pub const MILLIONS: &str = "million atom-steps a core-second";

pub fn measure() {
    let demands = [
        ("elements-7M", demand::STEP_EXACT, 800.0, 2000.0),
        ("elements-7M-gauss2", demand::STEP_GAUSS, 2000.0, 6000.0),
    ];
    for (case, row, least, aim) in demands {
        let rate = specimens::measure(case, 1.0).rate();
        demand::record(row, rate, MILLIONS, Demand::AtLeast { least, aim });
    }
    measure_threads();
}

/// Two threads on one specimen, then one thread on each of two of its kind at once, in turns.
fn measure_threads() {
    const STEPS: u64 = 200;
    const TURNS: usize = 7;
    let new = || specimens::solver("specimens", "elements-1M");
    let mut solvers = [new(), new()];
    let advance = |solver: &mut cgaft::solver::Solver| {
        solver.advance_by(STEPS).expect("the step is stable");
    };
    let ratio = || {
        let [first, second] = &mut solvers;
        let together = clock::wall_seconds(|| clock::with_threads(2, || advance(first)));
        let beside = clock::wall_seconds(|| {
            std::thread::scope(|scope| {
                for solver in [first, second] {
                    scope.spawn(|| clock::with_threads(1, || advance(solver)));
                }
            });
        });
        // The two did twice the work.
        beside / (2.0 * together)
    };
    let ratio = clock::median_of(TURNS, ratio);
    demand::record(
        demand::THREADS,
        ratio,
        "of their speed",
        Demand::AtLeast { least: 0.95, aim: 0.99 },
    );
}

/// Mesh, interfaces, neighbours and first forces.
pub fn measure_set_up() {
    let set_up = |case: &str| {
        let case = specimens::case("specimens", case);
        clock::with_threads(1, || {
            let mut elements = 0;
            let once = || {
                clock::core_seconds(|| {
                    let solver =
                        cgaft::setup::slab::solver(&case, case.slab().expect("it is a slab")).expect("the case starts");
                    elements = solver.mesh().elements.len();
                })
            };
            let seconds = clock::median_of(5, once);
            (seconds, seconds / elements as f64)
        })
    };
    let [small, large] = ["elements-1M", "elements-7M"].map(set_up);
    let most = Demand::Below {
        most: 2.0,
        aim: Some(0.5),
    };
    demand::record(demand::SET_UP, large.0, commands::SECONDS, most);
    // Linear, but for caches that the large specimen does not fit into.
    let linear = Demand::Below { most: 1.5, aim: None };
    demand::record(demand::SET_UP_GROWTH, large.1 / small.1, "times", linear);
}
