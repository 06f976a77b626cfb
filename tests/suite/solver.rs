//! The run in time: conservation, stability, restart.

mod ahead;
mod damped;
mod energy;
mod exploding;
mod factors;
mod long_steps;
mod parted;
mod pulsed;
mod refined;
mod relaxed;

use std::convert::Infallible;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use cgaft::analysis::series::{BondEvent, Probe};
use cgaft::forces::Summation;
use cgaft::loading::{Grip, Stretching};
use cgaft::material::Material;
use cgaft::mesh::Mesh;
use cgaft::potential::AtCutoff;
use cgaft::solver::checkpoint::Checkpoint;
use cgaft::solver::{
    Cost, Ending, Moment, Motion, Observer, Progress, Reading, Settings, Solver, SolverError, TimeStep, Until,
};

use super::specimens::{all_meshes, lennard_jones, nearest_neighbours, slab};

/// Keeps everything a run gives.
#[derive(Default)]
struct Keeper {
    probes: Vec<Probe>,
    bonds: Vec<BondEvent>,
    snapshots: Vec<u64>,
    checkpoints: Vec<Checkpoint>,
}

impl Observer for Keeper {
    type Error = Infallible;
    fn probe(&mut self, reading: &Reading) -> Result<(), Infallible> {
        self.probes.push(reading.probe);
        self.bonds.extend_from_slice(&reading.bonds);
        Ok(())
    }
    fn snapshot(&mut self, moment: &Moment) -> Result<(), Infallible> {
        self.snapshots.push(moment.step);
        Ok(())
    }
    fn checkpoint(&mut self, checkpoint: &Checkpoint, motion: &Motion<2>, _: &Cost) -> Result<(), Infallible> {
        self.checkpoints.push(motion.complete(checkpoint));
        Ok(())
    }
    fn progress(&mut self, _: &Progress) {}
}

/// Mode I at 1e-3 per unit of time to this strain.
fn settings(strain: f64) -> Settings {
    Settings {
        time_step: TimeStep::Auto { fraction: 0.5 },
        summation: Summation::Exact,
        consistent_mass: 0.0,
        refine: None,
        relax: false,
        noise: None,
        until: Until {
            strain: Some(strain),
            ..Until::default()
        },
        probe_every: 1.0,
        snapshot_every: Some(10.0),
        checkpoint_every: Duration::from_secs(3600),
        thickness: 1.0,
    }
}

fn solver(mesh: Mesh, material: Material, settings: Settings) -> Solver {
    let loading = Stretching::new(&mesh, 1e-3, Grip::Clamped, true);
    Solver::new(mesh, material, loading, settings).expect("the run starts")
}

fn run(solver: &mut Solver) -> (Keeper, Ending) {
    let mut keeper = Keeper::default();
    let ending = solver
        .run(&mut keeper, &AtomicBool::new(false))
        .expect("the run ends well");
    (keeper, ending)
}

#[test]
fn a_run_probes_at_equal_times_and_ends_at_its_strain() {
    let material = nearest_neighbours();
    let mut solver = solver(slab(10, vec![], material.spacing), material, settings(0.02));
    let (keeper, ending) = run(&mut solver);
    let Ending::Strain(strain) = ending else {
        panic!("{ending}")
    };
    assert!((strain - 0.02).abs() < 1e-3 * solver.time_step()[0]);
    assert_eq!(keeper.probes.len(), 21);
    assert_eq!(keeper.probes.last().unwrap().step, solver.step_count());
    assert_eq!(keeper.snapshots.len(), 3, "at the start, after 10 and at the end");
    for (number, probe) in keeper.probes.iter().enumerate() {
        assert!((probe.time - number as f64).abs() <= 0.5001 * solver.time_step()[0]);
    }
}

/// Central differences at a quarter of the stability limit lose this much of the work while a small slab breaks at a high rate.
const ENERGY_ERROR: f64 = 5e-3;
const QUARTER: TimeStep = TimeStep::Auto { fraction: 0.25 };

/// What is left of it at half of a given step: a quarter, and some more or less because parts collide otherwise. An automatic step
/// is shorter while they do, and then is not halved.
const AT_HALF_THE_STEP: f64 = 0.4;

#[test]
fn the_ledger_closes_on_every_mesh_while_the_specimen_breaks() {
    let material = lennard_jones(1.9, AtCutoff::Smooth { from: 1.5 });
    for (name, mesh) in all_meshes(material.spacing) {
        let error = |time_step: TimeStep| {
            let settings = Settings {
                time_step,
                ..settings(0.08)
            };
            let mut solver = solver(mesh.clone(), material, settings);
            let (keeper, _) = run(&mut solver);
            assert!(keeper.bonds.iter().any(|event| event.broken), "{name}: nothing broke");
            solver.ledger().relative_error().unwrap()
        };
        let [_, limit] = solver(mesh.clone(), material, settings(0.08)).time_step();
        let quarter = error(TimeStep::Given(0.25 * limit));
        assert!(quarter < ENERGY_ERROR, "{name}: energy error {quarter:e}");
        let eighth = error(TimeStep::Given(0.125 * limit));
        assert!(
            eighth < AT_HALF_THE_STEP * quarter,
            "{name}: energy error {quarter:e}, then {eighth:e}"
        );
    }
}

#[test]
fn the_ledger_closes_for_every_rule_of_summation_and_every_mass_matrix() {
    let material = lennard_jones(1.9, AtCutoff::Smooth { from: 1.5 });
    let rules = [
        Summation::Exact,
        Summation::Gauss { points: 2 },
        Summation::StrictGauss { points: 2 },
        Summation::Nodal,
    ];
    for summation in rules {
        for consistent_mass in [0.0, 0.65, 1.0] {
            let settings = Settings {
                time_step: TimeStep::Auto { fraction: 0.25 },
                summation,
                consistent_mass,
                ..settings(0.08)
            };
            let mut solver = solver(slab(10, vec![], material.spacing), material, settings);
            let (keeper, _) = run(&mut solver);
            let label = format!("{summation:?}, {consistent_mass} consistent");
            let broke = keeper.bonds.iter().any(|event| event.broken);
            assert!(broke || summation == Summation::Nodal, "{label}: nothing broke");
            let error = solver.ledger().relative_error().unwrap();
            assert!(error < ENERGY_ERROR, "{label}: energy error {error:e}");
        }
    }
}

#[test]
fn a_run_from_a_checkpoint_ends_with_the_same_bits() {
    for material in [nearest_neighbours(), lennard_jones(1.9, AtCutoff::Smooth { from: 1.5 })] {
        for (name, mesh) in all_meshes(material.spacing) {
            let mut whole = solver(mesh.clone(), material, settings(0.08));
            let (whole_kept, _) = run(&mut whole);
            let mut first = solver(mesh.clone(), material, settings(0.08));
            let mut kept = Keeper::default();
            struct StopAt<'a>(&'a mut Keeper, &'a AtomicBool);
            impl Observer for StopAt<'_> {
                type Error = Infallible;
                fn probe(&mut self, reading: &Reading) -> Result<(), Infallible> {
                    let late = reading.probe.time > 57.5;
                    self.1.store(late, std::sync::atomic::Ordering::Relaxed);
                    self.0.probe(reading)
                }
                fn snapshot(&mut self, moment: &Moment) -> Result<(), Infallible> {
                    self.0.snapshot(moment)
                }
                fn checkpoint(
                    &mut self,
                    checkpoint: &Checkpoint,
                    motion: &Motion<2>,
                    cost: &Cost,
                ) -> Result<(), Infallible> {
                    self.0.checkpoint(checkpoint, motion, cost)
                }
                fn progress(&mut self, _: &Progress) {}
            }
            let stop = AtomicBool::new(false);
            let ending = first.run(&mut StopAt(&mut kept, &stop), &stop).unwrap();
            assert_eq!(ending, Ending::Interrupted);
            let mut second = solver(mesh, material, settings(0.08));
            second.restore(kept.checkpoints.last().unwrap()).unwrap();
            let (rest, _) = run(&mut second);
            kept.probes.extend(rest.probes);
            kept.bonds.extend(rest.bonds);
            kept.snapshots.extend(rest.snapshots);
            assert!(second.checkpoint() == whole.checkpoint(), "{name}: end states differ");
            assert_eq!(
                format!("{:?}", kept.probes),
                format!("{:?}", whole_kept.probes),
                "{name}"
            );
            assert_eq!(kept.bonds, whole_kept.bonds, "{name}");
            assert_eq!(kept.snapshots, whole_kept.snapshots, "{name}");
        }
    }
}

#[test]
fn a_checkpoint_of_another_specimen_is_refused_and_changes_nothing() {
    let material = nearest_neighbours();
    let mut solvers = all_meshes(material.spacing)
        .into_iter()
        .map(|(_, mesh)| solver(mesh, material, settings(0.08)));
    let mut own_solver = solvers.next().unwrap();
    let own = own_solver.checkpoint();
    let nodes = |checkpoint: &Checkpoint| checkpoint.position[0].len();
    let foreign = solvers
        .map(|other| other.checkpoint())
        .find(|other| nodes(other) != nodes(&own));
    let foreign = foreign.expect("meshes of different size");
    let mut interfaces = own.clone();
    interfaces.open_interfaces = vec![u32::MAX];
    let mut bonds = own.clone();
    bonds.kept.broken_bonds = vec![[i32::MAX, i32::MAX, 0]];
    let mut shorter = own.clone();
    shorter.velocity[1].pop();
    for checkpoint in [foreign, interfaces, bonds, shorter] {
        let refused = own_solver.restore(&checkpoint);
        assert!(matches!(refused, Err(SolverError::OtherSpecimen(_))), "{refused:?}");
        assert!(own_solver.checkpoint() == own);
    }
}

#[test]
fn a_step_above_the_stability_limit_is_refused_with_both_numbers() {
    let material = nearest_neighbours();
    let mesh = slab(10, vec![], material.spacing);
    let loading = Stretching::new(&mesh, 1e-3, Grip::Clamped, true);
    let given = Settings {
        time_step: TimeStep::Given(0.5),
        ..settings(0.01)
    };
    let Err(error) = Solver::new(mesh, material, loading, given) else {
        panic!("it must be refused")
    };
    let SolverError::StepTooLong { given, limit } = error else {
        panic!("{error}")
    };
    assert!(given == 0.5 && limit > 0.2 && limit < 0.26, "{limit}");
}

#[test]
fn the_bound_of_the_frequency_is_exact_for_atoms_and_close_for_triangles() {
    // Highest frequencies of the perfect lattice by Bloch analysis, reduced units: atoms sqrt(6 k), then n = 4, 10, 20.
    let material = nearest_neighbours();
    let highest = [(1u16, 18.517), (4, 12.27), (10, 8.21), (20, 5.93)];
    for (element, expected) in highest {
        let mesh = slab_of_whole_triangles(element.max(3), element, material.spacing);
        let loading = Stretching::new(&mesh, 1e-3, Grip::Clamped, true);
        let solver = Solver::new(mesh, material, loading, settings(0.01)).unwrap();
        let found = 2.0 / solver.time_step()[1];
        let excess = found / expected - 1.0;
        assert!(
            (-1e-3..0.25).contains(&excess),
            "n = {element}: {found} against {expected}"
        );
        if element == 1 {
            assert!(excess < 1e-3, "{found}");
        }
    }
}

fn slab_of_whole_triangles(block: u16, element: u16, spacing: f64) -> Mesh {
    let layout = cgaft::mesh::sites::Layout {
        block: i32::from(block),
        rows: 6,
        triangles: 7,
    };
    let grip_rows = i32::from(block);
    Mesh::new(&cgaft::mesh::Plan {
        layout,
        element,
        regions: vec![],
        crack: None,
        grip_rows,
        spacing,
    })
}

#[test]
fn a_blow_up_is_reported_with_step_and_advice() {
    let material = nearest_neighbours();
    let mesh = slab(10, vec![], material.spacing);
    let loading = Stretching::new(&mesh, 1e-3, Grip::Clamped, true);
    let settings = Settings {
        time_step: TimeStep::Auto { fraction: 1.6 },
        ..settings(0.1)
    };
    let mut solver = Solver::new(mesh, material, loading, settings).unwrap();
    let error = solver.run(&mut Keeper::default(), &AtomicBool::new(false)).unwrap_err();
    let text = error.to_string();
    assert!(
        text.starts_with("step ") && text.contains("x = ") && text.contains("try a "),
        "{text}"
    );
}

#[test]
fn a_run_that_stopped_at_its_end_has_nothing_left_to_give() {
    let material = nearest_neighbours();
    let mesh = slab(10, vec![], material.spacing);
    let mut whole = solver(mesh.clone(), material, settings(0.02));
    let (kept, ending) = run(&mut whole);
    let mut again = solver(mesh, material, settings(0.02));
    again.restore(kept.checkpoints.last().unwrap()).unwrap();
    let (rest, same_ending) = run(&mut again);
    assert_eq!(same_ending, ending);
    assert_eq!(
        (rest.probes.len(), rest.snapshots.len(), rest.checkpoints.len()),
        (0, 0, 0)
    );
    assert!(again.checkpoint() == whole.checkpoint());
    assert_eq!(again.time_step(), whole.time_step());
}
