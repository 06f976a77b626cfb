//! Bloch analysis of triangles from its definition, with nothing of cgaft in it.
//!
//! Every site moves as the shape functions of its triangle say. Stretching the springs between nearest neighbours gives
//! the stiffness matrix of a cell, the squared speeds of its sites the mass matrix; the phases of a wave tie the cell to
//! its neighbours. Lengths are in spacings, site (i, j) stands at x = i + j/2, y = j sqrt(3)/2.

use std::f64::consts::{PI, TAU};

use nalgebra::{Complex, DMatrix, DVector};

/// Stiffness of a bond, phi''(r0) = 72/r0^2 with r0 = 2^(1/6), in reduced units; the mass of an atom is 1.
pub fn spring() -> f64 {
    72.0 / 2f64.cbrt()
}

/// How one row of triangles lies on the one below.
#[derive(Clone, Copy)]
pub enum Stacking {
    /// Half an edge to the right, then back: two rows, four triangles in a cell.
    ToAndFro,
    /// Always to the right: one row, two triangles in a cell.
    OneSided,
}

/// Two nodes and two sites weigh in on one bond: components of the cell, the periods to the cell they are in, weights.
struct Stretch(Vec<(usize, [i32; 2], f64)>);

/// The cell that repeats.
pub struct Reference {
    size: i32,
    stacking: Stacking,
    /// Corner sites of every triangle.
    triangles: Vec<[[i32; 2]; 3]>,
    bonds: Vec<Stretch>,
    /// Cholesky factor of the mass matrix, M = L L^T, and its inverse.
    root: DMatrix<Complex<f64>>,
    inverse: DMatrix<Complex<f64>>,
}

impl Reference {
    /// `size`: sites along an edge; `consistent`: share of the consistent mass matrix, the rest is lumped.
    pub fn new(size: i32, stacking: Stacking, consistent: f64) -> Self {
        let rows = match stacking {
            Stacking::ToAndFro => 2,
            Stacking::OneSided => 1,
        };
        let last = size - 1;
        let triangles = (0..rows).flat_map(|row| {
            let up = [[0, 0], [last, 0], [0, last]];
            let down = [[size, last], [1, last], [size, 0]];
            [up, down].map(|corners| corners.map(|[i, j]| [i, j + row * size]))
        });
        let mut reference = Self {
            size,
            stacking,
            triangles: triangles.collect(),
            bonds: Vec::new(),
            root: DMatrix::zeros(0, 0),
            inverse: DMatrix::zeros(0, 0),
        };
        let sites: Vec<[i32; 2]> = (0..rows * size).flat_map(|j| (0..=size).map(move |i| [i, j])).collect();
        let bonds = sites
            .iter()
            .flat_map(|&site| [[1, 0], [0, 1], [-1, 1]].map(|bond| (site, bond)));
        reference.bonds = bonds.map(|(site, bond)| reference.stretch(site, bond)).collect();
        let mass = reference.mass(&sites, consistent);
        let root = mass.cholesky().expect("masses are positive").l();
        let inverse = root.clone().try_inverse().expect("masses are positive");
        [reference.root, reference.inverse] = [root, inverse].map(|matrix| matrix.map(Complex::from));
        reference
    }

    /// Periods in lattice coordinates: one cell to the right, one up.
    fn periods(&self) -> [[i32; 2]; 2] {
        let up = match self.stacking {
            Stacking::ToAndFro => [-self.size, 2 * self.size],
            Stacking::OneSided => [0, self.size],
        };
        [[self.size + 1, 0], up]
    }

    /// Nodes that carry a site, with the periods to their cell and their shape functions.
    fn carriers(&self, [i, j]: [i32; 2]) -> [(usize, [i32; 2], f64); 3] {
        let [[right, _], [slant, up]] = self.periods();
        let v = j.div_euclid(up);
        let u = (i - v * slant).div_euclid(right);
        let home = [i - v * slant - u * right, j - v * up];
        let found = self.triangles.iter().enumerate().find_map(|(triangle, corners)| {
            let weights = area_coordinates(*corners, home);
            let is_inside = weights.iter().all(|&weight| weight >= 0.0);
            is_inside.then(|| [0, 1, 2].map(|k| (3 * triangle + k, [u, v], weights[k])))
        });
        found.expect("every site lies in a triangle")
    }

    /// By how much a bond becomes longer, along itself.
    fn stretch(&self, [i, j]: [i32; 2], bond: [i32; 2]) -> Stretch {
        let direction = place(bond);
        let ends = [([i + bond[0], j + bond[1]], 1.0), ([i, j], -1.0)];
        let parts = ends.iter().flat_map(|&(site, sign)| {
            let carriers = self.carriers(site);
            carriers.map(|(node, periods, weight)| {
                [0, 1].map(|axis| (2 * node + axis, periods, sign * weight * direction[axis]))
            })
        });
        Stretch(parts.flatten().collect())
    }

    /// N^T N over all sites, blended with its row sums on the diagonal.
    fn mass(&self, sites: &[[i32; 2]], consistent: f64) -> DMatrix<f64> {
        let components = 6 * self.triangles.len();
        let mut mass = DMatrix::zeros(components, components);
        for &site in sites {
            let carriers = self.carriers(site);
            for (a, _, first) in carriers {
                for (b, _, second) in carriers {
                    for axis in 0..2 {
                        mass[(2 * a + axis, 2 * b + axis)] += consistent * first * second;
                        mass[(2 * a + axis, 2 * a + axis)] += (1.0 - consistent) * first * second;
                    }
                }
            }
        }
        mass
    }

    /// Squared frequencies and modes, L^T U, of a wave by its phase over either period.
    fn modes(&self, phases: [f64; 2]) -> (Vec<f64>, DMatrix<Complex<f64>>) {
        let components = 6 * self.triangles.len();
        let mut stiffness = DMatrix::<Complex<f64>>::zeros(components, components);
        for Stretch(parts) in &self.bonds {
            let waves: Vec<(usize, Complex<f64>)> = parts
                .iter()
                .map(|&(component, [u, v], weight)| {
                    let phase = f64::from(u) * phases[0] + f64::from(v) * phases[1];
                    (component, Complex::from_polar(1.0, phase) * weight)
                })
                .collect();
            for &(a, first) in &waves {
                for &(b, second) in &waves {
                    stiffness[(a, b)] += first.conj() * second * spring();
                }
            }
        }
        let modes = (&self.inverse * stiffness * self.inverse.adjoint()).symmetric_eigen();
        (modes.eigenvalues.iter().copied().collect(), modes.eigenvectors)
    }

    /// Frequency of the mode that shares most of its kinetic energy with the plane wave of this displacement; the wave
    /// vector in inverse spacings.
    pub fn frequency(&self, wave: [f64; 2], displacement: [f64; 2]) -> f64 {
        let phase = |[x, y]: [f64; 2]| wave[0] * x + wave[1] * y;
        let (squared, modes) = self.modes(self.periods().map(|period| phase(place(period))));
        let nodes = self.triangles.iter().flatten();
        let plane = nodes.flat_map(|&corner| displacement.map(|part| Complex::from_polar(part, phase(place(corner)))));
        let plane = self.root.adjoint() * DVector::from_iterator(6 * self.triangles.len(), plane);
        let shared = (modes.adjoint() * plane).map(|part| part.norm_sqr());
        squared[shared.imax()].sqrt()
    }

    /// Highest frequency among waves whose phases over the periods are multiples of a twelfth of a turn.
    pub fn highest(&self) -> f64 {
        const TURN: i32 = 12;
        let steps = (0..TURN).flat_map(|i| (0..TURN).map(move |j| [i, j]));
        let squared = steps.flat_map(|steps| self.modes(steps.map(|step| TAU * f64::from(step) / f64::from(TURN))).0);
        squared.fold(0.0, f64::max).sqrt()
    }
}

fn place([i, j]: [i32; 2]) -> [f64; 2] {
    [f64::from(i) + 0.5 * f64::from(j), f64::from(j) * (PI / 3.0).sin()]
}

/// Shares of three corners in a site.
fn area_coordinates([a, b, c]: [[i32; 2]; 3], site: [i32; 2]) -> [f64; 3] {
    let area = |p: [i32; 2], q: [i32; 2], r: [i32; 2]| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    let whole = f64::from(area(a, b, c));
    [area(site, b, c), area(a, site, c), area(a, b, site)].map(|part| f64::from(part) / whole)
}
