//! Bonds between two triangles that lie side by side as in the perfect lattice.

use pulp::Simd;

use super::Planes;
use super::affine::{Affine, smallest_stretch};
use super::maps::{MapLanes, squared};
use super::measure::{Count, PARTS};
use super::regular::Regular;
use super::summation::{Sample, SampledString};
use crate::lanes::{Lanes, Mask};
use crate::material::Material;
use crate::mesh::Mesh;
use crate::mesh::element::Element;
use crate::mesh::interfaces::{BondString, Interfaces};
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

impl State {
    /// The state whose number this is.
    pub fn from_number(number: u32) -> Self {
        [Self::Tight, Self::Loose, Self::Open][number as usize]
    }
}

/// What the test of an interface compares.
pub struct IntactLimit {
    /// nm
    pub cutoff: f64,
    /// Length of the shortest bonds that no string holds, in spacings.
    pub unlisted: f64,
    /// nm
    pub spacing: f64,
    /// What few intact interfaces fail; `None` where the cutoff leaves no room for it.
    pub regular: Option<Regular>,
}

impl IntactLimit {
    /// `unlisted` in spacings.
    pub fn new(material: &Material, unlisted: f64) -> Self {
        let [cutoff, spacing] = [material.interaction.cutoff(), material.spacing];
        Self {
            cutoff,
            unlisted,
            spacing,
            regular: Regular::new(unlisted, cutoff, spacing),
        }
    }

    /// Whether the bonds inside some triangles are as in a regular lattice; `None` where that cannot be said.
    #[inline(always)]
    pub fn regular_inside<L: Simd>(&self, map: &MapLanes<L>) -> Option<Mask<L>> {
        let test = self.regular.as_ref()?;
        let [a, b, c] = map.nearest_bonds();
        Some(test.holds(a, a).and(test.holds(b, b)).and(test.holds(c, c)))
    }

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

/// Sum of the bond forces of a string, x and y, their first moment with the place along it, and what its bonds hold.
pub struct StringSum<L: Simd, const MEASURED: bool> {
    pub force: [Lanes<L>; 2],
    pub moment: [Lanes<L>; 2],
    held: Count<L, MEASURED>,
}

/// Sums all strings between some pairs of triangles. Returns whether all nearest-neighbour bonds among them are as in a
/// regular lattice, and what they hold if it is to be `MEASURED`.
#[inline(always)]
pub fn sum_strings<S: PairShape, L: Simd, const MEASURED: bool>(
    simd: L,
    law: &CutPotential<S>,
    limit: &IntactLimit,
    [first, second]: &[MapLanes<L>; 2],
    strings: &[SampledString],
    mut store: impl FnMut(usize, &StringSum<L, MEASURED>),
) -> (Mask<L>, [Lanes<L>; PARTS]) {
    let mut regular = Mask::all(simd, limit.regular.is_some());
    let mut held = [Lanes::all(simd, 0.0); PARTS];
    for (number, sampled) in strings.iter().enumerate() {
        let [start, step] = bonds_along(sampled, [first, second]);
        let length = sampled.length;
        let squared_bend = squared(step) * (length * length);
        if let (true, Some(test)) = (sampled.is_nearest, &limit.regular) {
            let end = [step[0].times_add(length, start[0]), step[1].times_add(length, start[1])];
            // The squared length along a string is a parabola that dips by a quarter of the squared bend at most.
            let dip = squared_bend * 0.25;
            let [one, other] = [squared(start), squared(end)];
            regular = regular
                .and(test.holds(one - dip, one))
                .and(test.holds(other - dip, other));
        }
        let sum = match sampled.hardly_bent(limit.spacing) {
            None if sampled.every_bond => sum_bonds(simd, law, start, step, sampled.string.count),
            None => sum_samples(simd, law, start, step, &sampled.samples),
            Some(limit) => sum_sampled(simd, law, start, step, sampled, squared_bend.is_below(limit)),
        };
        if MEASURED {
            sum.add_to(&mut held, start, step);
        }
        store(number, &sum);
    }
    (regular, held)
}

impl<L: Simd, const MEASURED: bool> StringSum<L, MEASURED> {
    #[inline(always)]
    fn new(simd: L) -> Self {
        Self {
            force: [Lanes::all(simd, 0.0); 2],
            moment: [Lanes::all(simd, 0.0); 2],
            held: Count::new(simd),
        }
    }

    /// Bonds are start + t step, so that the sum of force and bond, component by component, follows from the sum of
    /// forces and their moment.
    #[inline(always)]
    fn add_to(&self, [energy, pairs, xx, yy, xy]: &mut [Lanes<L>; PARTS], start: [Lanes<L>; 2], step: [Lanes<L>; 2]) {
        let product = |i: usize, j: usize, before: Lanes<L>| {
            self.force[i].mul_add(start[j], self.moment[i].mul_add(step[j], before))
        };
        *energy = *energy + self.held.energy;
        *pairs = *pairs + self.held.pairs;
        *xx = product(0, 0, *xx);
        *yy = product(1, 1, *yy);
        *xy = product(0, 1, *xy);
    }

    /// This where the mask says yes, the other elsewhere.
    #[inline(always)]
    fn where_or(&self, mask: Mask<L>, other: &Self) -> Self {
        let pick = |one: &[Lanes<L>; 2], other: &[Lanes<L>; 2]| {
            [one[0].where_or(mask, other[0]), one[1].where_or(mask, other[1])]
        };
        Self {
            force: pick(&self.force, &other.force),
            moment: pick(&self.moment, &other.moment),
            held: Count {
                energy: self.held.energy.where_or(mask, other.held.energy),
                pairs: self.held.pairs.where_or(mask, other.held.pairs),
            },
        }
    }
}

/// The first bond vector of a string between some pairs of triangles, and its change from bond to bond.
#[inline(always)]
pub fn bonds_along<L: Simd>(sampled: &SampledString, [first, second]: [&MapLanes<L>; 2]) -> [[Lanes<L>; 2]; 2] {
    let [one, other] = &sampled.ends;
    let [a, b] = [first.at(one.start), second.at(other.start)];
    let [da, db] = [first.vector(one.step), second.vector(other.step)];
    [[b[0] - a[0], b[1] - a[1]], [db[0] - da[0], db[1] - da[1]]]
}

/// The sums of strings that are looked at in few places where they are hardly bent.
#[inline(always)]
fn sum_sampled<S: PairShape, L: Simd, const MEASURED: bool>(
    simd: L,
    law: &CutPotential<S>,
    start: [Lanes<L>; 2],
    step: [Lanes<L>; 2],
    sampled: &SampledString,
    hardly_bent: Mask<L>,
) -> StringSum<L, MEASURED> {
    let of_few = sum_samples(simd, law, start, step, &sampled.few);
    if hardly_bent.every() {
        return of_few;
    }
    let of_all = sum_bonds(simd, law, start, step, sampled.string.count);
    of_few.where_or(hardly_bent, &of_all)
}

#[inline(always)]
fn sum_samples<S: PairShape, L: Simd, const MEASURED: bool>(
    simd: L,
    law: &CutPotential<S>,
    start: [Lanes<L>; 2],
    step: [Lanes<L>; 2],
    samples: &[Sample],
) -> StringSum<L, MEASURED> {
    let mut sum = StringSum::new(simd);
    for &Sample { at, weight } in samples {
        let [x, y] = [step[0].times_add(at, start[0]), step[1].times_add(at, start[1])];
        let slopes = sum.held.slopes(simd, law, squared([x, y]), Lanes::all(simd, weight));
        let pull = slopes * weight;
        let lever = pull * at;
        sum.force = [sum.force[0] + pull * x, sum.force[1] + pull * y];
        sum.moment = [lever.mul_add(x, sum.moment[0]), lever.mul_add(y, sum.moment[1])];
    }
    sum
}

/// The sums over all bonds, each counted once. From the last to the first the moment is the sum of the sums so far, which
/// takes additions instead of products.
#[inline(always)]
fn sum_bonds<S: PairShape, L: Simd, const MEASURED: bool>(
    simd: L,
    law: &CutPotential<S>,
    start: [Lanes<L>; 2],
    step: [Lanes<L>; 2],
    count: i32,
) -> StringSum<L, MEASURED> {
    let mut sum = StringSum::new(simd);
    let one = Lanes::all(simd, 1.0);
    let last = f64::from(count - 1);
    let [mut x, mut y] = [step[0].times_add(last, start[0]), step[1].times_add(last, start[1])];
    for _ in 1..count {
        let pull = sum.held.slopes(simd, law, squared([x, y]), one);
        sum.force = [sum.force[0] + pull * x, sum.force[1] + pull * y];
        sum.moment = [sum.moment[0] + sum.force[0], sum.moment[1] + sum.force[1]];
        x = x - step[0];
        y = y - step[1];
    }
    let [x, y] = start;
    let pull = sum.held.slopes(simd, law, squared([x, y]), one);
    sum.force = [sum.force[0] + pull * x, sum.force[1] + pull * y];
    sum
}
