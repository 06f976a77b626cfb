//! Solids in time, on the loop that moves slabs: every loading has its work in the ledger, and runs go on bit for bit.

mod broken;
mod checkpoints;
mod nodal;
mod severed;

use std::convert::Infallible;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use cgaft::analysis::columns::Columns;
use cgaft::domain::Ranks;
use cgaft::forces::Summation;
use cgaft::loading::{Action, Ball, Carried, Course, Hold, Push, Ramp};
use cgaft::material::Material;
use cgaft::mesh::solid::cut::Cut;
use cgaft::mesh::solid::region::{Region, Shape};
use cgaft::mesh::solid::sites::{Frame, Outline, Sites};
use cgaft::mesh::solid::{Plan, Solid as Mesh};
use cgaft::potential::{AtCutoff, CutPotential, Interaction};
use cgaft::solver::checkpoint::Checkpoint;
use cgaft::solver::solid::{Experiment, Extension, Gauge, Kept, Row};
use cgaft::solver::{Cost, Ending, Moment, Motion, Observer, Progress, Settings, Solid, Solver, TimeStep, Until};

use super::specimens::LENNARD_JONES;

/// Sites along each axis: two blocks of six, and four along a3.
const EXTENT: [i32; 3] = [12, 12, 24];
const BLOCK: u16 = 6;

/// Height of a layer of sites over the spacing.
const LAYER: f64 = 0.816_496_580_927_726;

fn material() -> Material {
    let law = CutPotential::new(LENNARD_JONES, 0.34 / 0.2277, AtCutoff::Truncated);
    Material::face_centred_cubic(Interaction::LennardJones(law), 1.0).expect("the potential binds")
}

/// Elements, elements with atoms in the middle, and atoms.
fn meshes() -> [(&'static str, Mesh); 3] {
    meshes_with(None)
}

fn meshes_with(cut: Option<Cut>) -> [(&'static str, Mesh); 3] {
    let spacing = material().spacing;
    let atoms_in_the_middle = Region {
        shape: Shape::Slab {
            point: [0.0, 0.0, 11.5 * LAYER * spacing],
            normal: [0.0, 0.0, 1.0],
            half_width: 2.0 * LAYER * spacing,
        },
        element: 1,
    };
    let mesh = |element: u16, regions: Vec<Region>| {
        Mesh::new(&Plan {
            sites: Sites {
                outline: Outline::Rhombohedron(EXTENT),
                frame: Frame::of_blocks(spacing),
                removed: vec![],
                cut,
            },
            element,
            regions,
            spacing,
        })
    };
    [
        ("elements", mesh(BLOCK, vec![])),
        ("mixed", mesh(BLOCK, vec![atoms_in_the_middle])),
        ("atoms", mesh(1, vec![])),
    ]
}

/// The sites of the lowest and of the highest layer.
fn ends(mesh: &Mesh) -> [Carried; 2] {
    [0, EXTENT[2] - 1].map(|layer| Carried::of_solid(mesh, |site| site[2] == layer).1)
}

fn nodes(sites: &Carried) -> Vec<u32> {
    sites.shares().into_iter().map(|(node, _)| node).collect()
}

fn settings(time: f64) -> Settings {
    Settings {
        time_step: TimeStep::Auto { fraction: 0.25 },
        summation: Summation::Exact,
        consistent_mass: 0.0,
        refine: None,
        relax: false,
        noise: None,
        until: Until {
            time: Some(time),
            ..Until::default()
        },
        probe_every: 0.5,
        snapshot_every: None,
        checkpoint_every: Duration::from_secs(3600),
        thickness: 1.0,
    }
}

type Actions = Vec<(String, Box<dyn Action<3>>)>;

fn experiment(mesh: &Mesh, actions: Actions, ramp: Option<Ramp<3>>, rate: Option<f64>) -> Experiment {
    let length = f64::from(EXTENT[2] - 1) * LAYER * mesh.spacing;
    let middle = Gauge::new("middle".to_owned(), mesh, |site| site[2] == EXTENT[2] / 2);
    Experiment {
        actions,
        ramp,
        extension: Extension {
            ends: ends(mesh).map(|end| end.shares()),
            along: [0.0, 0.0, 1.0],
            length,
            rate,
        },
        gauges: vec![middle],
    }
}

fn named(name: &str, action: impl Action<3> + 'static) -> (String, Box<dyn Action<3>>) {
    (name.to_owned(), Box::new(action))
}

/// The low end held, the high end pulled with a speed.
fn pulled(mesh: &Mesh, speed: f64, is_ramped: bool) -> Experiment {
    let [low, high] = ends(mesh).map(|end| nodes(&end));
    let length = f64::from(EXTENT[2] - 1) * LAYER * mesh.spacing;
    let velocity = [0.0, 0.0, speed];
    let ramp = Ramp {
        along: [0.0, 0.0, 1.0],
        from: 0.0,
        to: length,
        velocities: [[0.0; 3], velocity],
    };
    let actions = vec![
        named("held", Hold::at_rest(low)),
        named("pull", Hold::moving(high, velocity, is_ramped)),
    ];
    experiment(mesh, actions, is_ramped.then_some(ramp), Some(speed / length))
}

/// The low end held, and a force a site of the high end.
fn pushed(mesh: &Mesh, force: [f64; 3], course: Course) -> Experiment {
    let [low, high] = ends(mesh);
    let actions = vec![
        named("held", Hold::at_rest(nodes(&low))),
        named("push", Push::new(high.shares(), force, course)),
    ];
    experiment(mesh, actions, None, None)
}

/// Opposite tractions on the two ends, each on a half of the thickness.
fn opposed(mesh: &Mesh) -> Experiment {
    let half = |layer: i32, first: bool| {
        let is_wanted = move |site: [i32; 3]| site[2] == layer && (site[0] < EXTENT[0] / 2) == first;
        Carried::of_solid(mesh, is_wanted).1.shares()
    };
    let course = Course::Rise { within: 2.0 };
    let actions = vec![
        named("low", Push::new(half(0, true), [0.0, 0.0, -0.3], course)),
        named("high", Push::new(half(EXTENT[2] - 1, false), [0.0, 0.0, 0.3], course)),
    ];
    experiment(mesh, actions, None, None)
}

/// The low end held, and a ball that comes down on the high end.
fn hit(mesh: &Mesh) -> Experiment {
    let [low, high] = ends(mesh);
    let spacing = mesh.spacing;
    let radius = 4.0;
    let middle = mesh.sites.frame.place_between([5.5, 5.5, f64::from(EXTENT[2] - 1)]);
    let above = [middle[0], middle[1], middle[2] + radius + 0.1 * spacing];
    let ball = Ball::new(high, [radius, 10.0], [above, [0.0, 0.0, -0.5]]);
    let actions = vec![named("held", Hold::at_rest(nodes(&low))), named("ball", ball)];
    experiment(mesh, actions, None, None)
}

fn solver(mesh: &Mesh, experiment: Experiment, settings: Settings) -> Solver<Solid, 3> {
    Solver::of_solid(Ranks::alone(), mesh.clone(), material(), experiment, settings).expect("the run starts")
}

/// Keeps everything that a run gives.
struct Keeper {
    columns: Columns,
    checkpoints: Vec<Checkpoint<Kept, 3>>,
    snapshots: Vec<u64>,
    /// Asks for a stop at this time.
    stop: Option<(f64, AtomicBool)>,
}

impl Keeper {
    fn new(solver: &Solver<Solid, 3>) -> Self {
        Self {
            columns: solver.columns(),
            checkpoints: Vec::new(),
            snapshots: Vec::new(),
            stop: None,
        }
    }
}

impl Observer<Solid, 3> for Keeper {
    type Error = Infallible;
    fn probe(&mut self, row: &Row) -> Result<(), Infallible> {
        self.columns.push(row.step, &row.numbers);
        Ok(())
    }
    fn snapshot(&mut self, moment: &Moment<Solid, 3>) -> Result<(), Infallible> {
        self.snapshots.push(moment.step);
        Ok(())
    }
    fn checkpoint(&mut self, checkpoint: &Checkpoint<Kept, 3>, motion: &Motion<3>, _: &Cost) -> Result<(), Infallible> {
        self.checkpoints.push(motion.complete(checkpoint));
        Ok(())
    }
    fn progress(&mut self, progress: &Progress) {
        if let Some((time, stop)) = &self.stop {
            stop.store(progress.time >= *time, Ordering::Relaxed);
        }
    }
}

fn run(solver: &mut Solver<Solid, 3>) -> (Keeper, Ending) {
    let mut keeper = Keeper::new(solver);
    let ending = solver.run(&mut keeper, &AtomicBool::new(false));
    (keeper, ending.expect("the run ends well"))
}

fn last(columns: &Columns, name: &str) -> f64 {
    *columns
        .get(name)
        .and_then(<[f64]>::last)
        .unwrap_or_else(|| panic!("no column {name}"))
}

/// Central differences at a quarter of the stability limit miss this much of the work that a loading does.
const ENERGY_ERROR: f64 = 5e-3;

/// What is left of it at half the step: a quarter, and some more where little is missing at all.
const AT_HALF_THE_STEP: f64 = 0.4;

#[test]
fn the_ledger_closes_for_every_loading_on_every_mesh() {
    let rise = Course::Rise { within: 2.0 };
    let at_once = Course::Rise { within: 0.0 };
    for (name, mesh) in meshes() {
        let loadings: [(&str, &dyn Fn() -> Experiment); 8] = [
            ("velocity", &|| pulled(&mesh, 0.1, false)),
            ("velocity with a ramp", &|| pulled(&mesh, 0.1, true)),
            ("traction", &|| pushed(&mesh, [0.1, 0.0, 0.4], rise)),
            ("traction at once", &|| pushed(&mesh, [0.0, 0.0, 0.4], at_once)),
            ("half sine", &|| {
                pushed(&mesh, [0.0, 0.0, -0.4], Course::HalfSine { duration: 2.0 })
            }),
            ("Gaussian", &|| {
                pushed(&mesh, [0.0, 0.0, -0.4], Course::Gaussian { duration: 3.0 })
            }),
            ("opposed tractions", &|| opposed(&mesh)),
            ("ball", &|| hit(&mesh)),
        ];
        for (loading, experiment) in loadings {
            let error = |fraction: f64| {
                let settings = Settings {
                    time_step: TimeStep::Auto { fraction },
                    ..settings(4.0)
                };
                let mut solver = solver(&mesh, experiment(), settings);
                let (keeper, _) = run(&mut solver);
                let work = last(&keeper.columns, "work");
                assert!(work > 0.1, "{loading} on {name}: work {work:e}");
                solver.ledger().relative_error().unwrap()
            };
            let quarter = error(0.25);
            assert!(quarter < ENERGY_ERROR, "{loading} on {name}: {quarter:e}");
            let eighth = error(0.125);
            let is_less = eighth < AT_HALF_THE_STEP * quarter;
            assert!(
                is_less || eighth < 1e-5,
                "{loading} on {name}: {quarter:e}, then {eighth:e}"
            );
        }
    }
}

#[test]
fn a_run_ends_at_the_strain_that_its_ends_prescribe_and_its_probes_read_that_strain() {
    let [(_, mesh), ..] = meshes();
    let settings = Settings {
        until: Until {
            strain: Some(0.01),
            ..Until::default()
        },
        ..settings(0.0)
    };
    let mut solver = solver(&mesh, pulled(&mesh, 0.05, true), settings);
    let (keeper, ending) = run(&mut solver);
    let Ending::Strain(strain) = ending else {
        panic!("{ending}")
    };
    let half_a_step = 0.5 * solver.time_step()[0] * solver.setting().strain_rate;
    assert!((strain - 0.01).abs() <= 1.0001 * half_a_step);
    assert!((last(&keeper.columns, "strain") - strain).abs() < 1e-12);
    // Stretched evenly, it is under the stress of its middle, and of both ends.
    let area = f64::from(EXTENT[0] * EXTENT[1]) * mesh.spacing * mesh.spacing * 0.75f64.sqrt();
    let pull = last(&keeper.columns, "pull_force_z") / area;
    let stress = last(&keeper.columns, "sigma_zz");
    let middle = last(&keeper.columns, "middle_sigma_zz");
    assert!(stress > 0.3, "{stress}");
    for other in [pull, middle, -last(&keeper.columns, "held_force_z") / area] {
        assert!((other / stress - 1.0).abs() < WAVES, "{other} {stress}");
    }
    assert!((last(&keeper.columns, "middle_velocity_z") / 0.025 - 1.0).abs() < WAVES);
}

/// What waves from the sides and the ends, which are not stretched evenly, make of a mean stress.
const WAVES: f64 = 0.2;

/// What forces of 1e-8 of a bond's strength on every node leave of a mean stress.
const AT_REST: f64 = 1e-5;

#[test]
fn a_solid_that_has_come_to_rest_under_a_traction_has_its_stress() {
    let [(_, mesh), ..] = meshes();
    let relaxed = Settings {
        relax: true,
        ..settings(0.2)
    };
    let at_once = Course::Rise { within: 0.0 };
    let experiment = pushed(&mesh, [0.0, 0.0, 0.5], at_once);
    let mut solver = solver(&mesh, experiment, relaxed);
    let (keeper, _) = run(&mut solver);
    let strain = keeper.columns.get("strain").unwrap()[0];
    // What pulls at the two ends with the distance between them is what the bonds hold: the virial theorem.
    let layers = f64::from(EXTENT[2]);
    let stress = 0.5 / (mesh.spacing * mesh.spacing * 0.75f64.sqrt()) * (layers - 1.0) / layers * (1.0 + strain);
    let found = keeper.columns.get("sigma_zz").unwrap()[0];
    assert!((found / stress - 1.0).abs() < AT_REST, "{found} {stress}");
    assert!(strain > 0.0);
    // In equilibrium nothing moves.
    assert!(last(&keeper.columns, "kinetic") < 1e-9 * last(&keeper.columns, "potential").abs().max(1.0));
}
