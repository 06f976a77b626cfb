//! What a run is made of, each against a right value that is found in another way.

use std::convert::Infallible;
use std::sync::atomic::AtomicBool;

use cgaft::forces::Summation;
use cgaft::integrator;
use cgaft::lattice::triangular;
use cgaft::loading::{Grip, Stretching};
use cgaft::mesh::Mesh;
use cgaft::solver::checkpoint::Checkpoint;
use cgaft::solver::{Cost, Moment, Motion, Observer, Progress, Reading, Settings, Solver};
use cgaft::state::State;

use super::super::specimens::{Noise, nearest_neighbours, slab};
use super::{ENERGY_ERROR, run, settings, slab_of_whole_triangles, solver};

/// Rounding of sums of some thousand numbers.
const ROUNDING: f64 = 1e-10;

/// Counts pairs of atoms within the cutoff, one by one.
struct Counter {
    cutoff: f64,
    pairs: Vec<u32>,
    released: f64,
}

impl Counter {
    fn count(&self, mesh: &Mesh, state: &State) -> u32 {
        let [x, y] = &state.position;
        let sites: Vec<[i32; 2]> = mesh
            .elements
            .iter()
            .map(|element| [element.column, element.row])
            .collect();
        let within = |a: usize, b: usize| (x[a] - x[b]).powi(2) + (y[a] - y[b]).powi(2) < self.cutoff.powi(2);
        let of = |a: usize| {
            (0..a)
                .filter(|&b| within(a, b) && !mesh.severed(sites[a], sites[b]))
                .count() as u32
        };
        (0..x.len()).map(of).sum()
    }
}

impl Observer for Counter {
    type Error = Infallible;
    fn probe(&mut self, reading: &Reading) -> Result<(), Infallible> {
        self.released = reading.probe.cutoff_release;
        Ok(())
    }
    fn snapshot(&mut self, moment: &Moment) -> Result<(), Infallible> {
        self.pairs.push(self.count(moment.mesh, moment.state));
        Ok(())
    }
    fn checkpoint(&mut self, _: &Checkpoint, _: &Motion<2>, _: &Cost) -> Result<(), Infallible> {
        Ok(())
    }
    fn progress(&mut self, _: &Progress) {}
}

#[test]
fn truncation_releases_the_energy_of_every_pair_that_leaves() {
    let material = nearest_neighbours();
    let mut solver = solver(slab(1, vec![], material.spacing), material, settings(0.046));
    // [Deng2011] cuts 4 (s^-12 - s^-6) where it is not zero: every pair that leaves takes that along.
    let cutoff: f64 = 0.34 / 0.2277;
    let at_cutoff = 4.0 * (cutoff.powi(-12) - cutoff.powi(-6));
    let mut counter = Counter {
        cutoff,
        pairs: Vec::new(),
        released: 0.0,
    };
    solver
        .run(&mut counter, &AtomicBool::new(false))
        .expect("the run ends well");
    let [first, last] = [counter.pairs[0], counter.pairs[counter.pairs.len() - 1]].map(f64::from);
    assert!(first - last > 10.0, "{first} {last}");
    let expected = at_cutoff * (last - first);
    let error = counter.released / expected - 1.0;
    assert!(error.abs() < ROUNDING, "{} for {expected}", counter.released);
    let error = solver.ledger().relative_error().unwrap();
    assert!(error < ENERGY_ERROR, "energy error {error:e}");
}

/// How stiff an uncracked slab is if only the bonds of nodes count, over what it is: 2.20 against 3.92 GPa at 1 %. The share
/// of the elements at grips and sides, and so the ratio, depends on the slab.
const NODAL_STIFFNESS: f64 = 2.20 / 3.92;
const OTHER_SLAB: f64 = 0.05;

#[test]
fn bonds_of_nodes_only_leave_a_slab_little_more_than_half_of_its_stiffness() {
    let material = nearest_neighbours();
    let [exact, nodal] = [Summation::Exact, Summation::Nodal].map(|summation| {
        let settings = Settings {
            summation,
            ..settings(0.01)
        };
        let mesh = slab_of_whole_triangles(10, 10, material.spacing);
        let (keeper, _) = run(&mut solver(mesh, material, settings));
        keeper.probes.last().expect("there are probes").sigma_yy
    });
    assert!(
        (nodal / exact - NODAL_STIFFNESS).abs() < OTHER_SLAB,
        "{nodal} over {exact}"
    );
}

#[test]
fn a_blow_gives_every_triangle_the_momentum_that_its_consistent_masses_say() {
    for size in [2u16, 3, 4, 7, 10] {
        let mesh = slab_of_whole_triangles(size.max(3), size, 1.0);
        let mut state = State::at_rest(mesh.node_positions(), mesh.lumped_masses());
        state.couple_masses(&mesh, 1.0);
        let mut noise = Noise(u64::from(size));
        state.force.iter_mut().flatten().for_each(|force| *force = noise.next());
        let nodes = state.every_node();
        integrator::kick(&mut state, &nodes, 0.5);
        for (triangle, element) in mesh.elements[..mesh.triangles].iter().enumerate() {
            // [Deng2011] Eq. (3-29) before it is lumped: M_ij = m sum_a N_i(a) N_j(a), site by site.
            let shapes: Vec<[f64; 3]> = element.locals().map(|local| element.shape_functions(local)).collect();
            let nodes = mesh.corners_of(triangle);
            for axis in 0..2 {
                let [velocity, force] =
                    [&state.velocity, &state.force].map(|planes| nodes.map(|node| planes[axis][node]));
                for (i, force) in force.iter().enumerate() {
                    let mass = |j: usize| shapes.iter().map(|shape| shape[i] * shape[j]).sum::<f64>();
                    let momentum: f64 = (0..3).map(|j| mass(j) * velocity[j]).sum();
                    let error = momentum - 0.5 * force;
                    assert!(error.abs() < ROUNDING, "n = {}: {error:e}", element.size);
                }
            }
        }
    }
}

#[test]
fn the_grip_stress_is_the_force_of_the_bonds_at_the_grips_over_the_mean_length_of_the_rows() {
    const STRAIN: f64 = 0.01;
    let material = nearest_neighbours();
    for element in [1u16, 10] {
        let mesh = slab_of_whole_triangles(10, element, material.spacing);
        let [sites, rows] = [mesh.sites.len() as f64, f64::from(mesh.sites.rows())];
        // Bonds between the highest row of the lower grip and the row above it; both go half a spacing to a side.
        let (grip, above) = (mesh.sites.columns(9), mesh.sites.columns(10));
        let bonds = grip
            .flat_map(|column| [column, column - 1])
            .filter(|upper| above.contains(upper));
        let bonds = bonds.count() as f64;
        let [half, row] = [0.5 * material.spacing, triangular::ROW_HEIGHT * material.spacing];
        let height = row * (1.0 + STRAIN);
        let length = half.hypot(height);
        let pull = (-48.0 * length.powi(-13) + 24.0 * length.powi(-7)) * height / length;
        let expected = bonds * pull / (sites / rows * material.spacing);
        let loading = Stretching::new(&mesh, 1e-3, Grip::Clamped, true).from_strain(STRAIN);
        let mut solver = Solver::new(mesh, material, loading, settings(STRAIN + 1e-4)).unwrap();
        let (kept, _) = run(&mut solver);
        let start = kept.probes[0];
        let error = start.grip_stress / expected - 1.0;
        assert!(
            error.abs() < ROUNDING,
            "n = {element}: {} for {expected}",
            start.grip_stress
        );
    }
}
