//! Pairs of sites of different elements that no intact interface joins, found by a neighbour search with a skin.
//!
//! Each point has a list of its own, by rising number of the partner; its force is summed along it. A list may hold partners
//! beyond the cutoff, because they add exactly nothing: so it does not matter when it was made.

use std::ops::Range;

use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use super::Planes;
use super::drift::{Drift, Lengths, Moments};
use super::grid::Grid;
use super::inside::within;
use super::measure::{Held, PARTS};
use super::points::Points;
use super::vector::Vector;
use crate::forces::close::{Close, Crowd};
use crate::lanes::{Lanes, MOST, Mask};
use crate::potential::{CutPotential, PairShape};

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
    /// Points whose forces this rank sums: some of parts, and some atoms.
    mine: [Range<usize>; 2],
    /// Points that it must know the places of: its own and their partners.
    followed: Vec<Range<usize>>,
    /// For each [`MOST`] points where their partners start; side by side as many partners as there are points.
    starts: Vec<u32>,
    partners: Vec<u32>,
    /// Where the points were when the list was made.
    then: Vec<[f64; 3]>,
    /// Even motion of all points since then.
    drift: Drift,
    lengths: Lengths,
    /// Where they are; after them the one that stands for nobody.
    places: Vec<[f64; 4]>,
    /// Forces on the points and what pairs hold of them.
    pub force: Vec<[Side; 3]>,
    pub held: Vec<[Side; PARTS]>,
}

impl Pairs {
    /// Lists the partners of the points of these elements, all in groups and all atoms; `are_joined` tells parts that an intact
    /// interface joins.
    pub fn search(
        points: Points,
        elements: [Range<usize>; 2],
        are_joined: impl Fn(u32, u32) -> bool + Sync,
        position: &Planes,
        lengths: Lengths,
    ) -> Self {
        let then: Vec<[f64; 3]> = (0..points.len())
            .into_par_iter()
            .map(|point| points.place(point, position))
            .collect();
        let grid = Grid::new(&then, |point| points.is_point(point), lengths.radius);
        let [parts, atoms] = elements;
        let mine = [
            points.of_elements(parts, 0..points.of_parts()),
            points.of_elements(atoms, points.first_atom()..points.len()),
        ];
        let nobody = points.len() as u32;
        let find = |point: usize, partners: &mut Vec<u32>| {
            let (own, here) = (points.element[point], then[point]);
            let is_of_part = points.is_of_part(point);
            partners.clear();
            grid.near(here, |other| {
                let there = then[other as usize];
                let way = [there[0] - here[0], there[1] - here[1], there[2] - here[2]];
                let squared = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
                if squared < lengths.radius * lengths.radius {
                    let theirs = points.element[other as usize];
                    let are_parts = is_of_part && points.is_of_part(other as usize);
                    if own != theirs && (!are_parts || !are_joined(own, theirs)) {
                        partners.push(other);
                    }
                }
            });
            partners.sort_unstable();
        };
        let groups = (0..points.len()).into_par_iter().step_by(MOST);
        let side_by_side = |partners: &mut Vec<u32>, first: usize| {
            let mut list = Vec::new();
            for lane in 0..MOST {
                let point = first + lane;
                if points.is_point(point) && mine.iter().any(|mine| mine.contains(&point)) {
                    find(point, partners);
                    if list.len() < partners.len() * MOST {
                        list.resize(partners.len() * MOST, nobody);
                    }
                    let slots = partners.iter().enumerate();
                    slots.for_each(|(slot, &partner)| list[slot * MOST + lane] = partner);
                }
            }
            list
        };
        let lists: Vec<Vec<u32>> = groups.map_init(Vec::new, side_by_side).collect();
        let mut starts = vec![0];
        let mut total = 0;
        starts.extend(lists.iter().map(|list| {
            total += list.len() as u32;
            total
        }));
        let partners = lists.concat();
        Self {
            followed: followed(&mine, &partners, points.len()),
            starts,
            partners,
            drift: Drift::default(),
            lengths,
            places: vec![[FAR_AWAY; 4]; points.len().next_multiple_of(MOST) + 1],
            force: vec![[[0.0; MOST]; 3]; lists.len()],
            held: Vec::new(),
            mine,
            then,
            points,
        }
    }

    /// Points whose forces this rank sums: some of parts, and some atoms.
    pub fn mine(&self) -> &[Range<usize>; 2] {
        &self.mine
    }

    /// The elements of others that the forces of this rank's points depend on, in any order, perhaps more than once.
    pub fn needed(&self) -> impl Iterator<Item = u32> {
        self.followed
            .iter()
            .cloned()
            .flatten()
            .map(|point| self.points.element[point])
    }

    /// Puts the points where they are now; whether the list is still good as far as this rank sees.
    pub fn follow(&mut self, position: &Planes) -> bool {
        for range in &self.followed {
            let places = self.places[range.clone()]
                .par_iter_mut()
                .enumerate()
                .with_min_len(MOST * CHUNK);
            places.for_each(|(number, place)| {
                let [x, y, z] = self.points.place(range.start + number, position);
                *place = [x, y, z, 0.0];
            });
        }
        self.is_current()
    }

    /// Whether no point of this rank has strayed from the even motion of all of them so far that a pair may have come within
    /// the cutoff that is not listed.
    pub fn is_current(&self) -> bool {
        let reach = self.drift.reach(self.lengths);
        let strays = |point: usize| {
            let [x, y, z, _] = self.places[point];
            let expected = self.drift.place(self.then[point]);
            let way = [x - expected[0], y - expected[1], z - expected[2]];
            // Written so that what is no number strays.
            let squared = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
            squared.is_nan() || squared > reach * reach
        };
        let points = self.mine.iter().cloned();
        points
            .into_iter()
            .all(|mine| !mine.into_par_iter().with_min_len(MOST * CHUNK).any(strays))
    }

    /// Sums from which all ranks together find the even motion of their points.
    pub fn motion(&self) -> Moments {
        let mut moments = Moments::default();
        for point in self.mine.iter().cloned().flatten() {
            let [x, y, z, _] = self.places[point];
            moments.add(self.then[point], [x, y, z]);
        }
        moments
    }

    /// Takes even motion for what the list allows for.
    pub fn drift_with(&mut self, drift: Drift) {
        self.drift = drift;
    }

    /// Sums the forces on the points; in steps that are `MEASURED` also what their elements hold of the pairs. Returns what
    /// close bonds do to the points.
    pub fn sum<S: PairShape, const MEASURED: bool>(
        &mut self,
        arch: Arch,
        law: &CutPotential<S>,
        close: Close,
    ) -> Crowd {
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
        let crowded = chunks.flat_map_iter(|(chunk, (force, held))| {
            arch.dispatch(Sum::<S, MEASURED> {
                law: *law,
                close: close.squared_length,
                first: chunk * CHUNK,
                starts,
                partners,
                places,
                force,
                held,
            })
        });
        let crowded: Vec<usize> = crowded.collect();
        let crowds = crowded.into_iter().map(|group| self.crowd(law, close, group));
        crowds.fold(Crowd::NONE, Crowd::and)
    }

    /// What close bonds do to the points of a group.
    fn crowd<S: PairShape>(&self, law: &CutPotential<S>, close: Close, group: usize) -> Crowd {
        let mut crowds = [Crowd::NONE; MOST];
        self.for_each_of(group, |[point, _], bond| {
            let squared = bond.iter().map(|component| component * component).sum();
            crowds[point as usize % MOST].add(close, law, squared, false, 1.0);
        });
        crowds.into_iter().fold(Crowd::NONE, Crowd::and)
    }

    /// Gives the vector from each point of this rank to each partner.
    pub fn for_each(&self, mut give: impl FnMut([u32; 2], [f64; 3])) {
        (0..self.starts.len().saturating_sub(1)).for_each(|group| self.for_each_of(group, &mut give));
    }

    /// The same of the points of a group.
    fn for_each_of(&self, group: usize, mut give: impl FnMut([u32; 2], [f64; 3])) {
        let list = &self.partners[self.starts[group] as usize..self.starts[group + 1] as usize];
        for (place, &partner) in list.iter().enumerate() {
            let point = group * MOST + place % MOST;
            if (partner as usize) < self.points.len() {
                let [here, there] = [self.places[point], self.places[partner as usize]];
                give(
                    [point as u32, partner],
                    [there[0] - here[0], there[1] - here[1], there[2] - here[2]],
                );
            }
        }
    }
}

/// Own points and their partners, as ranges.
fn followed(mine: &[Range<usize>; 2], partners: &[u32], points: usize) -> Vec<Range<usize>> {
    let mut is_followed = vec![false; points];
    mine.iter().for_each(|mine| is_followed[mine.clone()].fill(true));
    let partners = partners.iter().map(|&partner| partner as usize);
    partners
        .filter(|&partner| partner < points)
        .for_each(|partner| is_followed[partner] = true);
    let mut ranges: Vec<Range<usize>> = Vec::new();
    for point in (0..points).filter(|&point| is_followed[point]) {
        match ranges.last_mut() {
            Some(last) if last.end == point => last.end += 1,
            _ => ranges.push(point..point + 1),
        }
    }
    ranges
}

/// The sums of some groups of points.
struct Sum<'a, S, const MEASURED: bool> {
    law: CutPotential<S>,
    /// Shorter bonds are close, nm^2.
    close: f64,
    /// Number of the first group.
    first: usize,
    starts: &'a [u32],
    partners: &'a [u32],
    places: &'a [[f64; 4]],
    force: &'a mut [[Side; 3]],
    held: &'a mut [[Side; PARTS]],
}

impl<S: PairShape, const MEASURED: bool> WithSimd for Sum<'_, S, MEASURED> {
    /// Groups with close bonds.
    type Output = Vec<usize>;

    #[inline(always)]
    fn with_simd<L: Simd>(self, simd: L) -> Vec<usize> {
        let Self {
            law,
            close,
            first,
            starts,
            partners,
            places,
            force,
            held,
        } = self;
        let lanes = Lanes::<L>::COUNT;
        let mut crowded = Vec::new();
        for (number, force) in force.iter_mut().enumerate() {
            let group = first + number;
            let list = &partners[starts[group] as usize..starts[group + 1] as usize];
            let mut is_crowded = Mask::all(simd, false);
            let mut lane = 0;
            while lane < MOST {
                let here = gather(simd, places, |k| group * MOST + lane + k);
                let mut sum = Vector::zero(simd);
                let mut of_pairs = Held::<L, MEASURED>::new(simd);
                for partners in list.chunks_exact(MOST) {
                    let bond = gather(simd, places, |k| partners[lane + k] as usize) - here;
                    let squared = bond.squared();
                    is_crowded = is_crowded.or(squared.is_below(close));
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
            if is_crowded.any() {
                crowded.push(group);
            }
        }
        crowded
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
