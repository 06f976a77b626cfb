//! Face-centred cubic crystals of atoms in LAMMPS: forces, and where a thousand steps of every loading lead.

use std::fs::{self, File};
use std::process::Command;

use cgaft::domain::Ranks;
use cgaft::export::lammps::SolidModel;
use cgaft::forces::solid::Forces;
use cgaft::solver::{Body as _, Solid, Solver};
use cgaft::state::State;
use cgaft::study::case::Case;
use cgaft::{plan, setup, study};

use super::super::table::{Chapter, Gate};
use super::program::Folder;
use super::{ROUNDING, TRAJECTORY, worst};

/// Atoms are displaced by at most so much, in spacings: far from rest, near enough for none to leave another.
const DISPLACED: f64 = 0.03;

/// A thousand steps of 0.005 in the unit of the potential, sigma sqrt(m/epsilon) = 1.0191 ps; every loading is at work in them.
const STUDY: &str = "
study: parity
base:
  material: {potential: {lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, cutoff: 0.34 nm}}, mass: 802 u}
  specimen: {lattice: fcc, blocks: [3, 2, 2], block: 4}
  resolution: {element: 1}
  held: {faces: [a1-low], layers: 2}
  run: {until: {time: 5.0955 ps}, time-step: 0.0050955 ps}
  probes: {every: 0.50955 ps}
  observe: [{snapshots: {every: 0.50955 ps}}]
cases:
  pulled: {loading: {velocity: {face: a1-high, speed: 5 m/s, layers: 2, ramp: initial-velocity}}}
  loaded: {loading: {traction: {face: a1-high, stress: [300 MPa, 100 MPa, -200 MPa], rise-time: 2 ps}}}
  torn: {loading: {opposed-tractions: {axis: a2, thickness: a3, share: 50 %, stress: [0 MPa, 0 MPa, 300 MPa]}}}
  struck: {loading: {pulse: {face: a1-high, shape: half-sine, duration: 3 ps, pressure: 500 MPa}}}
  rung: {loading: {pulse: {face: a1-high, shape: gaussian, duration: 4 ps, pressure: 500 MPa}}}
  hit: {loading: {impact: {face: a3-high, radius: 1 nm, speed: 20 m/s, gap: 0.01 nm}}}
";

const LOADINGS: [&str; 6] = ["pulled", "loaded", "torn", "struck", "rung", "hit"];

fn case(text: &str, name: &str) -> Case {
    let study = study::read_text("parity.yaml", text).unwrap();
    let plan = plan::plan(&study).unwrap_or_else(|error| panic!("{}", error.render(false)));
    let named = plan.cases.into_iter().find(|planned| planned.name == name);
    named.expect("the study has this case").case
}

fn solver(case: &Case) -> Solver<Solid, 3> {
    setup::solid::solver(case, case.solid().unwrap(), Ranks::alone()).unwrap()
}

fn model(case: &Case, solver: &Solver<Solid, 3>) -> SolidModel {
    let solid = case.solid().unwrap();
    let material = setup::solid::material(solid).unwrap();
    let size = (solver.state().nodes(), solver.body().setting().volume);
    SolidModel::new(case, solid, &material, size, solver.body().load().acts()).unwrap()
}

#[test]
fn forces_on_atoms_of_a_solid_equal_those_of_lammps() {
    let mut gate = Gate::new(Chapter::Peer, "1 forces of solids");
    for cutoff in ["0.34 nm", "0.56925 nm"] {
        let case = case(&STUDY.replace("0.34 nm", cutoff), "struck");
        let solver = solver(&case);
        let start = State::at_rest(displaced(&solver), vec![1.0; solver.state().nodes()]);
        let folder = Folder::new();
        let mut file = File::create(folder.file("data.state")).unwrap();
        let model = model(&case, &solver);
        model.crystal.write_data("a state", &start, &mut file).unwrap();
        let output = "dump all all custom 1 dump.state id x y z fx fy fz\n\
                      dump_modify all sort id format float %.16e\nrun 0\n";
        fs::write(folder.file("in.state"), model.crystal.settings("data.state") + output).unwrap();
        folder.run("in.state");
        let snapshot = folder.snapshots::<3>("dump.state").pop().unwrap();
        assert_eq!(snapshot.first, start.position, "LAMMPS reads every bit");
        let mut forces = start.force.clone();
        let material = setup::solid::material(case.solid().unwrap()).unwrap();
        let mut summed = Forces::new(solver.mesh().clone(), material);
        summed.compute(&mut start.position.clone(), &mut forces).unwrap();
        let largest = worst(forces.iter().flatten().map(|force| force.abs()));
        let off = difference(&forces, &snapshot.second) / largest;
        let setting = format!("Lennard-Jones truncated at {cutoff}, {} atoms", start.nodes());
        gate.below("force, change over the largest", &setting, off, ROUNDING);
    }
    gate.close();
}

fn displaced(solver: &Solver<Solid, 3>) -> [Vec<f64>; 3] {
    let mut position = solver.mesh().node_positions();
    let mut seed = 11u64;
    for place in position.iter_mut().flatten() {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let noise = (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
        *place += DISPLACED * solver.mesh().spacing * noise;
    }
    position
}

#[test]
fn a_solid_moves_under_every_loading_as_in_lammps_from_the_exported_input() {
    let mut gate = Gate::new(Chapter::Peer, "4 trajectories of solids");
    for name in LOADINGS {
        let folder = Folder::new();
        fs::write(folder.file("parity.yaml"), STUDY).unwrap();
        let export = Command::new(env!("CARGO_BIN_EXE_cgaft"))
            .args(["export", "lammps", "parity.yaml", "--case", name, "--into", "."])
            .current_dir(folder.path())
            .output();
        assert!(export.unwrap().status.success());
        folder.run(&format!("in.{name}"));
        let snapshots = folder.snapshots::<3>(&format!("dump.{name}"));
        assert_eq!((snapshots.len(), snapshots[10].step), (11, 1000));
        let mut solver = solver(&case(STUDY, name));
        let start = solver.state().position.clone();
        let [mut positions, mut velocities] = [vec![], vec![]];
        for snapshot in snapshots {
            while solver.step_count() < snapshot.step {
                solver.advance().unwrap();
            }
            let (state, spacing) = (solver.state(), solver.mesh().spacing);
            positions.push(difference(&snapshot.first, &state.position) / spacing);
            velocities.push(difference(&snapshot.second, &state.velocity) / spacing);
        }
        let moved = difference(&start, &solver.state().position) / solver.mesh().spacing;
        assert!(
            moved > 100.0 * TRAJECTORY,
            "{name} moves atoms by {moved} spacings only"
        );
        let setting = format!("{name}, {} atoms, 1,000 steps", solver.state().nodes());
        gate.below("positions, change over r0", &setting, worst(positions), TRAJECTORY);
        gate.below(
            "velocities, change over r0 a ps",
            &setting,
            worst(velocities),
            TRAJECTORY,
        );
    }
    gate.close();
}

fn difference(found: &[Vec<f64>; 3], expected: &[Vec<f64>; 3]) -> f64 {
    let pairs = found.iter().flatten().zip(expected.iter().flatten());
    worst(pairs.map(|(found, expected)| (found - expected).abs()))
}
