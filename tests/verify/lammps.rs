//! The same specimen in LAMMPS: energies, forces and trajectories.

mod program;
mod solids;

use std::fs::{self, File};
use std::process::Command;

use cgaft::export::lammps::Model;
use cgaft::forces::{Forces, Planes};
use cgaft::loading::{Grip, Stretching};
use cgaft::material::Material;
use cgaft::mesh::Mesh;
use cgaft::state::State;
use cgaft::study::case::{self, Case};
use cgaft::{lattice::triangular, plan, setup, study};

use super::specimens;
use super::table::{Chapter, Gate};
use program::Folder;

/// The same pairs summed in another order, and factors multiplied in another order, differ by rounding only.
const ROUNDING: f64 = 1e-12;

/// Rounding errors grow as atoms move, but not beyond this in 1,000 steps; in spacings, and spacings a ps.
const TRAJECTORY: f64 = 1e-9;

/// Every potential and treatment of the cutoff that LAMMPS has, for nearest neighbours and beyond.
const POTENTIALS: [(&str, &str); 6] = [
    (
        "Lennard-Jones truncated at 0.34 nm",
        "lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, cutoff: 0.34 nm, at-cutoff: truncated}",
    ),
    (
        "Lennard-Jones shifted at 0.57 nm",
        "lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, cutoff: 0.57 nm, at-cutoff: shifted}",
    ),
    SMOOTH,
    (
        "Lennard-Jones smooth 0.45 to 0.57 nm",
        "lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, at-cutoff: {smooth: {from: 0.45 nm, to: 0.57 nm}}}",
    ),
    (
        "Morse truncated at 0.5 nm",
        "morse: {depth: 0.343 eV, decay: 13.6 /nm, distance: 0.2866 nm, cutoff: 0.5 nm, at-cutoff: truncated}",
    ),
    (
        "Morse shifted at 0.5 nm",
        "morse: {depth: 0.343 eV, decay: 13.6 /nm, distance: 0.2866 nm, cutoff: 0.5 nm, at-cutoff: shifted}",
    ),
];

/// 1.5 to 1.9 sigma.
const SMOOTH: (&str, &str) = (
    "Lennard-Jones smooth 0.342 to 0.433 nm",
    "lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, at-cutoff: {smooth: {from: 0.34155 nm, to: 0.43263 nm}}}",
);

/// At 4 % the crack sets out, and crosses eight more bonds within 1,000 steps.
const STEPS_UNTIL_THE_CRACK_RUNS: u64 = 4000;

/// A study of small specimens. The time step is 0.005 in the unit of the potential, sigma sqrt(m/epsilon) = 1.0191 ps;
/// 1,000 steps of it strain the uncracked ones by 5 %.
fn study_text(potential: &str) -> String {
    format!(
        "
study: parity
base:
  material: {{potential: {{{potential}}}, mass: 802 u, thickness: 0.2087 nm}}
  specimen: {{lattice: triangular, length: 15 nm, width: 13.3 nm}}
  resolution: {{element: 1}}
  loading: {{strain-rate: {{mode: I, rate: 9.8e9 /s, ramp: initial-velocity}}}}
  run: {{until: {{time: 5.0955 ps}}, time-step: 0.0050955 ps}}
  probes: {{every: 1 ps}}
  observe: [{{snapshots: {{every: 0.50955 ps}}}}]
cases:
  intact: {{}}
  sliding: {{specimen: {{grips: sliding}}}}
  cracked: {{crack: {{edge: left, length: 5 nm}}, loading: {{strain-rate: {{rate: 1.96e9 /s}}}}}}
"
    )
}

fn case(potential: &str, name: &str) -> Case {
    let study = study::read_text("parity.yaml", &study_text(potential)).unwrap();
    let plan = plan::plan(&study).unwrap_or_else(|error| panic!("{}", error.render(false)));
    let named = plan.cases.into_iter().find(|planned| planned.name == name);
    named.expect("the study has this case").case
}

#[test]
fn energies_and_forces_equal_those_of_lammps_in_every_state() {
    let mut gate = Gate::new(Chapter::Peer, "1 energies and forces");
    for (potential, text) in POTENTIALS {
        let [mut energies, mut forces] = [vec![], vec![]];
        for name in ["intact", "cracked"] {
            let case = case(text, name);
            let slab = case.slab().unwrap();
            let material = setup::slab::material(slab).unwrap();
            let mesh = Mesh::new(&setup::slab::mesh_plan(slab, &case.run.until, &material).unwrap());
            let model = Model::new(&case, slab, &material, &mesh).unwrap();
            for (_, position) in specimens::states(&mesh) {
                let [energy, force] = differences(&model, &mesh, &material, &position);
                energies.push(energy);
                forces.push(force);
            }
        }
        let setting = format!("{potential}, single atoms, {} states", energies.len());
        gate.below("energy, change over itself", &setting, worst(energies), ROUNDING);
        gate.below("force, change over the largest", &setting, worst(forces), ROUNDING);
    }
    gate.close();
}

/// By how much energy, over itself, and forces, over the largest, differ in a state.
fn differences(model: &Model, mesh: &Mesh, material: &Material, position: &Planes) -> [f64; 2] {
    let mut forces = Forces::new(mesh.clone(), *material);
    let (energy, force) = in_lammps(model, position);
    let mut expected: Planes = [vec![0.0; mesh.node_count()], vec![0.0; mesh.node_count()]];
    forces.compute(&mut position.clone(), &mut expected).unwrap();
    // Forces cancel in the perfect lattice, so they are measured by the force of a single bond too.
    let bond = 0.1 * material.interaction.curvature(material.spacing) * material.spacing;
    let scale = expected
        .iter()
        .flatten()
        .fold(bond, |scale, force| scale.max(force.abs()));
    let measured = forces.measure(position).unwrap().energy(forces.domain());
    [
        (energy / measured - 1.0).abs(),
        largest_difference(&force, &expected) / scale,
    ]
}

/// Energy and forces by LAMMPS.
fn in_lammps(model: &Model, position: &Planes) -> (f64, Planes) {
    let folder = Folder::new();
    let state = State::at_rest(position.clone(), vec![1.0; position[0].len()]);
    let mut file = File::create(folder.file("data.state")).unwrap();
    model.crystal.write_data("a state", &state, &mut file).unwrap();
    let output = "
thermo_style custom pe
thermo_modify norm no format float %.16e
dump forces all custom 1 dump.state id x y fx fy
dump_modify forces sort id format float %.16e
run 0
";
    fs::write(folder.file("in.state"), model.crystal.settings("data.state") + output).unwrap();
    folder.run("in.state");
    let snapshot = folder.snapshots("dump.state").pop().unwrap();
    assert_eq!(snapshot.first, *position, "LAMMPS reads every bit");
    (folder.last_row()[0], snapshot.second)
}

fn largest_difference(found: &Planes, expected: &Planes) -> f64 {
    let pairs = found.iter().flatten().zip(expected.iter().flatten());
    assert_eq!(found[0].len(), expected[0].len());
    worst(pairs.map(|(found, expected)| (found - expected).abs()))
}

/// The largest of sizes; what is not a number is larger than all.
fn worst(sizes: impl IntoIterator<Item = f64>) -> f64 {
    sizes
        .into_iter()
        .max_by(f64::total_cmp)
        .expect("there is something to compare")
}

#[test]
fn an_intact_specimen_moves_as_in_lammps_from_the_exported_start() {
    let mut gate = Gate::new(Chapter::Peer, "2 trajectories, intact");
    for potential in POTENTIALS {
        let [_, broken] = compare_runs(potential, "intact", 0, &mut gate);
        assert_eq!(broken, 0, "{}", potential.0);
    }
    let [_, broken] = compare_runs(SMOOTH, "sliding", 0, &mut gate);
    assert_eq!(broken, 0, "sliding grips");
    gate.close();
}

#[test]
fn a_running_crack_moves_as_in_lammps() {
    let mut gate = Gate::new(Chapter::Peer, "3 trajectories, crack");
    let [before, after] = compare_runs(SMOOTH, "cracked", STEPS_UNTIL_THE_CRACK_RUNS, &mut gate);
    assert!(
        before > 0 && after >= before + 6,
        "the crack must run: {before}, then {after} bonds broken"
    );
    gate.close();
}

/// Exports a case, replaces its start by the state after some steps, runs it in LAMMPS and here, and compares all that
/// LAMMPS tells. Returns how many bonds were broken ahead of the notch at the start and at the end.
fn compare_runs((potential, text): (&str, &str), name: &str, steps_before: u64, gate: &mut Gate) -> [usize; 2] {
    let folder = Folder::new();
    fs::write(folder.file("parity.yaml"), study_text(text)).unwrap();
    let export = Command::new(env!("CARGO_BIN_EXE_cgaft"))
        .args(["export", "lammps", "parity.yaml", "--case", name, "--into", "."])
        .current_dir(folder.path())
        .output();
    assert!(export.unwrap().status.success());
    let case = case(text, name);
    let slab = case.slab().unwrap();
    let material = setup::slab::material(slab).unwrap();
    let mut solver = setup::slab::solver(&case, slab).unwrap();
    if steps_before > 0 {
        (0..steps_before).for_each(|_| solver.advance().unwrap());
        let model = Model::new(&case, slab, &material, solver.mesh()).unwrap();
        let mut file = File::create(folder.file(&format!("data.{name}"))).unwrap();
        model
            .crystal
            .write_data("a later start", solver.state(), &mut file)
            .unwrap();
    }
    let broken_before = broken_ahead(solver.mesh(), &solver.state().position);
    folder.run(&format!("in.{name}"));
    let snapshots = folder.snapshots(&format!("dump.{name}"));
    assert_eq!(snapshots.last().unwrap().step, 1000);
    assert_eq!(snapshots.len(), 11);
    let [mut positions, mut velocities] = [vec![], vec![]];
    for snapshot in snapshots {
        while solver.step_count() < steps_before + snapshot.step {
            solver.advance().unwrap();
        }
        let (state, spacing) = (solver.state(), solver.mesh().spacing);
        positions.push(largest_difference(&snapshot.first, &state.position) / spacing);
        velocities.push(largest_difference(&snapshot.second, &state.velocity) / spacing);
    }
    let totals = differences_of_totals(slab, solver.mesh(), solver.state(), &folder.last_row());
    let setting = format!("{potential}, single atoms, {name}, 1,000 steps");
    for (claim, found) in [
        ("positions, change over r0", worst(positions)),
        ("velocities, change over r0 a ps", worst(velocities)),
        ("energies and pull of the grips, change over themselves", worst(totals)),
    ] {
        gate.below(claim, &setting, found, TRAJECTORY);
    }
    [broken_before, broken_ahead(solver.mesh(), &solver.state().position)]
}

/// Potential and kinetic energy and the pull of the grips.
fn differences_of_totals(slab: &case::Slab, mesh: &Mesh, state: &State, row: &[f64]) -> [f64; 3] {
    let rate = slab.loading.strain_rate().expect("grips pull it");
    let grip = match slab.specimen.grips {
        case::Grips::Clamped => Grip::Clamped,
        case::Grips::Sliding => Grip::Sliding,
    };
    let pull = Stretching::new(mesh, rate, grip, true).grip_force(state);
    let mut forces = Forces::new(mesh.clone(), setup::slab::material(slab).unwrap());
    let energy = forces.measure(&state.position).unwrap().energy(forces.domain());
    let expected = [energy, state.kinetic_energy(), pull];
    assert_eq!(row.len(), 3 + expected.len());
    [0, 1, 2].map(|total| (row[3 + total] / expected[total] - 1.0).abs())
}

/// Bonds between the rows at mid-height that are not severed and longer than one and a half spacings.
fn broken_ahead(mesh: &Mesh, position: &Planes) -> usize {
    let row = mesh.sites.middle_row() - 1;
    let below = mesh.sites.columns(row).map(|column| [column, row]);
    let bonds = below.flat_map(|site| triangular::NEAREST.map(|[i, j]| [site, [site[0] + i, site[1] + j]]));
    let across = bonds.filter(|&[a, b]| b[1] > row && !mesh.severed(a, b));
    let long = across.filter(|bond| {
        let [Some(a), Some(b)] = bond.map(|site| mesh.owner_of(site)) else {
            return false;
        };
        let [x, y] = [0, 1].map(|axis| position[axis][b] - position[axis][a]);
        x.hypot(y) > 1.5 * mesh.spacing
    });
    long.count()
}
