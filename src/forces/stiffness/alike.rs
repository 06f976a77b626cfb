//! The stiffness of triangles that follow each other in the mesh and are alike to their neighbours, side by side.

use multiversion::multiversion;
use nalgebra::Matrix6;

use super::{inside_weights, largest_eigenvalue};
use crate::forces::Forces;
use crate::forces::bulk::Reach;
use crate::forces::interface;
use crate::forces::lanes::Lanes;
use crate::forces::maps::MapLanes;
use crate::forces::summation::{Sample, SampledString};
use crate::potential::{CutPotential, PairShape};

/// Triangles computed at a time.
pub const WIDTH: usize = 8;

/// Blocks of the matrix on and above its diagonal, by their nodes; each is symmetric: xx, yy, xy.
const BLOCKS: [[usize; 2]; 6] = [[0, 0], [0, 1], [0, 2], [1, 1], [1, 2], [2, 2]];

/// xx, yy, xy of several triangles.
type Hessian = [Lanes<WIDTH>; 3];

/// Stiffnesses of triangles side by side.
#[derive(Default)]
struct Stiffness([Hessian; 6]);

/// How much larger than the largest known an eigenvalue may be and pass for it: more than rounding, and nothing to a
/// time step.
const SLACK: f64 = 1e-12;

/// A side of an interface as a triangle sees it.
struct Side {
    kind: u32,
    is_first: bool,
    neighbour: u32,
}

impl Forces {
    /// Whether the triangles from this one on have one size and their neighbours as if each were moved from the first,
    /// and none of them touches anything but intact interfaces.
    pub(super) fn are_alike(&self, from: usize, end: usize) -> bool {
        if from + WIDTH > end.min(self.mesh.triangles) {
            return false;
        }
        let size = self.mesh.elements[from].size;
        (from..from + WIDTH).all(|triangle| {
            let moved = (triangle - from) as u32;
            let same = self
                .sides(triangle)
                .map(|side| (side.kind, side.is_first, side.neighbour.wrapping_sub(moved)));
            self.mesh.elements[triangle].size == size
                && self.contacts.sites_of(triangle).is_empty()
                && self
                    .interfaces
                    .of(triangle)
                    .iter()
                    .all(|&number| !self.is_open(number as usize))
                && same.eq(self.sides(from).map(|side| (side.kind, side.is_first, side.neighbour)))
        })
    }

    /// The interfaces of a triangle that have strings.
    fn sides(&self, triangle: usize) -> impl Iterator<Item = Side> + '_ {
        let pairs = self
            .interfaces
            .of(triangle)
            .iter()
            .map(|&number| self.interfaces.pairs[number as usize]);
        let with_strings = pairs.filter(|pair| self.strings.are_there(pair.kind));
        with_strings.map(move |pair| {
            let is_first = pair.first as usize == triangle;
            Side {
                kind: pair.kind,
                is_first,
                neighbour: if is_first { pair.second } else { pair.first },
            }
        })
    }
}

/// The largest eigenvalue over the mass of triangles that are alike, from this one on, or `known` if none is larger;
/// `None` where their bonds are not all summed alike.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx2+fma", "x86_64+avx2+fma"))]
pub fn largest<S: PairShape>(
    forces: &Forces,
    law: &CutPotential<S>,
    from: usize,
    mass: f64,
    known: f64,
) -> Option<f64> {
    let stiffness = stiffness(forces, law, from)?;
    let is_below = stiffness.is_below(known * mass * (1.0 + SLACK));
    let others = (0..WIDTH).filter(|&lane| !is_below[lane]);
    Some(others.fold(known, |largest, lane| {
        largest.max(largest_eigenvalue(&stiffness.alone(lane), mass, largest))
    }))
}

#[inline(always)]
fn stiffness<S: PairShape>(forces: &Forces, law: &CutPotential<S>, from: usize) -> Option<Stiffness> {
    let element = &forces.mesh.elements[from];
    let spacing = forces.material.spacing;
    let own: MapLanes<WIDTH> = forces.maps.lanes(from);
    let reach = Reach {
        cutoff: law.cutoff(),
        spacing,
    };
    let mut sum = Stiffness::default();
    for bond in forces.bulk.within_all(element.size, &own, &reach)? {
        let weights = inside_weights(bond.local, element.size);
        let hessian = hessian(law, own.vector(bond.local), bond.count, |stiffness| stiffness);
        sum.add(|[a, b]| weights[a] * weights[b], &hessian);
    }
    for side in forces.sides(from) {
        let other: MapLanes<WIDTH> = forces.maps.lanes(side.neighbour as usize);
        let kind = &forces.interfaces.kinds[side.kind as usize];
        let [first, second] = if side.is_first { [&own, &other] } else { [&other, &own] };
        let squared_gap = interface::squared_gap(kind, first, second);
        let limit = forces.strings.hardly_open(spacing);
        let is_hardly_open = squared_gap[0] <= limit;
        if !squared_gap.every(|gap| (gap <= limit) == is_hardly_open) {
            return None;
        }
        for SampledString { string, samples } in forces.strings.of(side.kind, is_hardly_open) {
            let [a, b] = [first.at(string.first), second.at(string.second)];
            let [da, db] = [first.vector(string.first_step), second.vector(string.second_step)];
            let between = [b[0] - a[0], b[1] - a[1]];
            let moments = moments(law, between, [db[0] - da[0], db[1] - da[1]], samples);
            let (site, step) = if side.is_first {
                (string.first, string.first_step)
            } else {
                (string.second, string.second_step)
            };
            // Shape functions are linear along a string, their products quadratic.
            let start = element.shape_functions(site);
            let next = element.shape_functions([site[0] + step[0], site[1] + step[1]]);
            let change = [0, 1, 2].map(|k| next[k] - start[k]);
            sum.add(|[a, b]| start[a] * start[b], &moments[0]);
            sum.add(|[a, b]| start[a] * change[b] + change[a] * start[b], &moments[1]);
            sum.add(|[a, b]| change[a] * change[b], &moments[2]);
        }
    }
    Some(sum)
}

/// The sums over a string of what its bonds are worth against a wall, times the powers 0, 1 and 2 of the place along it.
#[inline(always)]
fn moments<S: PairShape>(
    law: &CutPotential<S>,
    start: [Lanes<WIDTH>; 2],
    step: [Lanes<WIDTH>; 2],
    samples: &[Sample],
) -> [Hessian; 3] {
    let mut moments = [Hessian::default(); 3];
    for &Sample { at, weight } in samples {
        let vector = [step[0].times_add(at, start[0]), step[1].times_add(at, start[1])];
        let hessian = hessian(law, vector, weight, |stiffness| 2.0 * stiffness.max(0.0));
        let powers = [1.0, at, at * at];
        for order in 0..3 {
            for k in 0..3 {
                moments[order][k] = hessian[k].times_add(powers[order], moments[order][k]);
            }
        }
    }
    moments
}

/// Second derivatives of the energies of bonds, each counting so many times.
#[inline(always)]
fn hessian<S: PairShape>(
    law: &CutPotential<S>,
    [x, y]: [Lanes<WIDTH>; 2],
    count: f64,
    bound: impl Fn(f64) -> f64,
) -> Hessian {
    let squared = x.mul_add(x, y * y);
    let curvatures = law.curvatures(squared.0);
    let slopes = law.slopes(squared.0);
    let [mut along, mut across, mut difference] = [Lanes::<WIDTH>::default(); 3];
    for lane in 0..WIDTH {
        along.0[lane] = bound(count * curvatures[lane]);
        across.0[lane] = bound(count * slopes[lane]);
        difference.0[lane] = (along[lane] - across[lane]) / squared[lane];
    }
    [
        (difference * x).mul_add(x, across),
        (difference * y).mul_add(y, across),
        difference * x * y,
    ]
}

impl Stiffness {
    #[inline(always)]
    fn add(&mut self, weight: impl Fn([usize; 2]) -> f64, hessian: &Hessian) {
        for block in 0..BLOCKS.len() {
            let weight = weight(BLOCKS[block]);
            for k in 0..3 {
                self.0[block][k] = hessian[k].times_add(weight, self.0[block][k]);
            }
        }
    }

    /// The entry of two components of nodes, in either order.
    #[inline(always)]
    fn entry(&self, row: usize, column: usize) -> Lanes<WIDTH> {
        let [a, b] = [row.min(column) / 2, row.max(column) / 2];
        let block = [0, 2, 3][a] + b;
        let component = match [row % 2, column % 2] {
            [0, 0] => 0,
            [1, 1] => 1,
            _ => 2,
        };
        self.0[block][component]
    }

    /// Whether all eigenvalues are below a limit: the limit less the matrix then has a factorisation L D L^T with
    /// positive D.
    #[inline(always)]
    fn is_below(&self, limit: f64) -> [bool; WIDTH] {
        let mut below = [true; WIDTH];
        let mut lower = [[Lanes::<WIDTH>::default(); 6]; 6];
        let mut pivots = [Lanes::<WIDTH>::default(); 6];
        for column in 0..6 {
            for row in column..6 {
                let shift = if row == column { limit } else { 0.0 };
                let mut rest = Lanes::all(shift) - self.entry(row, column);
                for k in 0..column {
                    rest = rest - lower[row][k] * lower[column][k] * pivots[k];
                }
                if row == column {
                    pivots[column] = rest;
                    // Written so that what is not a number is looked at closely.
                    (0..WIDTH).for_each(|lane| below[lane] &= rest[lane] > 0.0);
                } else {
                    let pivot = pivots[column];
                    lower[row][column] = Lanes::each(|lane| rest[lane] / pivot[lane]);
                }
            }
        }
        below
    }

    /// That of one triangle.
    fn alone(&self, lane: usize) -> Matrix6<f64> {
        Matrix6::from_fn(|row, column| self.entry(row, column)[lane])
    }
}
