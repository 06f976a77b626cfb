//! The bonds of strings between triangles, those of several interfaces side by side.
//!
//! Along a string the bond vector is u + t w: u in the middle, t counted from there, w its change from bond to bond. Its
//! square is s(t) = u u + 2 t u w + t^2 w w, so that a bond costs its phi'/r and little else. With G0, G1 and G2 the sums of
//! phi'/r times the powers 0, 1 and 2 of t, the force of the string is u G0 + w G1, and its moment with t is u G1 + w G2.

use pulp::Simd;

use super::certified::Certificate;
use super::interface::IntactLimit;
use super::measure::{Count, PARTS};
use super::regular::Regular;
use super::summation::{Sample, SampledString};
use super::vector::Vector;
use crate::lanes::{Lanes, Mask};
use crate::mesh::element::Element;
use crate::potential::{CutPotential, PairShape};

/// A string as the nodes of its two triangles carry it. The sites of a string lie on a straight line, along which shape
/// functions are linear, [Deng2011] Eq. (3-27).
#[derive(Clone, Debug, PartialEq)]
pub struct CarriedString {
    /// Shape functions of the second and the third node of either triangle, for the ends of the bond in the middle.
    pub middle: [[f64; 2]; 2],
    /// Their change from bond to bond.
    pub change: [[f64; 2]; 2],
    /// From the middle to the last bond.
    pub half: f64,
    pub is_nearest: bool,
    /// Where it is looked at.
    all: Places,
    few: Option<Few>,
}

/// Where a string is looked at while it is hardly bent.
#[derive(Clone, Debug, PartialEq)]
struct Few {
    places: Places,
    /// Change of its bonds along it up to which it is hardly bent, in spacings.
    bend: f64,
    /// What all its bonds must be in addition.
    regular: Option<Regular>,
}

/// Places along a string, counted from its middle.
#[derive(Clone, Debug, PartialEq)]
struct Places {
    /// How many bonds the one in the middle stands for.
    middle: f64,
    /// Places as far behind the middle as before it, and how many bonds each of both stands for.
    pairs: Vec<(f64, [f64; 2])>,
    /// Whether each stands for one bond.
    one_each: bool,
}

impl CarriedString {
    /// `corners`: the nodes of both triangles in their order here.
    pub fn new(
        elements: &[Element; 2],
        corners: &[[usize; 3]; 2],
        sampled: &SampledString,
        certificate: Option<Certificate>,
    ) -> Self {
        let string = &sampled.string;
        let [first, last] = [0, string.count - 1].map(|t| string.ends(t));
        let half = 0.5 * f64::from(string.count - 1);
        let shape = |side: usize, local: [[i32; 2]; 2]| {
            let shape = elements[side].shape_functions(local[side]);
            [shape[corners[side][1]], shape[corners[side][2]]]
        };
        let both = |rule: &dyn Fn(f64, f64) -> f64| {
            [0, 1].map(|side| {
                let [from, to] = [shape(side, first), shape(side, last)];
                [0, 1].map(|node| rule(from[node], to[node]))
            })
        };
        Self {
            middle: both(&|from, to| 0.5 * (from + to)),
            change: both(&|from, to| if half > 0.0 { 0.5 * (to - from) / half } else { 0.0 }),
            half,
            is_nearest: sampled.is_nearest,
            all: Places::new(&sampled.samples, half),
            few: match certificate.filter(|_| sampled.is_nearest) {
                Some(certificate) => certificate.few(string.count).map(|(few, bend)| Few {
                    places: Places::new(&few, half),
                    bend,
                    regular: Some(certificate.regular),
                }),
                None => sampled.few_places().map(|(few, bend)| Few {
                    places: Places::new(few, half),
                    bend,
                    regular: None,
                }),
            },
        }
    }
}

impl CarriedString {
    /// Whether it is a single bond that stands for itself.
    pub fn is_one_bond(&self) -> bool {
        self.is_nearest && self.all.pairs.is_empty() && self.all.middle == 1.0
    }

    /// The sums over it in some interfaces. `UNTOUCHED`: all bonds are known to be in the range that the cutoff leaves
    /// untouched.
    #[inline(always)]
    pub fn sum<S: PairShape, L: Simd, const MEASURED: bool, const UNTOUCHED: bool>(
        &self,
        simd: L,
        law: &CutPotential<S>,
        spacing: f64,
        along: &Along<L>,
    ) -> Powers<L, MEASURED> {
        let Some(few) = &self.few else {
            return along.sum::<S, MEASURED, UNTOUCHED>(simd, law, &self.all);
        };
        let limit = few.bend * spacing / (2.0 * self.half);
        let mut is_hardly_bent = along.bend.is_below(limit * limit);
        if let Some(regular) = &few.regular {
            let [least, most] = along.range(self.half);
            is_hardly_bent = is_hardly_bent.and(regular.holds(least, most));
        }
        let of_few = along.sum::<S, MEASURED, UNTOUCHED>(simd, law, &few.places);
        if is_hardly_bent.every() {
            return of_few;
        }
        let of_all = along.sum::<S, MEASURED, UNTOUCHED>(simd, law, &self.all);
        of_few.where_or(is_hardly_bent, &of_all)
    }
}

impl Places {
    fn new(samples: &[Sample], half: f64) -> Self {
        let mut places = Self {
            middle: 0.0,
            pairs: Vec::new(),
            one_each: samples.iter().all(|sample| sample.weight == 1.0),
        };
        // Gauss points are eigenvalues, which are as far from the middle on both sides but for rounding.
        const SAME: f64 = 1e-9;
        for sample in samples {
            let [at, weight] = [sample.at - half, sample.weight];
            let side = usize::from(at < 0.0);
            if at.abs() < SAME {
                places.middle = weight;
            } else if let Some((_, weights)) = places.pairs.iter_mut().find(|pair| (pair.0 - at.abs()).abs() < SAME) {
                weights[side] = weight;
            } else {
                let mut weights = [0.0; 2];
                weights[side] = weight;
                places.pairs.push((at.abs(), weights));
            }
        }
        places.one_each &= places.pairs.iter().all(|(_, weights)| *weights == [1.0; 2]);
        places
    }
}

/// Of some triangles the first node on which strings act, and the vectors from it to the second and to the third: with one
/// acting node none of these mean anything, with two the first does.
#[derive(Clone, Copy)]
pub struct Ends<L: Simd> {
    pub node: Vector<L>,
    pub to_second: Vector<L>,
    pub to_third: Vector<L>,
}

/// Forces of strings on the acting nodes of some triangles, as many as act.
#[derive(Clone, Copy)]
pub struct NodalForces<L: Simd> {
    pub first: Vector<L>,
    pub second: Vector<L>,
    pub third: Vector<L>,
}

/// What the strings of some interfaces give.
pub struct InterfaceSum<L: Simd> {
    /// On the first triangles, and what is to be taken from those on the second.
    pub on: NodalForces<L>,
    pub from: NodalForces<L>,
    /// Zero where nothing is measured.
    pub held: [Lanes<L>; PARTS],
    /// Whether all nearest-neighbour bonds are as in a regular lattice.
    pub regular: Mask<L>,
}

/// Sums all strings of some interfaces of a kind whose strings act on `N` nodes of each triangle; those that `keep` leaves
/// out give nothing.
#[inline(always)]
pub fn sum<S: PairShape, L: Simd, const MEASURED: bool, const N: usize>(
    simd: L,
    law: &CutPotential<S>,
    limit: &IntactLimit,
    strings: &[CarriedString],
    [first, second]: &[Ends<L>; 2],
    keep: Option<Mask<L>>,
) -> InterfaceSum<L> {
    let zero = Vector::zero(simd);
    let mut regular = Mask::all(simd, limit.regular.is_some());
    let mut held = [zero.x; PARTS];
    let mut whole = zero;
    let [mut on_second, mut on_third, mut from_second, mut from_third] = [zero; 4];
    let across = second.node - first.node;
    for string in strings {
        let all = |number: f64| Lanes::all(simd, number);
        let [mut u, mut w] = [across, zero];
        if N > 1 {
            u = first.to_second.times_taken_from(all(string.middle[0][0]), u);
            u = second.to_second.times_add(all(string.middle[1][0]), u);
            w = first.to_second.times_taken_from(all(string.change[0][0]), w);
            w = second.to_second.times_add(all(string.change[1][0]), w);
        }
        if N > 2 {
            u = first.to_third.times_taken_from(all(string.middle[0][1]), u);
            u = second.to_third.times_add(all(string.middle[1][1]), u);
            w = first.to_third.times_taken_from(all(string.change[0][1]), w);
            w = second.to_third.times_add(all(string.change[1][1]), w);
        }
        let along = Along::new(u, w);
        if let (true, Some(test)) = (string.is_nearest, &limit.regular) {
            let [least, most] = along.range(string.half);
            regular = regular.and(test.holds(least, most));
        }
        let mut sum = string.sum::<S, L, MEASURED, false>(simd, law, limit.spacing, &along);
        if let Some(keep) = keep {
            sum = sum.where_or(keep, &Powers::new(simd));
        }
        let force = w.times_add(sum.first, u.times(sum.zeroth));
        let moment = w.times_add(sum.second, u.times(sum.first));
        whole = whole + force;
        if N > 1 {
            on_second = force.times_add(all(string.middle[0][0]), on_second);
            on_second = moment.times_add(all(string.change[0][0]), on_second);
            from_second = force.times_add(all(string.middle[1][0]), from_second);
            from_second = moment.times_add(all(string.change[1][0]), from_second);
        }
        if N > 2 {
            on_third = force.times_add(all(string.middle[0][1]), on_third);
            on_third = moment.times_add(all(string.change[0][1]), on_third);
            from_third = force.times_add(all(string.middle[1][1]), from_third);
            from_third = moment.times_add(all(string.change[1][1]), from_third);
        }
        if MEASURED {
            // Bonds are u + t w, so that the sum of force and bond follows from the sum of forces and their moment.
            held[0] = held[0] + sum.held.energy;
            held[1] = held[1] + sum.held.pairs;
            held[2] = held[2] + force.x.mul_add(u.x, moment.x * w.x);
            held[3] = held[3] + force.y.mul_add(u.y, moment.y * w.y);
            held[4] = held[4] + force.x.mul_add(u.y, moment.x * w.y);
        }
    }
    let forces = |second: Vector<L>, third: Vector<L>| NodalForces {
        first: whole - second - third,
        second,
        third,
    };
    InterfaceSum {
        on: forces(on_second, on_third),
        from: forces(from_second, from_third),
        held,
        regular,
    }
}

/// The squared length of the bonds along some strings, middle + slope t + bend t^2.
#[derive(Clone, Copy)]
pub struct Along<L: Simd> {
    middle: Lanes<L>,
    slope: Lanes<L>,
    bend: Lanes<L>,
}

impl<L: Simd> Along<L> {
    /// Along bonds u + t w.
    #[inline(always)]
    pub fn new(u: Vector<L>, w: Vector<L>) -> Self {
        Self {
            middle: u.squared(),
            slope: u.dot(w) * 2.0,
            bend: w.squared(),
        }
    }

    /// A lower and an upper bound of the squared lengths up to a distance from the middle. A parabola dips below the lower of
    /// its ends by a quarter of the squared bend at most.
    #[inline(always)]
    pub fn range(&self, half: f64) -> [Lanes<L>; 2] {
        let slope = self.slope.absolute();
        let most = slope.times_add(half, self.bend.times_add(half * half, self.middle));
        [slope.times_add(-half, self.middle), most]
    }

    #[inline(always)]
    fn sum<S: PairShape, const MEASURED: bool, const UNTOUCHED: bool>(
        &self,
        simd: L,
        law: &CutPotential<S>,
        places: &Places,
    ) -> Powers<L, MEASURED> {
        match places.one_each {
            true => self.sum_with::<S, MEASURED, UNTOUCHED, true>(simd, law, places),
            false => self.sum_with::<S, MEASURED, UNTOUCHED, false>(simd, law, places),
        }
    }

    #[inline(always)]
    fn sum_with<S: PairShape, const MEASURED: bool, const UNTOUCHED: bool, const ONE_EACH: bool>(
        &self,
        simd: L,
        law: &CutPotential<S>,
        places: &Places,
    ) -> Powers<L, MEASURED> {
        let mut sum = Powers::new(simd);
        if places.middle > 0.0 {
            sum.zeroth = sum.slopes::<S, UNTOUCHED>(simd, law, self.middle, places.middle);
            if !ONE_EACH {
                sum.zeroth = sum.zeroth * places.middle;
            }
        }
        for &(at, [before, behind]) in &places.pairs {
            let [place, square] = [Lanes::all(simd, at), Lanes::all(simd, at * at)];
            let even = self.bend.mul_add(square, self.middle);
            let ahead = self.slope.mul_add(place, even);
            let back = self.slope.negative_mul_add(place, even);
            let mut first = sum.slopes::<S, UNTOUCHED>(simd, law, ahead, before);
            let mut second = sum.slopes::<S, UNTOUCHED>(simd, law, back, behind);
            if !ONE_EACH {
                first = first * before;
                second = second * behind;
            }
            let both = first + second;
            sum.zeroth = sum.zeroth + both;
            sum.first = (first - second).mul_add(place, sum.first);
            sum.second = both.mul_add(square, sum.second);
        }
        sum
    }
}

/// Sums over a string of phi'/r times the powers 0, 1 and 2 of the place, and what its bonds hold.
#[derive(Clone, Copy)]
pub struct Powers<L: Simd, const MEASURED: bool> {
    pub zeroth: Lanes<L>,
    pub first: Lanes<L>,
    pub second: Lanes<L>,
    held: Count<L, MEASURED>,
}

impl<L: Simd, const MEASURED: bool> Powers<L, MEASURED> {
    #[inline(always)]
    fn new(simd: L) -> Self {
        let zero = Lanes::all(simd, 0.0);
        Self {
            zeroth: zero,
            first: zero,
            second: zero,
            held: Count::new(simd),
        }
    }

    /// phi'/r of bonds with these squared lengths, each of which stands for so many.
    #[inline(always)]
    fn slopes<S: PairShape, const UNTOUCHED: bool>(
        &mut self,
        simd: L,
        law: &CutPotential<S>,
        squared: Lanes<L>,
        count: f64,
    ) -> Lanes<L> {
        match UNTOUCHED {
            true => law.untouched_slopes(simd, squared),
            false => self.held.slopes(simd, law, squared, Lanes::all(simd, count)),
        }
    }

    /// This where the mask says yes, the other elsewhere.
    #[inline(always)]
    fn where_or(&self, mask: Mask<L>, other: &Self) -> Self {
        let mut picked = *self;
        picked.zeroth = self.zeroth.where_or(mask, other.zeroth);
        picked.first = self.first.where_or(mask, other.first);
        picked.second = self.second.where_or(mask, other.second);
        picked.held.energy = self.held.energy.where_or(mask, other.held.energy);
        picked.held.pairs = self.held.pairs.where_or(mask, other.held.pairs);
        picked
    }
}
