//! Face-centred cubic crystals of atoms in LAMMPS: forces, and where a thousand steps lead.

use std::fmt::Write;
use std::fs;

use cgaft::forces::solid::{Forces, Planes};
use cgaft::integrator;
use cgaft::material::Material;
use cgaft::mesh::solid::sites::{Frame, Outline, Sites};
use cgaft::mesh::solid::{Plan, Solid};
use cgaft::potential::{AtCutoff, CutPotential, Interaction, LennardJones};
use cgaft::state::State;

use super::super::table::{Chapter, Gate};
use super::program::Folder;
use super::{ROUNDING, TRAJECTORY};

const STEPS: u32 = 1000;
const TIME_STEP: f64 = 0.002;

/// Atoms are displaced by at most so much, in spacings: far from rest, near enough for none to leave another.
const DISPLACED: f64 = 0.03;

#[test]
fn forces_and_trajectories_of_crystals_equal_those_of_lammps() {
    let mut gate = Gate::new(Chapter::Peer, "1 forces and trajectories of solids");
    for cutoff in [1.4932, 2.5] {
        let shape = LennardJones {
            epsilon: 1.0,
            sigma: 1.0,
        };
        let law = CutPotential::new(shape, cutoff, AtCutoff::Truncated);
        let material = Material::face_centred_cubic(Interaction::LennardJones(law), 1.0).unwrap();
        let sites = Sites {
            outline: Outline::Rhombohedron([12, 10, 8]),
            frame: Frame::of_blocks(material.spacing),
            removed: vec![],
        };
        let plan = Plan {
            sites,
            element: 1,
            regions: vec![],
            spacing: material.spacing,
        };
        let mesh = Solid::new(&plan);
        let start = displaced(&mesh);
        let [first, last] = in_lammps(&start, cutoff);
        let mut forces = Forces::new(mesh.clone(), material);
        let mut state = State::at_rest(start, mesh.lumped_masses());
        forces.compute(&mut state.position, &mut state.force).unwrap();
        let setting = format!("Lennard-Jones truncated at {cutoff} sigma, {} atoms", mesh.site_count());
        let largest = state
            .force
            .iter()
            .flatten()
            .fold(0.0, |most: f64, force| most.max(force.abs()));
        let off = difference(&state.force, &first.forces) / largest;
        gate.below("force, change over the largest", &setting, off, ROUNDING);
        let nodes = state.every_node();
        for _ in 0..STEPS {
            integrator::kick_and_drift(&mut state, &nodes, integrator::leap(1, TIME_STEP));
            forces.compute(&mut state.position, &mut state.force).unwrap();
            integrator::kick(&mut state, &nodes, 0.5 * TIME_STEP);
        }
        let off = difference(&state.position, &last.positions) / material.spacing;
        gate.below("place after 1,000 steps, spacings", &setting, off, TRAJECTORY);
    }
    gate.close();
}

fn displaced(mesh: &Solid) -> Planes {
    let mut position = mesh.node_positions();
    let mut seed = 11u64;
    for place in position.iter_mut().flatten() {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let noise = (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
        *place += DISPLACED * mesh.spacing * noise;
    }
    position
}

fn difference(found: &Planes, expected: &Planes) -> f64 {
    let pairs = found.iter().flatten().zip(expected.iter().flatten());
    pairs
        .map(|(found, expected)| (found - expected).abs())
        .fold(0.0, f64::max)
}

struct Moment {
    positions: Planes,
    forces: Planes,
}

/// The first moment and that after all steps.
fn in_lammps(position: &Planes, cutoff: f64) -> [Moment; 2] {
    let folder = Folder::new();
    let atoms = position[0].len();
    let mut data = format!("atoms\n\n{atoms} atoms\n1 atom types\n\n");
    for (axis, plane) in ["x", "y", "z"].into_iter().zip(position) {
        let least = plane.iter().copied().fold(f64::INFINITY, f64::min) - 5.0;
        let most = plane.iter().copied().fold(f64::NEG_INFINITY, f64::max) + 5.0;
        writeln!(data, "{least} {most} {axis}lo {axis}hi").unwrap();
    }
    data.push_str("\nAtoms # atomic\n\n");
    for atom in 0..atoms {
        let [x, y, z] = position.each_ref().map(|plane| plane[atom]);
        writeln!(data, "{} 1 {x:.17e} {y:.17e} {z:.17e}", atom + 1).unwrap();
    }
    fs::write(folder.file("atoms.data"), data).unwrap();
    let script = format!(
        "units lj\natom_style atomic\nboundary f f f\nread_data atoms.data\nmass 1 1.0\npair_style lj/cut {cutoff}\n\
         pair_coeff 1 1 1.0 1.0\nneighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\nfix 1 all nve\n\
         timestep {TIME_STEP}\ndump 1 all custom {STEPS} dump.txt id x y z fx fy fz\n\
         dump_modify 1 sort id format float %.17g\nrun {STEPS}\n"
    );
    fs::write(folder.file("in.solid"), script).unwrap();
    folder.run("in.solid");
    let text = fs::read_to_string(folder.file("dump.txt")).unwrap();
    let moments: Vec<Moment> = text.split("ITEM: TIMESTEP\n").skip(1).map(moment).collect();
    moments.try_into().ok().expect("two moments")
}

fn moment(text: &str) -> Moment {
    let (_, rows) = text.split_once("ITEM: ATOMS").unwrap();
    let mut moment = Moment {
        positions: Planes::default(),
        forces: Planes::default(),
    };
    for (number, row) in rows.lines().skip(1).enumerate() {
        let words: Vec<&str> = row.split_whitespace().collect();
        assert_eq!(words[0].parse(), Ok(number + 1), "sorted");
        let numbers = words[1..].iter().map(|word| word.parse::<f64>().unwrap());
        let planes = moment.positions.iter_mut().chain(&mut moment.forces);
        planes.zip(numbers).for_each(|(plane, number)| plane.push(number));
    }
    moment
}
