//! The crystal that specimens are made of, measured on specimens.
//!
//! A specimen's energy is that of its interior, its edges and its corners. Of four specimens, long and short, high and
//! low, the edges and corners cancel, and what is left is the energy of interior alone.

use cgaft::forces::{Forces, Summation};
use cgaft::lattice::triangular;
use cgaft::material::{Elasticity, Material};
use cgaft::mesh::Mesh;
use cgaft::potential::AtCutoff;
use cgaft::relaxation::bond_strength;

use super::{SMOOTH, block_mesh, smooth, zeros};
use crate::verify::specimens::{all_materials, all_meshes, displaced, lennard_jones};
use crate::verify::table::{Chapter, Gate};

const ROWS: [i32; 2] = [6, 10];
const TRIANGLES: [i32; 2] = [9, 17];

/// Half of the last digit that the references are printed with.
const PRINTED_SPACING: f64 = 5e-7;
const PRINTED_ENERGY: f64 = 5e-5;
const PRINTED_MODULUS: f64 = 5e-4;
const PRINTED_SURFACE: f64 = 5e-5;
/// Differences of the energy over 1e-3 leave h^4 of the sixth derivative, some 1e-7, and 1e-8 of rounding.
const MODULUS: f64 = 1e-6;
/// Counts of sites over lengths.
const DENSITY: f64 = 1e-12;
/// Rounding of energies of 1e4 over those of 50 bonds.
const SURFACE: f64 = 1e-8;
/// Rounding of energies over a strain of 1e-3, over C11.
const PRESSURE: f64 = 1e-8;
/// Interior forces cancel to rounding.
const PATCH: f64 = 1e-10;

/// What is interior of four specimens, for a quantity that edges and corners have a share in.
fn interior(element: u16, material: &Material, quantity: impl Fn(&Mesh) -> f64) -> f64 {
    let of = |rows: usize, triangles: usize| {
        quantity(&block_mesh(
            10,
            ROWS[rows],
            TRIANGLES[triangles],
            element,
            material.spacing,
        ))
    };
    of(1, 1) - of(1, 0) - of(0, 1) + of(0, 0)
}

/// Area of the interior.
fn area(material: &Material) -> f64 {
    let length = f64::from((TRIANGLES[1] - TRIANGLES[0]) / 2 * 11);
    let height = f64::from((ROWS[1] - ROWS[0]) * 10) * triangular::ROW_HEIGHT;
    length * height * material.spacing * material.spacing
}

/// Energy of the interior over its area under the displacement gradient (xx, yy) and a shear u_x = xy y.
fn energy_density(element: u16, material: &Material, [xx, yy, xy]: [f64; 3]) -> f64 {
    let energy = |mesh: &Mesh| {
        let position = displaced(mesh, |[x, y]| [xx * x + xy * y, yy * y]);
        let mut forces = Forces::new(mesh.clone(), *material);
        forces
            .measure(&position)
            .expect("the state is sound")
            .energy(forces.domain())
    };
    interior(element, material, energy) / area(material)
}

/// Second derivative along a direction, without the fourth: differences over a step and over twice that.
fn second(function: impl Fn(f64) -> f64) -> f64 {
    const STEP: f64 = 1e-3;
    let at = |steps: f64| function(steps * STEP);
    (16.0 * (at(1.0) + at(-1.0)) - (at(2.0) + at(-2.0)) - 30.0 * at(0.0)) / (12.0 * STEP * STEP)
}

fn first(function: impl Fn(f64) -> f64) -> f64 {
    const STEP: f64 = 1e-3;
    let at = |steps: f64| function(steps * STEP);
    (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * STEP)
}

/// A zero-pressure lattice of Lennard-Jones atoms, truncated: computed independently, as printed.
struct Reference {
    name: &'static str,
    /// In sigma.
    cutoff: f64,
    spacing: f64,
    energy_of_an_atom: f64,
    c11: f64,
    c12: f64,
    /// Energy to part it along a row, with what truncation releases.
    surfaces: f64,
    /// How many bonds that takes, for each spacing: a vector that climbs j rows is that of j of them.
    parted_bonds: f64,
}

const REFERENCES: [Reference; 4] = [
    Reference {
        name: "nearest neighbours, 0.34 nm",
        cutoff: 0.34 / 0.2277,
        spacing: 1.122462,
        energy_of_an_atom: -3.0,
        c11: 74.235,
        c12: 24.745,
        surfaces: 1.7818,
        parted_bonds: 2.0,
    },
    Reference {
        name: "truncated at 2 sigma",
        cutoff: 2.0,
        spacing: 1.115934,
        energy_of_an_atom: -3.2219,
        c11: 80.662,
        c12: 26.887,
        surfaces: 2.0596,
        parted_bonds: 6.0,
    },
    // The fourth shell is beyond 2.9 sigma, so that both cutoffs make one crystal.
    Reference {
        name: "truncated at 0.57 nm",
        cutoff: 0.57 / 0.2277,
        ..THREE_SHELLS
    },
    THREE_SHELLS,
];

const THREE_SHELLS: Reference = Reference {
    name: "truncated at 2.5 sigma",
    cutoff: 2.5,
    spacing: 1.113201,
    energy_of_an_atom: -3.3189,
    c11: 83.499,
    c12: 27.833,
    surfaces: 2.1833,
    parted_bonds: 10.0,
};

impl Reference {
    fn material(&self) -> Material {
        lennard_jones(self.cutoff, AtCutoff::Truncated)
    }

    /// What truncation releases when a specimen parts: every bond leaves the potential at its cutoff.
    fn released(&self) -> f64 {
        let at_cutoff = 4.0 * (self.cutoff.powi(-12) - self.cutoff.powi(-6));
        -at_cutoff * self.parted_bonds / self.spacing
    }
}

#[test]
fn elastic_constants_and_density_measured_on_specimens_are_the_references() {
    let mut gate = Gate::new(Chapter::Crystal, "2 constants");
    for reference in REFERENCES {
        let material = reference.material();
        for element in [1, 10] {
            let setting = format!("{}, n = {element}", reference.name);
            let along = |direction: [f64; 3]| {
                second(|strain| energy_density(element, &material, direction.map(|part| part * strain)))
            };
            let [c11, c22, c66] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(along);
            let c12 = 0.25 * (along([1.0, 1.0, 0.0]) - along([1.0, -1.0, 0.0]));
            gate.near("C11", &setting, c11, reference.c11, PRINTED_MODULUS);
            gate.near("C22 = C11", &setting, c22, reference.c11, PRINTED_MODULUS);
            gate.near("C12", &setting, c12, reference.c12, PRINTED_MODULUS);
            gate.near(
                "C44 (C66 of the sheet) = C12",
                &setting,
                c66,
                reference.c12,
                PRINTED_MODULUS,
            );
            if reference.name.starts_with("nearest") {
                let closed = 0.75 * 3f64.sqrt() * 72.0 / 2f64.cbrt();
                gate.within("C11 = (3 sqrt 3/4) 72/2^(1/3)", &setting, c11, closed, MODULUS);
                gate.within("C12 = C11/3", &setting, c12, closed / 3.0, MODULUS);
            }
            let told = Elasticity::of(&material);
            let differences = [c11 - told.c11, c22 - told.c11, c12 - told.c12, c66 - told.c66];
            gate.below(
                "constants computed from the potential, worst difference over C11",
                &setting,
                differences
                    .into_iter()
                    .map(|difference| difference.abs() / c11)
                    .max_by(f64::total_cmp)
                    .expect("there are constants"),
                MODULUS,
            );
            let mass = |mesh: &Mesh| mesh.lumped_masses().iter().sum::<f64>();
            let density = interior(element, &material, mass) / area(&material);
            let spacing = material.spacing;
            let closed = 2.0 / (3f64.sqrt() * spacing * spacing);
            gate.within("density 2/(sqrt 3 r0^2)", &setting, density, closed, DENSITY);
        }
    }
    gate.close();
}

#[test]
fn spacing_and_energy_of_each_cutoff_are_the_references_and_leave_no_pressure() {
    let mut gate = Gate::new(Chapter::Crystal, "1 spacing");
    for reference in REFERENCES {
        let (material, name) = (reference.material(), reference.name);
        gate.near("r0", name, material.spacing, reference.spacing, PRINTED_SPACING);
        let sites = interior(10, &material, |mesh| mesh.sites.len() as f64);
        gate.near(
            "energy of an atom inside",
            name,
            energy_density(10, &material, [0.0; 3]) * area(&material) / sites,
            reference.energy_of_an_atom,
            PRINTED_ENERGY,
        );
        let pressure = first(|strain| energy_density(10, &material, [strain, strain, 0.0]));
        gate.below(
            "size of the pressure over C11",
            name,
            pressure.abs() / Elasticity::of(&material).c11,
            PRESSURE,
        );
    }
    gate.close();
}

/// Energy to part the interior of a specimen along its middle row, over its length, and that less what truncation
/// releases.
fn parting_energy(element: u16, material: &Material) -> [f64; 2] {
    let jump = material.interaction.jump_at_cutoff();
    let cost = |triangles: i32| {
        let mesh = block_mesh(10, 6, triangles, element, material.spacing);
        let middle = mesh.middle_height() / mesh.spacing;
        let [whole, parted] = [0.0, 20.0].map(|gap| {
            let position = displaced(&mesh, |[_, y]| [0.0, if y > middle { gap } else { 0.0 }]);
            let mut forces = Forces::new(mesh.clone(), *material);
            let measure = forces.measure(&position).expect("the state is sound");
            let [energy, pairs] = [measure.energy(forces.domain()), measure.pairs(forces.domain())];
            [energy, energy - jump * pairs]
        });
        [parted[0] - whole[0], parted[1] - whole[1]]
    };
    let length = f64::from((TRIANGLES[1] - TRIANGLES[0]) / 2 * 11) * material.spacing;
    let [short, long] = TRIANGLES.map(cost);
    [0, 1].map(|kind| (long[kind] - short[kind]) / length)
}

#[test]
fn parting_a_specimen_along_a_row_costs_the_energy_of_two_surfaces() {
    let mut gate = Gate::new(Chapter::Crystal, "3 surface");
    let two_wells = 2.0 / 2f64.powf(1.0 / 6.0);
    for element in [1, 10] {
        let [of_smooth, _] = parting_energy(element, &smooth());
        let setting = format!("{SMOOTH}, n = {element}");
        gate.within("2 gamma = 2/r0", &setting, of_smooth, two_wells, SURFACE);
        for reference in REFERENCES {
            let setting = format!("{}, n = {element}", reference.name);
            let material = reference.material();
            let [whole, held] = parting_energy(element, &material);
            gate.near("2 gamma", &setting, whole, reference.surfaces, PRINTED_SURFACE);
            let expected = reference.surfaces - reference.released();
            gate.near("2 gamma less the release", &setting, held, expected, PRINTED_SURFACE);
            gate.within(
                "the same computed from the potential",
                &setting,
                material.fracture_energy(),
                held,
                SURFACE,
            );
        }
    }
    gate.close();
}

#[test]
fn an_affine_strain_leaves_no_force_inside_any_mesh() {
    let mut gate = Gate::new(Chapter::Crystal, "4 patch");
    for (name, material) in all_materials() {
        for (rule, summation) in [("exact", Summation::Exact), ("gauss 2", Summation::Gauss { points: 2 })] {
            let worst = force_left_by_an_affine_strain(&material, summation);
            let claim = format!("force inside over a bond's strength, {rule} summation, 12 meshes");
            gate.below(&claim, name, worst, PATCH);
        }
        let worst = force_left_by_an_affine_strain(&material, Summation::Nodal);
        let claim = "force inside over a bond's strength, nodal summation, 12 meshes";
        gate.report(claim, name, worst);
    }
    gate.close();
}

/// Largest force over a bond's strength on a node all of whose bonds are inside the specimen, on uniform and mixed meshes.
fn force_left_by_an_affine_strain(material: &Material, summation: Summation) -> f64 {
    let uniform = [1, 4, 7, 10, 13, 20].map(|n| block_mesh(10, 8, 15, n, material.spacing));
    let mixed = all_meshes(material.spacing).into_iter().map(|(_, mut mesh)| {
        mesh.cut = None;
        mesh
    });
    let [mut worst, mut looked_at] = [0.0f64, 0.0];
    for mesh in uniform.into_iter().chain(mixed) {
        let position = displaced(&mesh, |[x, y]| [0.01 * x + 0.004 * y, -0.003 * x + 0.015 * y]);
        let mut force = zeros(&mesh);
        let mut forces = Forces::with_summation(mesh.clone(), *material, summation);
        forces
            .compute(&mut position.clone(), &mut force)
            .expect("the state is sound");
        let shells = triangular::vectors_within(1.05 * material.interaction.cutoff() / material.spacing);
        let is_inside = |site: [i32; 2]| {
            let mut neighbours = shells.iter().map(|v| [site[0] + v[0], site[1] + v[1]]);
            neighbours.all(|site| mesh.sites.index(site).is_some())
        };
        for (element, _) in mesh
            .elements
            .iter()
            .enumerate()
            .filter(|(_, e)| e.sites().all(is_inside))
        {
            for node in mesh.nodes_of(element) {
                let size = force[0][node].abs().max(force[1][node].abs());
                worst = worst.max(size / bond_strength(material));
                looked_at += 1.0;
            }
        }
    }
    assert!(looked_at > 5e3, "only {looked_at} nodes are inside");
    worst
}
