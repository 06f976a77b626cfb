//! Pairs of sites of different elements that no intact interface joins, found by a neighbour search with a skin.
//!
//! Each point has a list of its own, by rising number of the partner; its force is summed along it. A list may hold partners
//! beyond the cutoff, because they add exactly nothing: so it does not matter when it was made.

use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use super::Planes;
use super::grid::Grid;
use super::inside::within;
use super::measure::{Held, PARTS};
use super::points::Points;
use super::vector::Vector;
use crate::lanes::{Lanes, MOST};
use crate::potential::{CutPotential, PairShape};

/// How much farther than the cutoff partners are listed, spacings.
const SKIN: f64 = 0.3;

/// Where the point is that stands for no partner: too far away for anything.
const FAR_AWAY: f64 = 1e100;

/// Groups of points in one parallel task.
const CHUNK: usize = 64;

/// As many numbers as there may be lanes.
type Side = [f64; MOST];

/// Who is near whom.
#[derive(Clone, Debug, Default)]
pub struct Pairs {
    pub points: Points,
    /// For each [`MOST`] points where their partners start; side by side as many partners as there are points.
    starts: Vec<u32>,
    partners: Vec<u32>,
    /// Where the points were when the list was made.
    then: Vec<[f64; 3]>,
    /// How far a point may go before it is made anew, squared.
    reach: f64,
    /// Where they are; after them the one that stands for nobody.
    places: Vec<[f64; 4]>,
    /// Forces on the points and what pairs hold of them.
    pub force: Vec<[Side; 3]>,
    pub held: Vec<[Side; PARTS]>,
}

impl Pairs {
    /// Lists the partners of points; `are_joined` tells parts that an intact interface joins.
    pub fn search(
        points: Points,
        are_joined: impl Fn(u32, u32) -> bool + Sync,
        position: &Planes,
        [cutoff, spacing]: [f64; 2],
    ) -> Self {
        let then: Vec<[f64; 3]> = (0..points.len())
            .into_par_iter()
            .map(|point| points.place(point, position))
            .collect();
        let radius = cutoff + SKIN * spacing;
        let grid = Grid::new(&then, |point| points.is_point(point), radius);
        let nobody = points.len() as u32;
        let partners_of = |point: usize| {
            let own = points.element[point];
            let mut partners = Vec::new();
            if !points.is_point(point) {
                return partners;
            }
            grid.near(then[point], |other| {
                let [here, there] = [then[point], then[other as usize]];
                let way = [there[0] - here[0], there[1] - here[1], there[2] - here[2]];
                let squared = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
                let theirs = points.element[other as usize];
                if squared < radius * radius && own != theirs {
                    let are_parts = points.is_of_part(point) && points.is_of_part(other as usize);
                    if !are_parts || !are_joined(own, theirs) {
                        partners.push(other);
                    }
                }
            });
            partners.sort_unstable();
            partners
        };
        let groups = (0..points.len()).into_par_iter().step_by(MOST);
        let side_by_side = |first: usize| {
            let of_points: Vec<Vec<u32>> = (first..points.len().min(first + MOST)).map(partners_of).collect();
            let longest = of_points.iter().map(Vec::len).max().unwrap_or(0);
            let mut list = vec![nobody; longest * MOST];
            for (lane, partners) in of_points.iter().enumerate() {
                let slots = partners.iter().enumerate();
                slots.for_each(|(slot, &partner)| list[slot * MOST + lane] = partner);
            }
            list
        };
        let lists: Vec<Vec<u32>> = groups.map(side_by_side).collect();
        let mut starts = vec![0];
        let mut total = 0;
        starts.extend(lists.iter().map(|list| {
            total += list.len() as u32;
            total
        }));
        let half_skin = 0.5 * SKIN * spacing;
        Self {
            starts,
            partners: lists.concat(),
            reach: half_skin * half_skin,
            places: vec![[FAR_AWAY; 4]; points.len().next_multiple_of(MOST) + 1],
            force: vec![[[0.0; MOST]; 3]; lists.len()],
            held: Vec::new(),
            then,
            points,
        }
    }

    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Puts the points where they are now; whether the list is still good.
    pub fn follow(&mut self, position: &Planes) -> bool {
        let Self {
            points,
            then,
            reach,
            places,
            ..
        } = self;
        let here = places.par_iter_mut().zip(&*then).enumerate().with_min_len(MOST * CHUNK);
        let strays = here.map(|(point, (place, then))| {
            if !points.is_point(point) {
                return false;
            }
            let [x, y, z] = points.place(point, position);
            *place = [x, y, z, 0.0];
            let way = [x - then[0], y - then[1], z - then[2]];
            let squared = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
            squared > *reach
        });
        !strays.reduce(|| false, |a, b| a || b)
    }

    /// Sums the forces on the points; in steps that are `MEASURED` also what their elements hold of the pairs.
    pub fn sum<S: PairShape, const MEASURED: bool>(&mut self, arch: Arch, law: &CutPotential<S>) {
        let groups = self.force.len();
        self.held
            .resize(if MEASURED { groups } else { 0 }, [[0.0; MOST]; PARTS]);
        let Self {
            starts,
            partners,
            places,
            force,
            held,
            ..
        } = self;
        let mut held: Vec<&mut [[Side; PARTS]]> = held.chunks_mut(CHUNK).collect();
        held.resize_with(groups.div_ceil(CHUNK), Default::default);
        let chunks = force.par_chunks_mut(CHUNK).zip(held).enumerate();
        chunks.for_each(|(chunk, (force, held))| {
            arch.dispatch(Sum::<S, MEASURED> {
                law: *law,
                first: chunk * CHUNK,
                starts,
                partners,
                places,
                force,
                held,
            });
        });
    }

    /// Gives the vector between the partners of every pair of points once.
    pub fn for_each(&self, mut give: impl FnMut([u32; 2], [f64; 3])) {
        for (group, bounds) in self.starts.windows(2).enumerate() {
            let list = &self.partners[bounds[0] as usize..bounds[1] as usize];
            for (place, &partner) in list.iter().enumerate() {
                let point = group * MOST + place % MOST;
                if (partner as usize) < self.points.len() && point < partner as usize {
                    let [here, there] = [self.places[point], self.places[partner as usize]];
                    give(
                        [point as u32, partner],
                        [there[0] - here[0], there[1] - here[1], there[2] - here[2]],
                    );
                }
            }
        }
    }
}

/// The sums of some groups of points.
struct Sum<'a, S, const MEASURED: bool> {
    law: CutPotential<S>,
    /// Number of the first group.
    first: usize,
    starts: &'a [u32],
    partners: &'a [u32],
    places: &'a [[f64; 4]],
    force: &'a mut [[Side; 3]],
    held: &'a mut [[Side; PARTS]],
}

impl<S: PairShape, const MEASURED: bool> WithSimd for Sum<'_, S, MEASURED> {
    type Output = ();

    #[inline(always)]
    fn with_simd<L: Simd>(self, simd: L) {
        let Self {
            law,
            first,
            starts,
            partners,
            places,
            force,
            held,
        } = self;
        let lanes = Lanes::<L>::COUNT;
        for (number, force) in force.iter_mut().enumerate() {
            let group = first + number;
            let list = &partners[starts[group] as usize..starts[group + 1] as usize];
            let mut lane = 0;
            while lane < MOST {
                let here = gather(simd, places, |k| group * MOST + lane + k);
                let mut sum = Vector::zero(simd);
                let mut of_pairs = Held::<L, MEASURED>::new(simd);
                for partners in list.chunks_exact(MOST) {
                    let bond = gather(simd, places, |k| partners[lane + k] as usize) - here;
                    let squared = bond.squared();
                    if MEASURED {
                        let values = law.values(simd, squared);
                        of_pairs.add(values, bond, within(simd, &law, squared), Lanes::all(simd, 1.0));
                        sum = bond.times_add(values[1], sum);
                    } else {
                        sum = bond.times_add(law.slopes(simd, squared), sum);
                    }
                }
                for (plane, part) in force.iter_mut().zip([sum.x, sum.y, sum.z]) {
                    part.store(plane, lane, lanes);
                }
                if MEASURED {
                    let mut planes = held[number].each_mut().map(|plane| &mut plane[..]);
                    of_pairs.store(&mut planes, lane, lanes);
                }
                lane += lanes;
            }
        }
    }
}

#[inline(always)]
fn gather<L: Simd>(simd: L, places: &[[f64; 4]], place: impl Fn(usize) -> usize) -> Vector<L> {
    let mut planes = [[0.0; MOST]; 3];
    for k in 0..Lanes::<L>::COUNT {
        let [x, y, z, _] = places[place(k)];
        planes[0][k] = x;
        planes[1][k] = y;
        planes[2][k] = z;
    }
    Vector {
        x: Lanes::load(simd, &planes[0], 0),
        y: Lanes::load(simd, &planes[1], 0),
        z: Lanes::load(simd, &planes[2], 0),
    }
}
