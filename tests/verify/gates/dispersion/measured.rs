//! Bloch analysis of the program itself: its forces and its kicks, looked at from outside.
//!
//! Displacing the nodes of one cell one by one, and looking at how it and its neighbours accelerate, gives the equations
//! of motion; with the phases of a wave they make the matrix whose eigenvalues are the squared frequencies.

use cgaft::forces::Forces;
use cgaft::integrator::kick;
use cgaft::lattice::triangular;
use cgaft::material::Material;
use cgaft::mesh::Mesh;
use cgaft::state::State;
use nalgebra::{Complex, DMatrix, DVector};

use crate::verify::gates::block_mesh;
use crate::verify::gates::torus::{moved, numbered};

/// The lattice repeats after one cell along the rows and after two element rows.
fn periods(size: i32) -> [[i32; 2]; 2] {
    [[size + 1, 0], [-size, 2 * size]]
}

/// How one cell and all cells near it answer to displacements of the one.
pub struct Measured {
    /// Acceleration of node component b in the cell shifted by a vector, for a displacement of component a of the first:
    /// (b, a, vector, value with the sign turned).
    answers: Vec<(usize, usize, [f64; 2], f64)>,
    /// Lumped mass and reference place of every node of the cell.
    nodes: Vec<(f64, [f64; 2])>,
    /// What the masses of two nodes of a triangle share, over the lumped mass of one.
    coupling: f64,
    /// What the time step is chosen by.
    pub frequency_bound: f64,
}

impl Measured {
    /// `consistent`: share of the consistent mass matrix.
    pub fn new(size: i32, material: &Material, consistent: f64) -> Self {
        const STEP: f64 = 1e-5;
        let mesh = block_mesh(size, 6, 9, size as u16, material.spacing);
        let cell = cell(&mesh, size);
        let mut state = State::at_rest(mesh.node_positions(), mesh.lumped_masses());
        state.couple_masses(&mesh, consistent);
        let nodes: Vec<usize> = cell.iter().flat_map(|&element| mesh.nodes_of(element)).collect();
        let images = images(&mesh, size, &cell);
        let mut forces = Forces::new(mesh, *material);
        forces.refresh(&state.position).expect("the patch is sound");
        let bound = forces.squared_frequency_bound(&state);
        let mut accelerations = |state: &mut State| {
            forces
                .compute(&mut state.position, &mut state.force)
                .expect("the patch is sound");
            state.velocity.iter_mut().for_each(|plane| plane.fill(0.0));
            kick(state, &state.every_node(), 1.0);
            state.velocity.clone()
        };
        let mut answers = Vec::new();
        for (a, &node) in nodes.iter().enumerate() {
            for axis in 0..2 {
                let place = state.position[axis][node];
                let [below, above] = [-STEP, STEP].map(|step| {
                    state.position[axis][node] = place + step;
                    accelerations(&mut state)
                });
                state.position[axis][node] = place;
                for &(image, b, vector) in &images {
                    for other in 0..2 {
                        let value = (below[other][image] - above[other][image]) / (2.0 * STEP);
                        if value != 0.0 {
                            answers.push((2 * b + other, 2 * a + axis, vector, value));
                        }
                    }
                }
            }
        }
        let places = nodes
            .iter()
            .map(|&node| (state.mass[node], [state.position[0][node], state.position[1][node]]));
        Self {
            answers,
            nodes: places.collect(),
            coupling: state.coupling_of(nodes[0]),
            frequency_bound: bound.sqrt(),
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
        for &(b, a, [x, y], value) in &self.answers {
            let phase = Complex::from_polar(1.0, -(wave[0] * x + wave[1] * y));
            matrix[(b, a)] += phase * value;
        }
        // Symmetric, as every system with an energy, only if accelerations belong to these masses.
        let matrix = self.mass_to_the(0.5) * matrix * self.mass_to_the(-0.5);
        let matrix = (&matrix + matrix.adjoint()) * Complex::new(0.5, 0.0);
        let modes = matrix.symmetric_eigen();
        (modes.eigenvalues.iter().copied().collect(), modes.eigenvectors)
    }

    /// Frequency of the mode that is most like the plane wave with this displacement.
    pub fn frequency(&self, wave: [f64; 2], displacement: [f64; 2]) -> f64 {
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
    pub fn highest(&self, size: i32, spacing: f64) -> f64 {
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
                    images.extend((0..3).map(|k| (mesh.node(image, k), 3 * place + k, shift)));
                }
            }
        }
    }
    images
}
