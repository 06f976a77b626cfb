//! Elements that become atoms while the specimen moves.

use std::convert::Infallible;
use std::sync::atomic::{AtomicBool, Ordering};

use cgaft::analysis::series::{BondEvent, Probe};
use cgaft::forces::Forces;
use cgaft::integrator;
use cgaft::mesh::Mesh;
use cgaft::mesh::cut::Crack;
use cgaft::mesh::sites::Layout;
use cgaft::potential::AtCutoff;
use cgaft::solver::checkpoint::Checkpoint;
use cgaft::solver::{Cost, Moment, Motion, Observer, Progress, Reading, Refine, Settings, Solver, SolverError, Until};
use cgaft::state::State;

use super::super::specimens::slab;
use super::{Keeper, lennard_jones, nearest_neighbours, run, settings, solver};

/// Rounding of sums over some thousand atoms.
const ROUNDING: f64 = 1e-12;

/// At half of the stability limit, of a slab that breaks at a high rate, over the work.
const ENERGY_ERROR: f64 = 0.02;

/// What central differences leave of the energy at this step, and of angular momentum, which they keep to rounding.
const OF_THE_STEPS: f64 = 1e-4;

/// Kinetic and potential energy, momentum along x and y, and angular momentum.
fn totals(forces: &mut Forces, state: &State) -> [f64; 5] {
    let potential = forces
        .measure(&state.position)
        .expect("nothing flies away")
        .energy(forces.domain());
    let mesh = forces.mesh();
    let mut sums = [state.kinetic_energy(), potential, 0.0, 0.0, 0.0];
    for (number, element) in mesh.elements.iter().enumerate() {
        for local in element.locals() {
            let shares = element.shape_functions(local);
            let carried = |planes: &[Vec<f64>; 2]| {
                planes.each_ref().map(|plane| {
                    let nodes = mesh.nodes_of(number).zip(shares);
                    nodes.map(|(node, share)| share * plane[node]).sum::<f64>()
                })
            };
            let ([x, y], [u, v]) = (carried(&state.position), carried(&state.velocity));
            let terms = [u, v, x * v - y * u].map(|term| forces.material().site_mass * term);
            sums[2..].iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
        }
    }
    sums
}

fn fly(forces: &mut Forces, state: &mut State, steps: u32) {
    const STEP: f64 = 0.005;
    let nodes = forces.domain().nodes();
    forces
        .compute(&mut state.position, &mut state.force)
        .expect("nothing flies away");
    for _ in 0..steps {
        integrator::kick_and_drift(state, &nodes, integrator::leap(1, STEP));
        forces
            .compute(&mut state.position, &mut state.force)
            .expect("nothing flies away");
        integrator::kick(state, &nodes, 0.5 * STEP);
    }
}

#[test]
fn a_rotating_stretching_slab_refined_in_flight_keeps_its_energies_and_its_momenta() {
    let material = lennard_jones(1.9, AtCutoff::Smooth { from: 1.5 });
    let mesh = slab(10, vec![], material.spacing);
    let mut state = State::of_mesh(&mesh, material.site_mass, 1.0);
    let middle = mesh.middle_height();
    for node in 0..state.nodes() {
        let [x, y] = [state.position[0][node] - middle, state.position[1][node] - middle];
        state.velocity[0][node] = -0.02 * y + 0.002 * x;
        state.velocity[1][node] = 0.02 * x + 0.004 * y;
    }
    let mut forces = Forces::new(mesh.clone(), material);
    let start = totals(&mut forces, &state);
    fly(&mut forces, &mut state, 300);
    let before = totals(&mut forces, &state);
    let refined: Vec<u32> = (0..mesh.triangles as u32).filter(|number| number % 3 != 1).collect();
    let finer = mesh.refined(&refined);
    let mut next = state.carried(&mesh, &finer, material.site_mass, 1.0);
    forces.go_over_to(finer);
    let after = totals(&mut forces, &next);
    for (before, after) in before.iter().zip(after) {
        assert!(
            (after - before).abs() < ROUNDING * before.abs().max(1.0),
            "{before} {after}"
        );
    }
    fly(&mut forces, &mut next, 300);
    let end = totals(&mut forces, &next);
    let energy = |totals: [f64; 5]| totals[0] + totals[1];
    let put_in = start[0];
    assert!(
        (energy(end) - energy(start)).abs() < OF_THE_STEPS * put_in,
        "{start:?} {end:?}"
    );
    assert!((end[4] / start[4] - 1.0).abs() < ROUNDING * 600.0, "{start:?} {end:?}");
}

/// Of a slab that breaks within a second.
fn refined(error: f64) -> Settings {
    Settings {
        consistent_mass: 1.0,
        refine: Some(Refine { error, ahead: 1 }),
        probe_every: 0.5,
        ..settings(0.06)
    }
}

/// A crack of a quarter of a slab of 12 by 41 blocks.
fn longer(element: u16, spacing: f64) -> Mesh {
    Mesh::new(&cgaft::mesh::Plan {
        layout: Layout {
            block: 10,
            rows: 12,
            triangles: 41,
        },
        element,
        regions: vec![],
        crack: Some(Crack::of_length(60.0)),
        grip_rows: 10,
        spacing,
    })
}

/// The probe at which the crack has come ten spacings farther.
fn start(keeper: &Keeper) -> &Probe {
    let is_ahead = |event: &BondEvent| {
        let x = f64::from(event.column) + 0.5 * f64::from(event.row);
        event.broken && x > 70.0 && (event.row - 59).abs() < 2
    };
    let first = keeper.bonds.iter().find(|event| is_ahead(event));
    &keeper.probes[first.expect("the crack runs").probe as usize]
}

/// Probes are 5e-4 of strain apart, of 0.02 at which the crack starts.
const AS_ATOMS: f64 = 0.05;

#[test]
fn a_crack_starts_in_a_refined_mesh_as_in_atoms_and_later_in_elements_and_the_ledger_closes() {
    let material = nearest_neighbours();
    let of = |element: u16, settings: Settings| {
        let mut solver = solver(longer(element, material.spacing), material, settings);
        let (keeper, _) = run(&mut solver);
        let error = solver.ledger().relative_error().expect("work was done");
        (*start(&keeper), error, keeper)
    };
    // A crack of 60 spacings that has come 25 farther tells enough.
    let short = |settings: Settings| Settings {
        until: Until {
            crack_length: Some(85.0 * material.spacing),
            ..settings.until
        },
        ..settings
    };
    let atoms = of(1, short(settings(0.06))).0.strain;
    let (found, error, keeper) = of(10, short(refined(0.02)));
    let coarse = of(10, settings(0.06)).0.strain;
    assert!(
        (found.strain / atoms - 1.0).abs() < AS_ATOMS,
        "{} in atoms {atoms}",
        found.strain
    );
    assert!(coarse > 1.2 * atoms, "{coarse} in atoms {atoms}");
    assert!(found.nodes > 2.0 * keeper.probes[0].nodes, "{} nodes", found.nodes);
    assert_eq!(found.outruns, 0.0, "the crack was there first");
    let last = keeper.probes.last().expect("there are probes");
    assert!(
        last.refined_energy.abs() < 1e-9 * last.work,
        "{:e}",
        last.refined_energy
    );
    assert!(error < ENERGY_ERROR, "energy error {error:e}");
}

/// Stops a run at the first probe from a time on.
struct StopFrom<'a>(f64, &'a AtomicBool, Option<Checkpoint>);

impl Observer for StopFrom<'_> {
    type Error = Infallible;
    fn probe(&mut self, reading: &Reading) -> Result<(), Infallible> {
        self.1.store(reading.probe.time >= self.0, Ordering::Relaxed);
        Ok(())
    }
    fn snapshot(&mut self, _: &Moment) -> Result<(), Infallible> {
        Ok(())
    }
    fn checkpoint(&mut self, checkpoint: &Checkpoint, motion: &Motion<2>, _: &Cost) -> Result<(), Infallible> {
        self.2 = Some(motion.complete(checkpoint));
        Ok(())
    }
    fn progress(&mut self, _: &Progress) {}
}

#[test]
fn a_refined_run_ends_with_the_same_bits_wherever_it_is_left_and_on_any_number_of_threads() {
    let material = nearest_neighbours();
    let new = || solver(slab(10, vec![], material.spacing), material, refined(0.05));
    let mut whole = new();
    let (kept, _) = run(&mut whole);
    let whole = whole.checkpoint();
    assert!(!whole.kept.refined.is_empty(), "nothing was refined");
    assert!(
        kept.probes
            .windows(2)
            .filter(|pair| pair[0].nodes != pair[1].nodes)
            .count()
            > 2
    );
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build();
    let pool = pool.expect("threads can be started");
    let mut solver = new();
    for from in [5.0, 12.0, 20.0, 21.0, 22.5, 24.0, 30.0] {
        let stop = AtomicBool::new(false);
        let mut observer = StopFrom(from, &stop, None);
        pool.install(|| solver.run(&mut observer, &stop))
            .expect("the run goes well");
        solver = new();
        solver
            .restore(&observer.2.expect("a checkpoint"))
            .expect("it is its own");
    }
    let (_, _) = run(&mut solver);
    assert!(solver.checkpoint() == whole);
}

#[test]
fn a_checkpoint_with_another_list_of_refined_elements_changes_nothing() {
    let material = nearest_neighbours();
    let mut solver: Solver = solver(slab(10, vec![], material.spacing), material, refined(0.05));
    let before = solver.checkpoint();
    // A grip's triangle, one that is not there, and one whose nodes are not.
    for refined in [vec![0], vec![100_000], vec![20]] {
        let mut foreign = before.clone();
        foreign.kept.refined = refined;
        let refused = solver.restore(&foreign);
        assert!(matches!(refused, Err(SolverError::OtherSpecimen(_))), "{refused:?}");
        assert!(solver.checkpoint() == before);
    }
}
