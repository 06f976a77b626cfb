//! Every bit of energy is accounted for in time.

use std::convert::Infallible;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use cgaft::analysis::series::Series;
use cgaft::forces::Summation;
use cgaft::loading::{Grip, Stretching};
use cgaft::mesh::Mesh;
use cgaft::solver::checkpoint::Checkpoint;
use cgaft::solver::{Cost, Moment, Motion, Observer, Progress, Reading, Settings, Solver, TimeStep, Until};

use super::{SMOOTH, block_mesh, smooth};
use crate::verify::specimens::slab;
use crate::verify::table::{Chapter, Gate};

/// Motion so slow leaves central differences an error of 1e-10. The work of the grips summed by any rule poorer than the
/// trapezoidal one would be off by one step in 1e5.
const WHOLE: f64 = 1e-6;
/// At half the limit, while a small slab breaks in two: atoms per edge, and some twice what the fastest motion at the tip
/// leaves: sums taken in another order break the slab in a slightly different way.
const BREAKING: [(u16, f64); 2] = [(1, 1.2e-2), (10, 1.5e-2)];
/// The error falls with the square of the step, so that what is booked wrongly, whatever the step, shows.
const SHORTER: f64 = 0.25;
const STEPS: f64 = 1e5;

/// Keeps the series of a run.
#[derive(Default)]
pub struct Keeper(pub Series);

impl Observer for Keeper {
    type Error = Infallible;
    fn probe(&mut self, reading: &Reading) -> Result<(), Infallible> {
        self.0.probes.push(reading.probe);
        self.0.bonds.extend_from_slice(&reading.bonds);
        Ok(())
    }
    fn snapshot(&mut self, _: &Moment) -> Result<(), Infallible> {
        Ok(())
    }
    fn checkpoint(&mut self, _: &Checkpoint, _: &Motion<2>, _: &Cost) -> Result<(), Infallible> {
        Ok(())
    }
    fn progress(&mut self, _: &Progress) {}
}

pub fn solver(mesh: Mesh, rate: f64, fraction: f64, until: Until, probe_every: f64) -> Solver {
    let loading = Stretching::new(&mesh, rate, Grip::Clamped, true);
    let settings = Settings {
        time_step: TimeStep::Auto { fraction },
        summation: Summation::Exact,
        consistent_mass: 0.0,
        relax: false,
        noise: None,
        refine: None,
        until,
        probe_every,
        snapshot_every: None,
        checkpoint_every: Duration::from_secs(86_400),
        thickness: 1.0,
    };
    Solver::new(mesh, smooth(), loading, settings).expect("the run starts")
}

pub fn run(solver: &mut Solver) -> Series {
    let mut keeper = Keeper::default();
    solver
        .run(&mut keeper, &AtomicBool::new(false))
        .expect("the run ends well");
    keeper.0
}

#[test]
fn the_energy_of_an_uncracked_slab_closes_over_a_hundred_thousand_steps() {
    let mut gate = Gate::new(Chapter::Motion, "1 ledger");
    for (element, rows, triangles) in [(10, 6, 9), (1, 4, 3)] {
        let mesh = block_mesh(10, rows, triangles, element, smooth().spacing);
        let until = |time: f64| Until {
            time: Some(time),
            ..Until::default()
        };
        let step = solver(mesh.clone(), 1e-6, 0.25, until(1.0), 1.0).time_step()[0];
        let time = STEPS * step;
        let mut solver = solver(mesh, 0.02 / time, 0.25, until(time), 50.0 * step);
        let series = run(&mut solver);
        assert!(
            series.bonds.is_empty() && solver.step_count() >= 99_999,
            "it stays whole for all steps"
        );
        let error = solver.ledger().relative_error().expect("work was done");
        let setting = format!("{SMOOTH}, n = {element}, a quarter of the limit, strain 0.02");
        gate.below("energy error over the work, 1e5 steps", &setting, error, WHOLE);
    }
    gate.close();
}

#[test]
fn the_energy_closes_while_a_crack_runs() {
    let mut gate = Gate::new(Chapter::Motion, "2 ledger with a crack");
    for (element, breaking) in BREAKING {
        for (shorter, step) in [
            (1.0, "time-step auto (half the limit)"),
            (SHORTER, "an eighth of the limit"),
        ] {
            let until = Until {
                strain: Some(0.06),
                ..Until::default()
            };
            let slab = slab(element, vec![], smooth().spacing);
            let mut solver = solver(slab, 2e-4, 0.5 * shorter, until, 1.0);
            let series = run(&mut solver);
            assert!(series.bonds.len() > 20, "it breaks");
            let error = solver.ledger().relative_error().expect("work was done");
            let setting = format!("{SMOOTH}, n = {element}, {step}");
            let limit = breaking * shorter * shorter;
            gate.below("energy error over the work", &setting, error, limit);
        }
    }
    gate.close();
}
