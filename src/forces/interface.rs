//! Bonds between two triangles that lie side by side as in the perfect lattice.

use super::Planes;
use super::affine::{Affine, smallest_stretch};
use super::lanes::Lanes;
use super::maps::{MapLanes, stretch_at_least};
use super::summation::{Sample, SampledString};
use crate::mesh::Mesh;
use crate::mesh::element::Element;
use crate::mesh::interfaces::{BondString, InterfaceKind, Interfaces};
use crate::potential::{CutPotential, PairShape};

/// How two neighbouring triangles stand to each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum State {
    /// As in the lattice, with little strain between them: their strings say it all.
    #[default]
    Tight,
    /// Their strings still hold all their bonds, but other elements may come near.
    Loose,
    /// Their bonds are found by search.
    Open,
}

/// What the test of an interface compares.
pub struct IntactLimit {
    /// nm
    pub cutoff: f64,
    /// Length of the shortest bonds that no string holds, in spacings.
    pub unlisted: f64,
    /// nm
    pub spacing: f64,
    /// `None` where the cutoff leaves no room for it.
    pub quick: Option<QuickTest>,
}

/// A test that few intact interfaces fail, and that takes no roots: whatever passes it is tight.
#[derive(Clone, Copy)]
pub struct QuickTest {
    squared_gap: f64,
    squared_difference: f64,
}

impl QuickTest {
    /// Largest gap, in spacings, largest difference of the gradients, and smallest stretch.
    const GAP: f64 = 0.03;
    const DIFFERENCE: f64 = 0.02;
    const STRETCH: f64 = 0.97;

    /// `unlisted` in spacings, lengths in nm.
    pub fn new(unlisted: f64, cutoff: f64, spacing: f64) -> Option<Self> {
        let displaced = (Self::GAP + Self::DIFFERENCE) * spacing;
        let stretch = Self::STRETCH - IntactLimit::LEVER * Self::DIFFERENCE;
        let beyond = stretch * unlisted * spacing - cutoff;
        // A little less than what the full test asks, so that rounding does not matter.
        let is_tight = displaced <= 0.99 * (IntactLimit::LOOSE * spacing).min(0.5 * beyond);
        is_tight.then_some(Self {
            squared_gap: (Self::GAP * spacing).powi(2),
            squared_difference: Self::DIFFERENCE.powi(2),
        })
    }

    /// Whether all of some interfaces pass, by the gradients of their first and second triangles.
    #[inline(always)]
    pub fn holds<const W: usize>(&self, [first, second]: [[[Lanes<W>; 2]; 2]; 2], squared_gap: Lanes<W>) -> bool {
        let mut squared_difference = Lanes::default();
        for k in 0..2 {
            for axis in 0..2 {
                let difference = second[k][axis] - first[k][axis];
                squared_difference = difference.mul_add(difference, squared_difference);
            }
        }
        squared_gap.every(|gap| gap <= self.squared_gap)
            && squared_difference.every(|difference| difference <= self.squared_difference)
            && stretch_at_least(second, Self::STRETCH)
    }
}

impl IntactLimit {
    /// Triangles that face along an edge need 1, those that meet at a corner over a 60 degree wedge 1/sin 60.
    const LEVER: f64 = 1.5;
    /// In spacings. While all neighbours of a triangle are closer to their lattice places than this, nothing else
    /// comes within the cutoff without all but touching one of them.
    const LOOSE: f64 = 0.2;
}

/// Two neighbouring triangles as they are now.
pub struct Pair<'a> {
    first: &'a Element,
    second: &'a Element,
    first_map: Affine,
    second_map: Affine,
    anchors: [[i32; 2]; 2],
}

impl<'a> Pair<'a> {
    #[inline(always)]
    pub fn new(mesh: &'a Mesh, interfaces: &Interfaces, number: usize, position: &Planes) -> Self {
        let pair = interfaces.pairs[number];
        let [a, b] = [pair.first as usize, pair.second as usize];
        let [first, second] = [&mesh.elements[a], &mesh.elements[b]];
        Self {
            first,
            second,
            first_map: Affine::of_triangle(first.size, mesh.first_node(a), position),
            second_map: Affine::of_triangle(second.size, mesh.first_node(b), position),
            anchors: interfaces.kinds[pair.kind as usize].anchors,
        }
    }

    /// Whether the strings hold every pair of sites within the cutoff, and whether the triangles are still in place, for
    /// their [`Self::gap`].
    ///
    /// A pair that is in no string was at least `unlisted` apart. With F the gradient of the second triangle, D the
    /// difference of the two gradients and g the gap between the two maps where the triangles face each other, the
    /// pair a, a + b is now F b + g + D (a - c) apart, c the facing point; a is no farther from it than
    /// `LEVER` |b| plus a spacing. So all are beyond the cutoff if (smallest stretch of F - LEVER |D|) unlisted
    /// - |g| - |D| spacing is.
    #[inline(always)]
    pub fn state(&self, limit: &IntactLimit, gap: f64) -> State {
        let first = self.first_map.deformation_gradient(self.first.sign, limit.spacing);
        let second = self.second_map.deformation_gradient(self.second.sign, limit.spacing);
        let mut squared_difference = 0.0;
        for k in 0..2 {
            for axis in 0..2 {
                let difference = second[k][axis] - first[k][axis];
                squared_difference += difference * difference;
            }
        }
        let difference = squared_difference.sqrt();
        let stretch = smallest_stretch(second) - IntactLimit::LEVER * difference;
        let spacing = limit.spacing;
        let displaced = gap + difference * spacing;
        let beyond = stretch > 0.0 && stretch * limit.unlisted * spacing - displaced >= limit.cutoff;
        match beyond {
            // Two such neighbours in a row must not bring what lies beyond within the cutoff either.
            true if displaced
                <= (IntactLimit::LOOSE * spacing).min(0.5 * (stretch * limit.unlisted * spacing - limit.cutoff)) =>
            {
                State::Tight
            }
            true => State::Loose,
            // Also where the positions are not numbers.
            false => State::Open,
        }
    }

    /// How far the two triangles are from fitting together where they face each other, nm.
    #[inline(always)]
    pub fn gap(&self) -> f64 {
        let [a, b] = self.anchors.map(|anchor| self.squared_gap(anchor));
        a.max(b).sqrt()
    }

    /// Squared distance between the places where the two triangles would put one lattice site.
    #[inline(always)]
    fn squared_gap(&self, anchor: [i32; 2]) -> f64 {
        let site = [self.first.column + anchor[0], self.first.row + anchor[1]];
        let [a, b] = [
            self.first_map.at(self.first.local(site)),
            self.second_map.at(self.second.local(site)),
        ];
        let [x, y] = [b[0] - a[0], b[1] - a[1]];
        x * x + y * y
    }

    /// Bond vector at the start of a string and its change from bond to bond.
    #[inline(always)]
    pub fn string_vectors(&self, string: &BondString) -> [[f64; 2]; 2] {
        let [a, b] = [self.first_map.at(string.first), self.second_map.at(string.second)];
        let [da, db] = [
            self.first_map.vector(string.first_step),
            self.second_map.vector(string.second_step),
        ];
        [[b[0] - a[0], b[1] - a[1]], [db[0] - da[0], db[1] - da[1]]]
    }
}

/// Forces of strings on the nodes of both triangles, first and second: x and y of each node, eV/nm.
#[derive(Clone, Copy)]
pub struct StringForces<const W: usize>(pub [Lanes<W>; 12]);

impl<const W: usize> Default for StringForces<W> {
    #[inline(always)]
    fn default() -> Self {
        Self([Lanes::default(); 12])
    }
}

impl<const W: usize> StringForces<W> {
    #[inline(always)]
    pub fn set_lane(&mut self, lane: usize, alone: &StringForces<1>) {
        (0..12).for_each(|plane| self.0[plane].0[lane] = alone.0[plane][0]);
    }
}

/// The larger squared distance between the places where two triangles would put one and the same lattice site, at either
/// end of where they face each other, nm^2.
#[inline(always)]
pub fn squared_gap<const W: usize>(kind: &InterfaceKind, first: &MapLanes<W>, second: &MapLanes<W>) -> Lanes<W> {
    let [a, b] = [
        squared_gap_at(kind, kind.anchors[0], first, second),
        squared_gap_at(kind, kind.anchors[1], first, second),
    ];
    Lanes::each(|lane| if a[lane] > b[lane] { a[lane] } else { b[lane] })
}

#[inline(always)]
fn squared_gap_at<const W: usize>(
    kind: &InterfaceKind,
    anchor: [i32; 2],
    first: &MapLanes<W>,
    second: &MapLanes<W>,
) -> Lanes<W> {
    let [one, other] = kind.elements;
    let site = [one.column + anchor[0], one.row + anchor[1]];
    let [a, b] = [first.at(one.local(site)), second.at(other.local(site))];
    let [x, y] = [b[0] - a[0], b[1] - a[1]];
    x.mul_add(x, y * y)
}

/// Forces of all strings on the nodes of both triangles: the weights along a string are linear too, so that the sums of
/// the bond forces and of their first moments say it all.
#[inline(always)]
pub fn string_forces<S: PairShape, const W: usize>(
    law: &CutPotential<S>,
    kind: &InterfaceKind,
    first_map: &MapLanes<W>,
    second_map: &MapLanes<W>,
    strings: &[SampledString],
) -> StringForces<W> {
    let mut first = NodalSum::default();
    let mut second = NodalSum::default();
    for SampledString { string, samples } in strings {
        let [a, b] = [first_map.at(string.first), second_map.at(string.second)];
        let [da, db] = [
            first_map.vector(string.first_step),
            second_map.vector(string.second_step),
        ];
        let start = [b[0] - a[0], b[1] - a[1]];
        let step = [db[0] - da[0], db[1] - da[1]];
        let [mut sum, mut moment] = [[Lanes::default(); 2]; 2];
        for &Sample { at, weight } in samples {
            let [x, y] = [step[0].times_add(at, start[0]), step[1].times_add(at, start[1])];
            let pull = Lanes(law.slopes(x.mul_add(x, y * y).0)) * weight;
            let lever = pull * at;
            sum = [pull.mul_add(x, sum[0]), pull.mul_add(y, sum[1])];
            moment = [lever.mul_add(x, moment[0]), lever.mul_add(y, moment[1])];
        }
        first.add(string.first, string.first_step, sum, moment, 1.0);
        second.add(string.second, string.second_step, sum, moment, -1.0);
    }
    let [first, second] = [
        first.on_nodes(kind.elements[0].size),
        second.on_nodes(kind.elements[1].size),
    ];
    let mut forces = StringForces::default();
    forces.0[..6].copy_from_slice(&first);
    forces.0[6..].copy_from_slice(&second);
    forces
}

/// Force on a triangle and its moments with the two local coordinates.
#[derive(Clone, Copy, Default)]
struct NodalSum<const W: usize> {
    total: [Lanes<W>; 2],
    along: [[Lanes<W>; 2]; 2],
}

impl<const W: usize> NodalSum<W> {
    #[inline(always)]
    fn add(&mut self, start: [i32; 2], step: [i32; 2], sum: [Lanes<W>; 2], moment: [Lanes<W>; 2], sign: f64) {
        for axis in 0..2 {
            self.total[axis] = sum[axis].times_add(sign, self.total[axis]);
            for k in 0..2 {
                let from_start = sum[axis].times_add(sign * f64::from(start[k]), self.along[k][axis]);
                self.along[k][axis] = moment[axis].times_add(sign * f64::from(step[k]), from_start);
            }
        }
    }

    /// x and y of each node.
    #[inline(always)]
    fn on_nodes(&self, size: i32) -> [Lanes<W>; 6] {
        let edge = 1.0 / f64::from(size - 1);
        let [p, q] = self.along;
        let [p, q] = [[p[0] * edge, p[1] * edge], [q[0] * edge, q[1] * edge]];
        let [x, y] = [self.total[0] - p[0] - q[0], self.total[1] - p[1] - q[1]];
        [x, y, p[0], p[1], q[0], q[1]]
    }
}
