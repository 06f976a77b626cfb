//! Dispersion of triangles of several sizes against a table of independent Bloch analyses.
//!
//! Displacing the nodes of one cell one by one, and looking at the forces on it and its neighbours, gives the force
//! constants; with the phases of a wave they make the matrix whose eigenvalues are the squared frequencies.

use cgaft::forces::Forces;
use cgaft::lattice::triangular;
use cgaft::material::Material;
use cgaft::mesh::Mesh;
use cgaft::state::State;
use nalgebra::{Complex, DMatrix, DVector};

use super::torus::{moved, numbered};
use super::{block_mesh, smooth, zeros};
use crate::verify::table::{Chapter, Gate};

/// The lattice repeats after one cell along the rows and after two element rows.
fn periods(size: i32) -> [[i32; 2]; 2] {
    [[size + 1, 0], [-size, 2 * size]]
}

/// Force constants between one cell and all cells near it.
struct Bloch {
    /// Response of node component b in the cell shifted by a vector to component a of the first: (b, a, vector, value).
    constants: Vec<(usize, usize, [f64; 2], f64)>,
    /// Lumped mass and reference place of every node of the cell.
    nodes: Vec<(f64, [f64; 2])>,
    /// What the masses of two nodes of a triangle share, over the lumped mass of one.
    coupling: f64,
}

impl Bloch {
    /// `consistent`: share of the consistent mass matrix.
    fn new(size: i32, material: &Material, consistent: f64) -> Self {
        const STEP: f64 = 1e-5;
        let mesh = block_mesh(size, 6, 9, size as u16, material.spacing);
        let cell = cell(&mesh, size);
        let masses = mesh.lumped_masses();
        let mut position = mesh.node_positions();
        let nodes: Vec<usize> = cell.iter().flat_map(|&element| 3 * element..3 * element + 3).collect();
        let images = images(&mesh, size, &cell);
        let mut forces = Forces::new(mesh.clone(), *material);
        let mut constants = Vec::new();
        for (a, &node) in nodes.iter().enumerate() {
            for axis in 0..2 {
                let place = position[axis][node];
                let [below, above] = [-STEP, STEP].map(|step| {
                    position[axis][node] = place + step;
                    let mut force = zeros(&mesh);
                    forces.compute(&position, &mut force).expect("the patch is sound");
                    force
                });
                position[axis][node] = place;
                for &(image, b, vector) in &images {
                    for other in 0..2 {
                        let value = (below[other][image] - above[other][image]) / (2.0 * STEP);
                        if value != 0.0 {
                            constants.push((2 * b + other, 2 * a + axis, vector, value));
                        }
                    }
                }
            }
        }
        let nodes = nodes
            .iter()
            .map(|&node| (masses[node], [position[0][node], position[1][node]]));
        Self {
            constants,
            nodes: nodes.collect(),
            coupling: consistent * mesh.elements[cell[0]].mass_coupling(),
        }
    }

    /// A power of the mass matrix, by the eigenvalues of a triangle's block: the lumped mass for the mean of its nodes,
    /// and 1 - 3 c of it for what they move against each other.
    fn mass_to_the(&self, power: f64) -> DMatrix<Complex<f64>> {
        let size = 2 * self.nodes.len();
        DMatrix::from_fn(size, size, |row, column| {
            let same_triangle = row / 6 == column / 6 && row % 2 == column % 2;
            let mean = self.nodes[row / 2].0.powf(power);
            let apart = mean * (1.0 - 3.0 * self.coupling).powf(power);
            let shared = if same_triangle { (mean - apart) / 3.0 } else { 0.0 };
            Complex::new(shared + if row == column { apart } else { 0.0 }, 0.0)
        })
    }

    /// Squared frequencies and modes of a wave vector.
    fn modes(&self, wave: [f64; 2]) -> (Vec<f64>, DMatrix<Complex<f64>>) {
        let size = 2 * self.nodes.len();
        let mut matrix = DMatrix::<Complex<f64>>::zeros(size, size);
        for &(b, a, [x, y], value) in &self.constants {
            let phase = Complex::from_polar(1.0, -(wave[0] * x + wave[1] * y));
            matrix[(b, a)] += phase * value;
        }
        let root = self.mass_to_the(-0.5);
        let matrix = &root * matrix * &root;
        let matrix = (&matrix + matrix.adjoint()) * Complex::new(0.5, 0.0);
        let modes = matrix.symmetric_eigen();
        (modes.eigenvalues.iter().copied().collect(), modes.eigenvectors)
    }

    /// Frequency of the mode that is most like the plane wave with this displacement.
    fn frequency(&self, wave: [f64; 2], displacement: [f64; 2]) -> f64 {
        let (squared, modes) = self.modes(wave);
        let plane: Vec<Complex<f64>> = self
            .nodes
            .iter()
            .flat_map(|&(_, [x, y])| {
                let phase = Complex::from_polar(1.0, wave[0] * x + wave[1] * y);
                displacement.map(|part| phase * part)
            })
            .collect();
        let plane = self.mass_to_the(0.5) * DVector::from_vec(plane);
        let likeness = |mode: usize| {
            let column = modes.column(mode);
            let overlap = column.iter().zip(plane.iter()).map(|(a, b)| a.conj() * b);
            overlap.sum::<Complex<f64>>().norm_sqr()
        };
        let best = (0..squared.len()).max_by(|&a, &b| likeness(a).total_cmp(&likeness(b)));
        squared[best.expect("there are modes")].sqrt()
    }

    /// Highest frequency over the Brillouin zone.
    fn highest(&self, size: i32, spacing: f64) -> f64 {
        const GRID: i32 = 12;
        let [a, b] = periods(size).map(|vector| triangular::position(vector).map(|part| part * spacing));
        // The second period is along y, so the reciprocal vectors are along the axes.
        let steps = |period: f64| 2.0 * std::f64::consts::PI / (f64::from(GRID) * period);
        let [step_x, step_y] = [steps(a[0]), steps(b[1])];
        let waves = (0..GRID).flat_map(|i| (0..GRID).map(move |j| [f64::from(i) * step_x, f64::from(j) * step_y]));
        let squared = waves.map(|wave| self.modes(wave).0.into_iter().fold(0.0, f64::max));
        squared.fold(0.0, f64::max).sqrt()
    }
}

/// Two triangles in each of two element rows, in the middle of the patch.
fn cell(mesh: &Mesh, size: i32) -> Vec<usize> {
    let rows = [2 * size, 3 * size];
    let middle = triangular::position([4 * (size + 1) / 2 + size, 0])[0];
    let mut cell = Vec::new();
    for row in rows {
        for sign in [1, -1] {
            let candidates = (0..mesh.triangles).filter(|&number| {
                let element = &mesh.elements[number];
                element.sign == sign && element.lowest_row() == row
            });
            let distance = |&number: &usize| {
                let element = &mesh.elements[number];
                (triangular::position([element.column, element.row])[0] - middle).abs()
            };
            cell.extend(candidates.min_by(|a, b| distance(a).total_cmp(&distance(b))));
        }
    }
    cell
}

/// Node, its number in the cell, and by how much its cell is shifted.
fn images(mesh: &Mesh, size: i32, cell: &[usize]) -> Vec<(usize, usize, [f64; 2])> {
    let numbers = numbered(mesh);
    let [along, across] = periods(size);
    let mut images = Vec::new();
    for (place, &element) in cell.iter().enumerate() {
        for i in -4..=4 {
            for j in -2..=2 {
                let vector = [i * along[0] + j * across[0], i * along[1] + j * across[1]];
                if let Some(&image) = numbers.get(&moved(&mesh.elements[element], vector)) {
                    let shift = triangular::position(vector).map(|part| part * mesh.spacing);
                    images.extend((0..3).map(|k| (3 * image + k, 3 * place + k, shift)));
                }
            }
        }
    }
    images
}

/// Longitudinal frequency of the lattice of atoms along a row: two bonds along it and four at 60 degrees.
fn lattice_frequency(stiffness: f64, phase: f64) -> f64 {
    (2.0 * stiffness * (1.0 - phase.cos()) + stiffness * (1.0 - (0.5 * phase).cos())).sqrt()
}

const WAVELENGTHS: [f64; 5] = [200.0, 100.0, 60.0, 40.0, 30.0];

/// Numbers with half of their last digit.
type Printed = [(f64, f64); WAVELENGTHS.len()];

/// Atoms an edge, highest frequency (of this arrangement of the triangles, rows shifted to and fro; rows all shifted to
/// one side reach 0.2 to 0.6 % higher), percent by which longitudinal waves along the rows are slow at each wavelength,
/// and half of the last digit that each was printed with.
const TABLE: [(i32, f64, Printed); 5] = [
    (
        4,
        12.1996,
        [(-0.02, 0.005), (-0.1, 0.05), (-0.3, 0.05), (-0.6, 0.05), (-1.1, 0.05)],
    ),
    (
        7,
        9.5945,
        [(-0.1, 0.05), (-0.5, 0.05), (-1.3, 0.05), (-3.0, 0.05), (-5.5, 0.05)],
    ),
    (
        10,
        8.1780,
        [(-0.28, 0.005), (-1.1, 0.05), (-3.2, 0.05), (-7.3, 0.05), (-13.6, 0.05)],
    ),
    (
        13,
        7.2492,
        [(-0.5, 0.05), (-2.1, 0.05), (-5.8, 0.05), (-13.0, 0.5), (-25.0, 0.5)],
    ),
    (
        20,
        5.9204,
        [(-1.3, 0.05), (-5.3, 0.05), (-15.0, 0.5), (-34.0, 0.5), (-52.0, 0.5)],
    ),
];

/// One of the last digit of a frequency in the table.
const PRINTED_FREQUENCY: f64 = 1e-4;

#[test]
fn waves_through_triangles_are_as_slow_as_bloch_analysis_says() {
    let mut gate = Gate::new(Chapter::Waves, "2 dispersion");
    let material = smooth();
    let stiffness = material.interaction.curvature(material.spacing);
    for (size, highest, slow) in TABLE {
        let bloch = Bloch::new(size, &material, 0.0);
        let setting = format!("nearest neighbours, n = {size}, lumped mass");
        gate.near(
            "highest frequency",
            &setting,
            bloch.highest(size, material.spacing),
            highest,
            PRINTED_FREQUENCY,
        );
        for (wavelength, (expected, digit)) in WAVELENGTHS.into_iter().zip(slow) {
            let phase = 2.0 * std::f64::consts::PI / wavelength;
            let wave = phase / material.spacing;
            let found = bloch.frequency([wave, 0.0], [1.0, 0.0]) / lattice_frequency(stiffness, phase);
            let claim = format!("c_L along a row at {wavelength} r0, percent off the lattice");
            // Shorter than two cells a wave is no longer told from its images.
            if wavelength > 2.0 * f64::from(size + 1) {
                gate.near(&claim, &setting, 100.0 * (found - 1.0), expected, digit);
            }
        }
        // Speeds in the other directions, for which the table has no digits.
        let phase = 2.0 * std::f64::consts::PI / 60.0;
        let wave = phase / material.spacing;
        for (name, wave, displacement) in [
            ("c_L across the rows", [0.0, wave], [0.0, 1.0]),
            ("c_T along a row", [wave, 0.0], [0.0, 1.0]),
            ("c_T across the rows", [0.0, wave], [1.0, 0.0]),
        ] {
            let long = if name.starts_with("c_L") { 9.0 } else { 27f64.sqrt() };
            let found = bloch.frequency(wave, displacement) / (long * phase / material.spacing);
            let claim = format!("{name} at 60 r0, percent off the longest waves");
            gate.report(&claim, &setting, 100.0 * (found - 1.0));
        }
    }
    gate.close();
}

/// Frequency of the lattice of atoms across a row: what moves so stretches four bonds at 60 degrees.
fn transverse_lattice_frequency(stiffness: f64, phase: f64) -> f64 {
    (3.0 * stiffness * (1.0 - (0.5 * phase).cos())).sqrt()
}

/// Share of the consistent mass matrix, and percent by which transverse waves of 60 spacings along the rows are off, for
/// n = 10. Rows all shifted to one side, from which numbers rounded to -1.5 and 1.4 are known, have -1.49263 and 1.38418:
/// these are of the arrangement here, shifted to and fro, by the same independent analysis.
const TRANSVERSE: [(f64, f64); 2] = [(0.0, -1.44135), (0.6, 1.43504)];
/// One of the last digit.
const PRINTED_TRANSVERSE: f64 = 1e-5;

#[test]
fn transverse_waves_through_triangles_are_as_fast_as_bloch_analysis_says() {
    let mut gate = Gate::new(Chapter::Waves, "2 dispersion, transverse");
    let material = smooth();
    let stiffness = material.interaction.curvature(material.spacing);
    let phase = 2.0 * std::f64::consts::PI / 60.0;
    for (consistent, expected) in TRANSVERSE {
        let bloch = Bloch::new(10, &material, consistent);
        let found = bloch.frequency([phase / material.spacing, 0.0], [0.0, 1.0]);
        let found = found / transverse_lattice_frequency(stiffness, phase);
        gate.near(
            "c_T along a row at 60 r0, percent off the lattice",
            &coupled(10, consistent),
            100.0 * (found - 1.0),
            expected,
            PRINTED_TRANSVERSE,
        );
    }
    gate.close();
}

/// Names a size of triangles and the share of their consistent mass matrix.
fn coupled(size: i32, consistent: f64) -> String {
    let mass = match consistent {
        0.0 => "lumped".to_owned(),
        _ => format!("{:.0} % consistent", 100.0 * consistent),
    };
    format!("nearest neighbours, n = {size}, {mass} mass")
}

#[test]
fn the_speed_of_waves_with_coupled_masses_through_other_triangles_is_reported() {
    let mut gate = Gate::new(Chapter::Waves, "4 dispersion with coupled masses, other sizes");
    let material = smooth();
    let phase = 2.0 * std::f64::consts::PI / 60.0;
    let wave = phase / material.spacing;
    for size in [4, 7, 13, 20] {
        for consistent in [0.6, 1.0] {
            let bloch = Bloch::new(size, &material, consistent);
            for (name, direction) in [("along a row", [1.0, 0.0]), ("across the rows", [0.0, 1.0])] {
                let found = bloch.frequency(direction.map(|part| wave * part), direction) / (9.0 * wave);
                let claim = format!("c_L {name} at 60 r0, percent off the longest waves");
                gate.report(&claim, &coupled(size, consistent), 100.0 * (found - 1.0));
            }
        }
    }
    gate.close();
}

/// Share of the consistent mass matrix, and percent by which longitudinal waves along the rows are off, for n = 10. The
/// numbers belong to rows all shifted to one side: here the shortest waves differ by up to one of the last digit.
const COUPLED: [(f64, Printed); 3] = [
    (1.0, [(0.16, 0.005), (0.65, 0.005), (1.8, 0.05), (3.9, 0.1), (6.6, 0.1)]),
    (
        0.6,
        [
            (-0.01, 0.005),
            (-0.07, 0.005),
            (-0.25, 0.005),
            (-0.9, 0.05),
            (-2.6, 0.1),
        ],
    ),
    (
        2.0 / 3.0,
        [(0.02, 0.005), (0.05, 0.005), (0.09, 0.005), (-0.1, 0.05), (-1.1, 0.05)],
    ),
];

#[test]
fn coupled_masses_speed_up_the_waves_as_bloch_analysis_says() {
    let mut gate = Gate::new(Chapter::Waves, "3 dispersion with coupled masses");
    let material = smooth();
    let stiffness = material.interaction.curvature(material.spacing);
    for (consistent, fast) in COUPLED {
        let bloch = Bloch::new(10, &material, consistent);
        let setting = coupled(10, consistent);
        for (wavelength, (expected, digit)) in WAVELENGTHS.into_iter().zip(fast) {
            let phase = 2.0 * std::f64::consts::PI / wavelength;
            let found = bloch.frequency([phase / material.spacing, 0.0], [1.0, 0.0]);
            let found = found / lattice_frequency(stiffness, phase);
            let claim = format!("c_L along a row at {wavelength} r0, percent off the lattice");
            gate.near(&claim, &setting, 100.0 * (found - 1.0), expected, digit);
        }
        gate.below(
            "highest frequency over the bound by which the time step is chosen",
            &setting,
            bloch.highest(10, material.spacing) / frequency_bound(&material, consistent),
            1.0,
        );
    }
    gate.close();
}

fn frequency_bound(material: &Material, consistent: f64) -> f64 {
    let mesh = block_mesh(10, 6, 9, 10, material.spacing);
    let mut state = State::at_rest(mesh.node_positions(), mesh.lumped_masses());
    state.couple_masses(
        mesh.mass_couplings()
            .into_iter()
            .map(|share| consistent * share)
            .collect(),
    );
    let mut forces = Forces::new(mesh, *material);
    forces
        .squared_frequency_bound(&state)
        .expect("the patch is sound")
        .sqrt()
}
