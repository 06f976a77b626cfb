//! Bonds between two triangles that lie side by side as in the perfect lattice.

use pulp::Simd;

use super::Planes;
use super::affine::{Affine, smallest_stretch};
use super::maps::MapLanes;
use super::regular::Regular;
use super::summation::SampledString;
use crate::lanes::{Lanes, Mask};
use crate::material::Material;
use crate::mesh::Mesh;
use crate::mesh::element::Element;
use crate::mesh::interfaces::{BondString, Interfaces};
use crate::potential::with_law;

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

    /// Whether any of some interfaces is open, without a branch for each.
    #[inline(always)]
    pub fn any_open(states: &[Self]) -> bool {
        let mut any_open = false;
        for &state in states {
            any_open |= state == Self::Open;
        }
        any_open
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
    /// The same, where the cutoff leaves regular nearest-neighbour bonds untouched.
    pub untouched: Option<Regular>,
}

impl IntactLimit {
    /// `unlisted` in spacings.
    pub fn new(material: &Material, unlisted: f64) -> Self {
        let [cutoff, spacing] = [material.interaction.cutoff(), material.spacing];
        let regular = Regular::new(unlisted, cutoff, spacing);
        let untouched = with_law!(material.interaction, law => law.squared_untouched());
        Self {
            cutoff,
            unlisted,
            spacing,
            regular,
            untouched: regular.filter(|regular| regular.lengths()[1].powi(2) <= untouched),
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
            first_map: Affine::of_triangle(mesh, a, position),
            second_map: Affine::of_triangle(mesh, b, position),
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

/// The first bond vector of a string between some pairs of triangles, and its change from bond to bond.
#[inline(always)]
pub fn bonds_along<L: Simd>(sampled: &SampledString, [first, second]: [&MapLanes<L>; 2]) -> [[Lanes<L>; 2]; 2] {
    let [one, other] = &sampled.ends;
    let [a, b] = [first.at(one.start), second.at(other.start)];
    let [da, db] = [first.vector(one.step), second.vector(other.step)];
    [[b[0] - a[0], b[1] - a[1]], [db[0] - da[0], db[1] - da[1]]]
}
