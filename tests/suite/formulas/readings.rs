//! What a probe reads of a specimen whose stress, motion and heat are known in closed form.

use std::convert::Infallible;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use cgaft::analysis::series::Probe;
use cgaft::forces::{Summation, referee};
use cgaft::lattice::triangular::{NEAREST, SITE_AREA, position};
use cgaft::loading::{Grip, Stretching};
use cgaft::material::Material;
use cgaft::mesh::cut::Crack;
use cgaft::mesh::sites::Layout;
use cgaft::mesh::{Mesh, Plan};
use cgaft::potential::AtCutoff;
use cgaft::solver::checkpoint::Checkpoint;
use cgaft::solver::{Cost, Moment, Motion, Observer, Progress, Reading, Settings, Solver, TimeStep, Until};
use cgaft::units::BOLTZMANN_EV_PER_K;

use crate::suite::specimens::{Noise, lennard_jones};

const STRAIN: f64 = 0.01;
const RATE: f64 = 1e-3;
const THICKNESS: f64 = 0.7;
const CRACK: f64 = 40.25;

/// Sums of some hundred bonds.
const ROUNDING: f64 = 1e-9;
/// A patch of some eighty sites has its centre within a fifth of a spacing of its place, some twenty from the crack plane.
const PATCH: f64 = 0.01;
/// Random signs in forty cells of up to 64 atoms, whose mean takes one of them with a scatter of its own.
const FEW_ATOMS: f64 = 0.01;

/// What the first probe gives.
#[derive(Default)]
struct First {
    probe: Option<Probe>,
    profile: Vec<[f64; 3]>,
    gauges: Vec<[f64; 5]>,
}

impl Observer for First {
    type Error = Infallible;
    fn probe(&mut self, reading: &Reading) -> Result<(), Infallible> {
        if self.probe.is_none() {
            self.probe = Some(reading.probe);
            self.profile = reading.profile.to_vec();
            self.gauges = reading.gauges.to_vec();
        }
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

fn material() -> Material {
    lennard_jones(1.9, AtCutoff::Smooth { from: 1.5 })
}

/// Atoms stretched evenly, each with its share of the speed of the grips.
fn stretched() -> Solver {
    let material = material();
    let mesh = Mesh::new(&Plan {
        layout: Layout {
            block: 10,
            rows: 10,
            triangles: 19,
        },
        element: 1,
        regions: vec![],
        crack: Some(Crack::of_length(CRACK)),
        grip_rows: 10,
        spacing: material.spacing,
    });
    let loading = Stretching::new(&mesh, RATE, Grip::Clamped, true).from_strain(STRAIN);
    let settings = Settings {
        time_step: TimeStep::Auto { fraction: 0.5 },
        summation: Summation::Exact,
        consistent_mass: 0.0,
        refine: None,
        relax: false,
        noise: None,
        until: Until {
            time: Some(0.01),
            ..Until::default()
        },
        probe_every: 1.0,
        snapshot_every: None,
        checkpoint_every: Duration::from_secs(3600),
        thickness: THICKNESS,
    };
    Solver::new(mesh, material, loading, settings).unwrap()
}

fn first(solver: &mut Solver) -> First {
    let mut first = First::default();
    solver.run(&mut first, &AtomicBool::new(false)).unwrap();
    first
}

/// Stress yy of the stretched crystal: the three bonds of a site, over its area before.
fn even_stress() -> f64 {
    let material = material();
    let bonds = NEAREST.map(|bond| {
        let [x, y] = position(bond).map(|component| component * material.spacing);
        let y = (1.0 + STRAIN) * y;
        material.interaction.evaluate(x * x + y * y).slope * y * y
    });
    let area = 0.75_f64.sqrt() * material.spacing * material.spacing;
    bonds.iter().sum::<f64>() / (area * THICKNESS)
}

#[test]
fn the_profile_and_the_gauges_of_an_evenly_stretched_crystal_tell_its_stress_and_motion() {
    let mut solver = stretched();
    let first = first(&mut solver);
    let expected = even_stress();
    // Ahead of the notch, and away from the right edge.
    let ahead = solver.profile_x().iter().zip(&first.profile).filter(|(x, _)| {
        let share = **x / solver.setting().length;
        (0.6..0.9).contains(&share)
    });
    let mut bins = 0;
    for (x, stress) in ahead {
        assert!(
            (stress[1] / expected - 1.0).abs() < ROUNDING,
            "{x}: {stress:?} {expected}"
        );
        bins += 1;
    }
    assert!(bins > 5);
    for gauge in [0, 1] {
        let [_, vy, _, yy, _] = first.gauges[gauge];
        let [_, y] = solver.gauge_places()[gauge];
        assert!((yy / expected - 1.0).abs() < ROUNDING, "{yy} {expected}");
        assert!((vy / (RATE * y) - 1.0).abs() < PATCH, "{vy} at {y}");
    }
}

#[test]
fn the_average_stress_is_that_of_all_pairs_between_the_grips() {
    let mut solver = stretched();
    let mesh = solver.mesh().clone();
    let position = solver.state().position.clone();
    let reference = referee::sum_over_all_pairs(&mesh, &material(), &position, Summation::Exact);
    let between = mesh.elements.iter().zip(&reference.virial);
    let between: Vec<[f64; 3]> = between
        .filter(|(element, _)| mesh.grip_of(element) == 0)
        .map(|(_, virial)| *virial)
        .collect();
    let volume = between.len() as f64 * 0.75_f64.sqrt() * mesh.spacing * mesh.spacing * THICKNESS;
    let probe = first(&mut solver).probe.unwrap();
    for (axis, found) in [probe.sigma_xx, probe.sigma_yy].into_iter().enumerate() {
        let expected = between.iter().map(|virial| virial[axis]).sum::<f64>() / volume;
        assert!((found / expected - 1.0).abs() < ROUNDING, "{found} for {expected}");
    }
}

#[test]
fn the_analysis_knows_the_specimen_as_it_was_built() {
    let solver = stretched();
    let (setting, spacing) = (solver.setting(), material().spacing);
    // From row 9, the highest of the lower grip, to row 90, the lowest of the upper one.
    let height = 81.0 * 0.75_f64.sqrt() * spacing;
    assert!((setting.height / height - 1.0).abs() < ROUNDING, "{setting:?}");
    assert!(
        (setting.crack_length / (CRACK * spacing) - 1.0).abs() < ROUNDING,
        "{setting:?}"
    );
    // Ten upright triangles side by side, and nine between them: each has ten sites an edge, and one spacing to the next.
    assert!(
        (setting.length / (110.0 * spacing) - 1.0).abs() < ROUNDING,
        "{setting:?}"
    );
    assert_eq!(setting.thickness, THICKNESS);
    assert!((SITE_AREA - 0.75_f64.sqrt()).abs() < ROUNDING);
}

#[test]
fn atoms_that_move_at_random_with_one_speed_have_the_temperature_of_that_speed() {
    // [Deng2011] Eq. (3-22), with two directions: m v^2/2 is k T/2 in each.
    const SPEED: f64 = 0.05;
    let mut solver = stretched();
    let mut checkpoint = solver.checkpoint();
    let mut noise = Noise(9);
    for plane in &mut checkpoint.velocity {
        plane
            .iter_mut()
            .for_each(|speed| *speed = SPEED * noise.next().signum());
    }
    checkpoint.start[2] = SPEED * SPEED * checkpoint.velocity[0].len() as f64;
    solver.restore(&checkpoint).unwrap();
    let found = first(&mut solver).probe.unwrap().temperature;
    let expected = SPEED * SPEED / BOLTZMANN_EV_PER_K;
    assert!((found / expected - 1.0).abs() < FEW_ATOMS, "{found} for {expected}");
}
