//! Waves through an endless crystal of blocks: their frequencies beside those of long waves.

use nalgebra::{DMatrix, Matrix3, SymmetricEigen, Vector3};

use super::*;
use crate::lattice::fcc;
use crate::mesh::solid::element::Element;

/// How far nodes are moved to find the stiffness, in spacings, and what that leaves of second order.
const MOVED: f64 = 1e-5;

/// The bound is that of elements one by one; the step that it leaves is shorter than need be by no more than this.
const LOOSE: f64 = 1.2;

/// The table has one digit after the point.
const PRINTED: f64 = 0.06;

/// The stiffness between the nodes of the block in the middle of 27 and those of each of them.
struct Stiffness {
    /// For each block where it is from the one in the middle, nm, and its 42 x 42 numbers.
    blocks: Vec<([f64; 3], DMatrix<f64>)>,
    /// Lumped and consistent masses of the nodes of a block, 14 x 14, site by site: [Deng2011] Eq. (3-29).
    masses: [DMatrix<f64>; 2],
    bound: Box<dyn Fn(f64) -> f64>,
}

impl Stiffness {
    fn new(material: Material, size: u16) -> Self {
        let n = i32::from(size);
        let mesh = solid([3 * n; 3], size, vec![], vec![], material.spacing);
        let nodes_of_block = |block: [i32; 3]| -> Vec<usize> {
            let of = |shape| {
                let anchor = block.map(|number| number * n);
                let mut elements = 0..mesh.elements.len();
                elements
                    .find(|&element| mesh.elements[element].anchor == anchor && mesh.elements[element].shape == shape)
            };
            let parts = Shape::OF_BLOCK.map(|shape| of(shape).expect("the block is there"));
            parts.into_iter().flat_map(|part| mesh.nodes_of(part)).collect()
        };
        let middle = nodes_of_block([1; 3]);
        let mut forces = Forces::new(mesh.clone(), material);
        let mut position = mesh.node_positions();
        let mut response = |node: usize, axis: usize| {
            let mut moved = |way: f64| {
                position[axis][node] += way;
                let mut force = [0, 1, 2].map(|_| vec![0.0; mesh.node_count()]);
                forces.compute(&mut position, &mut force).expect("nothing flies away");
                position[axis][node] -= way;
                force
            };
            let step = MOVED * material.spacing;
            let [ahead, back] = [moved(step), moved(-step)];
            move |other: usize, along: usize| (back[along][other] - ahead[along][other]) / (2.0 * step)
        };
        let columns: Vec<_> = middle
            .iter()
            .flat_map(|&node| [0, 1, 2].map(|axis| (node, axis)))
            .collect();
        let responses: Vec<_> = columns.iter().map(|&(node, axis)| response(node, axis)).collect();
        let blocks = (0..27).map(|number| {
            let block = [number % 3, number / 3 % 3, number / 9];
            let nodes = nodes_of_block(block);
            let away = mesh.sites.frame.place(block.map(|component| (component - 1) * n));
            let stiffness = DMatrix::from_fn(42, 42, |row, column| responses[column](nodes[row / 3], row % 3));
            (away, stiffness)
        });
        let blocks = blocks.collect();
        let mut masses = [0, 1].map(|_| DMatrix::zeros(14, 14));
        let mut first = 0;
        for element in Shape::OF_BLOCK.map(|shape| Element {
            shape,
            size: n,
            anchor: [0; 3],
        }) {
            for weights in element.locals().map(|local| element.shape_functions(local)) {
                for i in 0..element.shape.node_count() {
                    masses[0][(first + i, first + i)] += material.site_mass * weights[i];
                    for j in 0..element.shape.node_count() {
                        masses[1][(first + i, first + j)] += material.site_mass * weights[i] * weights[j];
                    }
                }
            }
            first += element.shape.node_count();
        }
        let at_rest = mesh.node_positions();
        let bound = move |consistent: f64| {
            let forces = Forces::new(mesh.clone(), material).with_consistent_mass(consistent);
            forces.squared_frequency_bound(&at_rest).sqrt()
        };
        Self {
            blocks,
            masses,
            bound: Box::new(bound),
        }
    }

    /// What nodes of the block in the middle and of others pull at each other with, over their masses, of which a share is
    /// consistent: roots of masses on both sides.
    fn over_masses(&self, consistent: f64) -> Vec<([f64; 3], DMatrix<f64>)> {
        let [lumped, coupled] = &self.masses;
        let SymmetricEigen {
            eigenvectors,
            eigenvalues,
        } = SymmetricEigen::new((1.0 - consistent) * lumped + consistent * coupled);
        let roots = DMatrix::from_diagonal(&eigenvalues.map(|value| 1.0 / value.sqrt()));
        let root = (&eigenvectors * roots * eigenvectors.transpose()).kronecker(&DMatrix::identity(3, 3));
        let blocks = self.blocks.iter();
        blocks
            .map(|(away, stiffness)| (*away, &root * stiffness * &root))
            .collect()
    }
}

/// The three lowest frequencies of waves with this wave vector, 1/nm, the slowest first.
fn frequencies(blocks: &[([f64; 3], DMatrix<f64>)], wave: [f64; 3]) -> [f64; 3] {
    // A Hermitian matrix of 42 as a symmetric one of 84, whose eigenvalues are the same, each twice.
    let mut matrix = DMatrix::<f64>::zeros(84, 84);
    for (away, stiffness) in blocks {
        let phase: f64 = away.iter().zip(wave).map(|(away, wave)| away * wave).sum();
        let [real, imaginary] = [phase.cos(), phase.sin()];
        for row in 0..42 {
            for column in 0..42 {
                let value = stiffness[(row, column)];
                matrix[(row, column)] += real * value;
                matrix[(row + 42, column + 42)] += real * value;
                matrix[(row + 42, column)] += imaginary * value;
                matrix[(row, column + 42)] -= imaginary * value;
            }
        }
    }
    let symmetric = 0.5 * (&matrix + matrix.transpose());
    let mut squares: Vec<f64> = SymmetricEigen::new(symmetric).eigenvalues.iter().copied().collect();
    squares.sort_unstable_by(f64::total_cmp);
    [squares[0], squares[2], squares[4]].map(f64::sqrt)
}

/// Frequencies of waves among atoms along a direction of the cube, with so many radians a nm, the slowest first.
fn of_atoms(material: Material, direction: [f64; 3], number: f64) -> [f64; 3] {
    let length = direction
        .iter()
        .map(|component| component * component)
        .sum::<f64>()
        .sqrt();
    let stiffness = material.interaction.curvature(material.spacing) / material.site_mass;
    let mut matrix = Matrix3::zeros();
    for bond in fcc::NEAREST.map(|bond| Vector3::from(fcc::in_the_cube(bond))) {
        let along: f64 = bond
            .iter()
            .zip(direction)
            .map(|(bond, direction)| bond * direction / length)
            .sum();
        let phase = number * material.spacing * along;
        matrix += bond * bond.transpose() * (2.0 * stiffness * (1.0 - phase.cos()));
    }
    let mut squares: [f64; 3] = SymmetricEigen::new(matrix).eigenvalues.into();
    squares.sort_unstable_by(f64::total_cmp);
    squares.map(f64::sqrt)
}

#[test]
fn the_hybrid_element_slows_and_hastens_waves_as_its_bloch_waves_were_found_to_with_each_mass() {
    // Errors in per cent with lumped and consistent mass and a blend, n = 10 and nearest neighbours, at 40 and 80 spacings, against atoms at the same
    // wavelength; the slowest wave first.
    let material = material(SHORT);
    let stiffness = Stiffness::new(material, 10);
    let lengths = material.spacing;
    // In the frame of blocks the cube's edges lie obliquely: a1 is [011], a2 [101], a3 [110].
    let frame = Frame::of_blocks(lengths);
    let in_frame = |[x, y, z]: [f64; 3]| {
        // A direction of the cube by lattice vectors: x = (j + k)/sqrt(2) and so on.
        let site = [0.5 * (y + z - x), 0.5 * (x + z - y), 0.5 * (x + y - z)];
        let place = frame.place_between(site);
        let length = place.iter().map(|component| component * component).sum::<f64>().sqrt();
        place.map(|component| component / length)
    };
    let waves = [
        ([1.0, 0.0, 0.0], 40.0),
        ([1.0, 0.0, 0.0], 80.0),
        ([1.0, 1.0, 0.0], 40.0),
        ([1.0, 1.0, 1.0], 40.0),
    ];
    let tables: [(f64, [[f64; 3]; 4]); 3] = [
        (
            0.0,
            [
                [-5.3, -5.3, -6.9],
                [-1.4, -1.4, -1.7],
                [-3.0, -3.8, -6.5],
                [-4.7, -4.7, -5.1],
            ],
        ),
        (
            1.0,
            [[3.7, 3.7, 2.3], [0.9, 0.9, 0.6], [6.2, 5.4, 3.0], [4.6, 4.6, 4.0]],
        ),
        (
            0.6,
            [[-0.1, -0.1, -1.5], [0.0, 0.0, -0.4], [2.3, 1.4, -1.0], [0.6, 0.6, 0.2]],
        ),
    ];
    for (consistent, table) in tables {
        let blocks = stiffness.over_masses(consistent);
        for ((direction, wavelength), errors) in waves.into_iter().zip(table) {
            let number = std::f64::consts::TAU / (wavelength * lengths);
            let found = frequencies(&blocks, in_frame(direction).map(|component| component * number));
            let atoms = of_atoms(material, direction, number);
            for ((found, atoms), expected) in found.into_iter().zip(atoms).zip(errors) {
                let error = 100.0 * (found / atoms - 1.0);
                assert!(
                    (error - expected).abs() < PRINTED,
                    "{consistent} consistent, {direction:?} at {wavelength}: {error} for {expected}"
                );
            }
        }
    }
}

#[test]
fn no_element_has_a_zero_mode_and_no_wave_is_faster_than_the_bound_whatever_the_masses() {
    let material = material(SHORT);
    let stiffness = Stiffness::new(material, 10);
    // The highest frequencies of all waves were found to be 9.90, and 10.38 with six tenths of the consistent mass, where atoms
    // have 21.38.
    for (consistent, most) in [(0.0, 9.91), (0.6, 10.39), (1.0, f64::INFINITY)] {
        let blocks = stiffness.over_masses(consistent);
        let mut highest = 0.0f64;
        for wave in [[0.0; 3], [0.1, 0.2, 0.3], [1.2, -0.4, 0.0], [0.0, 0.0, 1.5]] {
            let matrix = blocks.iter().fold(DMatrix::<f64>::zeros(42, 42), |sum, (away, block)| {
                let phase: f64 = away.iter().zip(wave).map(|(away, wave)| away * wave).sum();
                sum + block * phase.cos()
            });
            let symmetric = 0.5 * (&matrix + matrix.transpose());
            let mut squares: Vec<f64> = SymmetricEigen::new(symmetric).eigenvalues.iter().copied().collect();
            squares.sort_unstable_by(f64::total_cmp);
            if wave == [0.0; 3] {
                // In the middle of the zone nothing moves for nothing but the whole.
                assert!(squares[2].abs() < 1e-6 && squares[3] > 0.1, "{squares:?}");
            }
            highest = highest.max(squares[41].sqrt());
        }
        let bound = (stiffness.bound)(consistent);
        assert!(highest < most && highest > 9.0, "{consistent}: {highest}");
        assert!(
            highest <= bound && bound < LOOSE * highest,
            "{consistent}: {highest}, bound {bound}"
        );
    }
}
