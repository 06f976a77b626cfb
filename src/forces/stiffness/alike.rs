//! The stiffness of triangles that follow each other in the mesh and are alike to their neighbours, side by side.

use nalgebra::Matrix6;
use pulp::{Simd, WithSimd};

use super::{inside_weights, largest_eigenvalue};
use crate::forces::interface;
use crate::forces::maps::{MapLanes, squared};
use crate::forces::summation::{Sample, SampledString};
use crate::forces::{Forces, Planes};
use crate::lanes::{Lanes, MOST, Mask};
use crate::potential::{CutPotential, PairShape};

/// Triangles that are looked at together, on every machine: what a group is compared with is known before it.
pub const WIDTH: usize = MOST;

/// Blocks of the matrix on and above its diagonal, by their nodes; each is symmetric: xx, yy, xy.
const BLOCKS: [[usize; 2]; 6] = [[0, 0], [0, 1], [0, 2], [1, 1], [1, 2], [2, 2]];

/// xx, yy, xy of several triangles.
type Hessian<L> = [Lanes<L>; 3];

/// Stiffnesses of triangles side by side.
struct Stiffness<L: Simd> {
    simd: L,
    blocks: [Hessian<L>; 6],
}

/// How much larger than the largest known an eigenvalue may be and pass for it: more than rounding, and nothing to a
/// time step.
pub const SLACK: f64 = 1e-12;

/// A side of an interface as a triangle sees it.
struct Side {
    kind: u32,
    is_first: bool,
    neighbour: u32,
}

impl Forces {
    /// Whether the triangles from this one on lie in one group and have their neighbours as if each were moved from the first,
    /// and none of them touches anything but intact interfaces.
    pub(super) fn are_alike(&self, from: usize, end: usize) -> bool {
        if from + WIDTH > end.min(self.mesh.triangles) {
            return false;
        }
        let in_one_group = |first: usize| self.mesh.groups.of(first).elements.contains(&(first + WIDTH - 1));
        let neighbours_are = self.sides(from).all(|side| in_one_group(side.neighbour as usize));
        let are_together = in_one_group(from) && neighbours_are;
        are_together
            && (from..from + WIDTH).all(|triangle| {
                let moved = (triangle - from) as u32;
                let same = self
                    .sides(triangle)
                    .map(|side| (side.kind, side.is_first, side.neighbour.wrapping_sub(moved)));
                self.contacts.sites_of(&self.mesh, triangle).is_empty()
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
pub fn largest<S: PairShape>(
    forces: &Forces,
    law: &CutPotential<S>,
    position: &Planes,
    from: usize,
    [mass, known]: [f64; 2],
) -> Option<f64> {
    forces.arch.dispatch(Largest {
        forces,
        law: *law,
        position,
        from,
        mass,
        known,
    })
}

struct Largest<'a, S> {
    forces: &'a Forces,
    law: CutPotential<S>,
    position: &'a Planes,
    from: usize,
    mass: f64,
    known: f64,
}

impl<S: PairShape> WithSimd for Largest<'_, S> {
    type Output = Option<f64>;

    #[inline(always)]
    fn with_simd<L: Simd>(self, simd: L) -> Option<f64> {
        let limit = self.known * self.mass * (1.0 + SLACK);
        let mut largest = self.known;
        for from in (self.from..self.from + WIDTH).step_by(Lanes::<L>::COUNT) {
            let stiffness = self.stiffness(simd, from)?;
            let is_below = stiffness.is_below(limit);
            if is_below.every() {
                continue;
            }
            let is_below = is_below.answers();
            for lane in (0..Lanes::<L>::COUNT).filter(|&lane| !is_below[lane]) {
                largest = largest.max(largest_eigenvalue(&stiffness.alone(lane), self.mass, largest));
            }
        }
        Some(largest)
    }
}

impl<S: PairShape> Largest<'_, S> {
    /// The maps of some triangles of a group from one on.
    #[inline(always)]
    fn maps<L: Simd>(&self, simd: L, from: usize) -> MapLanes<L> {
        let group = self.forces.mesh.groups.of(from);
        let position = self.position;
        let corner = |node: usize| [0, 1].map(|axis: usize| Lanes::load(simd, &position[axis], node));
        MapLanes::between([0, 1, 2].map(|corner| group.node(from, corner)).map(corner), group.size)
    }

    /// The stiffness of some triangles from one on.
    #[inline(always)]
    fn stiffness<L: Simd>(&self, simd: L, from: usize) -> Option<Stiffness<L>> {
        let forces = self.forces;
        let element = &forces.mesh.elements[from];
        let own = self.maps(simd, from);
        if !forces.limit.regular_inside(&own)?.every() {
            return None;
        }
        let mut sum = Stiffness {
            simd,
            blocks: [[Lanes::all(simd, 0.0); 3]; 6],
        };
        for bond in forces.bulk.listed(element.size) {
            let weights = inside_weights(bond.local, element.size);
            let vector = own.vector(bond.vector);
            let [along, across] = self.stiffnesses(simd, vector);
            let hessian = hessian(vector, [along * bond.count, across * bond.count]);
            sum.add(|[a, b]| weights[a] * weights[b], &hessian);
        }
        for side in forces.sides(from) {
            let other = self.maps(simd, side.neighbour as usize);
            let maps = if side.is_first { [&own, &other] } else { [&other, &own] };
            for sampled in &forces.strings.of(side.kind).strings {
                let moments = self.moments(simd, sampled, maps);
                let string = &sampled.string;
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

    /// The sums over a string of what its bonds are worth against a wall, times the powers 0, 1 and 2 of the place along
    /// it.
    #[inline(always)]
    fn moments<L: Simd>(&self, simd: L, sampled: &SampledString, maps: [&MapLanes<L>; 2]) -> [Hessian<L>; 3] {
        let zero = Lanes::all(simd, 0.0);
        let mut moments = [[zero; 3]; 3];
        let [start, step] = interface::bonds_along(sampled, maps);
        let squared_bend = squared(step) * (sampled.length * sampled.length);
        for (samples, share) in sampled.looks(simd, self.forces.material.spacing, squared_bend) {
            if !share.is_above(0.0).any() {
                continue;
            }
            for &Sample { at, weight } in samples {
                let vector = [step[0].times_add(at, start[0]), step[1].times_add(at, start[1])];
                let [along, across] = self.stiffnesses(simd, vector);
                let count = share * (2.0 * weight);
                let hessian = hessian(vector, [positive(along, zero) * count, positive(across, zero) * count]);
                let powers = [1.0, at, at * at];
                for order in 0..3 {
                    for k in 0..3 {
                        moments[order][k] = hessian[k].times_add(powers[order], moments[order][k]);
                    }
                }
            }
        }
        moments
    }

    /// Stiffness of some bonds along their directions and across them: phi'' and phi'/r.
    #[inline(always)]
    fn stiffnesses<L: Simd>(&self, simd: L, vector: [Lanes<L>; 2]) -> [Lanes<L>; 2] {
        let squared = squared(vector);
        [self.law.curvatures(simd, squared), self.law.slopes(simd, squared)]
    }
}

#[inline(always)]
fn positive<L: Simd>(number: Lanes<L>, zero: Lanes<L>) -> Lanes<L> {
    number.where_or(number.is_above(0.0), zero)
}

/// Second derivatives of the energies of bonds with their vectors.
#[inline(always)]
pub fn hessian<L: Simd>([x, y]: [Lanes<L>; 2], [along, across]: [Lanes<L>; 2]) -> Hessian<L> {
    let difference = (along - across) * squared([x, y]).inverse();
    [
        (difference * x).mul_add(x, across),
        (difference * y).mul_add(y, across),
        difference * x * y,
    ]
}

impl<L: Simd> Stiffness<L> {
    #[inline(always)]
    fn add(&mut self, weight: impl Fn([usize; 2]) -> f64, hessian: &Hessian<L>) {
        for (block, nodes) in self.blocks.iter_mut().zip(BLOCKS) {
            let weight = weight(nodes);
            for k in 0..3 {
                block[k] = hessian[k].times_add(weight, block[k]);
            }
        }
    }

    /// The entry of two components of nodes, in either order.
    #[inline(always)]
    fn entry(&self, row: usize, column: usize) -> Lanes<L> {
        let [a, b] = [row.min(column) / 2, row.max(column) / 2];
        let block = [0, 2, 3][a] + b;
        let component = match [row % 2, column % 2] {
            [0, 0] => 0,
            [1, 1] => 1,
            _ => 2,
        };
        self.blocks[block][component]
    }

    /// Whether all eigenvalues are below a limit: the limit less the matrix then has a factorisation L D L^T with
    /// positive D.
    #[inline(always)]
    fn is_below(&self, limit: f64) -> Mask<L> {
        let zero = Lanes::all(self.simd, 0.0);
        let mut below = Lanes::all(self.simd, 1.0).is_above(0.0);
        let mut lower = [[zero; 6]; 6];
        let mut pivots = [zero; 6];
        for column in 0..6 {
            for row in column..6 {
                let shift = if row == column { limit } else { 0.0 };
                let mut rest = Lanes::all(self.simd, shift) - self.entry(row, column);
                for k in 0..column {
                    rest = rest - lower[row][k] * lower[column][k] * pivots[k];
                }
                if row == column {
                    pivots[column] = rest;
                    // What is not a number is not above zero, and looked at closely.
                    below = below.and(rest.is_above(0.0));
                } else {
                    lower[row][column] = rest * pivots[column].inverse();
                }
            }
        }
        below
    }

    /// That of one triangle.
    fn alone(&self, lane: usize) -> Matrix6<f64> {
        Matrix6::from_fn(|row, column| self.entry(row, column).numbers()[lane])
    }
}
