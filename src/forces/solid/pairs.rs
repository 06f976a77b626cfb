//! Pairs of sites of different elements that no intact interface joins, found by a neighbour search with a skin.
//!
//! Each point has a list of its own, by rising number of the partner; its force is summed along it. A list may hold partners
//! beyond the cutoff, because they add exactly nothing: so it does not matter when it was made.

use std::ops::Range;

use pulp::Arch;
use rayon::prelude::*;

use super::Planes;
use super::drift::{Drift, Lengths, Moments};
use super::grid::Grid;
use super::listed::{Side, Sum};
use super::lists::{self, Lists};
use super::measure::PARTS;
use super::nodal::bond_count;
use super::points::Points;
use super::scene::Scene;
use crate::forces::close::{Close, Crowd};
use crate::lanes::MOST;
use crate::potential::{CutPotential, PairShape};

/// Where the point is that stands for no partner: too far away for anything.
const FAR_AWAY: f64 = 1e100;

/// Groups of points in one parallel task.
const CHUNK: usize = 64;

/// Who is near whom.
#[derive(Clone, Debug, Default)]
pub struct Pairs {
    pub points: Points,
    /// Interfaces that may open without a search, ascending: the sites along them are points.
    ready: Vec<u32>,
    /// Points whose forces this rank sums: some of parts, and some atoms.
    mine: [Range<usize>; 2],
    /// Points that it must know the places of: its own with partners, and these.
    followed: Vec<Range<usize>>,
    /// Their partners, and those from which a cut severs them.
    bonded: Lists,
    severed: Lists,
    grid: Grid,
    /// Where the nodes were when the lists were made.
    then: Planes,
    /// Own nodes that carry points or may come near any.
    watched: Vec<Range<usize>>,
    /// Even motion of all these nodes since then.
    drift: Drift,
    lengths: Lengths,
    /// Where the points are, and how many sites each stands for; after them the one that stands for nobody.
    places: Vec<[f64; 4]>,
    /// Forces on the points and what pairs hold of them.
    pub force: Vec<[Side; 3]>,
    pub held: Vec<[Side; PARTS]>,
}

impl Pairs {
    /// Lists the partners of the points of this rank; `joined` puts the parts that intact interfaces join to a part in place of
    /// what it is given.
    pub fn search(scene: Scene, joined: impl Fn(u32, &mut Vec<u32>) + Sync) -> Self {
        let places_then = scene.places();
        let Scene {
            points,
            ready,
            elements,
            watched,
            position,
            lengths,
            ..
        } = scene;
        let then: Vec<[f64; 3]> = (0..points.len())
            .into_par_iter()
            .map(|point| points.place(point, position))
            .collect();
        let [parts, atoms] = elements;
        let count = points.len().div_ceil(MOST);
        let mut pairs = Self {
            ready,
            grid: Grid::new(&then, |point| points.is_point(point), lengths.radius),
            mine: [
                points.of_elements(parts, 0..points.of_parts()),
                points.of_elements(atoms, points.first_atom()..points.len()),
            ],
            followed: Vec::new(),
            bonded: Lists::default(),
            severed: Lists::default(),
            then: places_then,
            watched,
            drift: Drift::default(),
            lengths,
            places: vec![[FAR_AWAY, FAR_AWAY, FAR_AWAY, 0.0]; count * MOST + 1],
            force: vec![[[0.0; MOST]; 3]; count],
            held: Vec::new(),
            points,
        };
        let list = |around: &mut Around, group| pairs.list(group, around, &joined, |point| then[point]);
        let groups = (0..count).into_par_iter();
        let (bonded, severed): (Vec<_>, Vec<_>) = groups.map_init(Around::default, list).unzip();
        pairs.bonded = Lists::of(&bonded);
        pairs.severed = Lists::of(&severed);
        pairs.followed = pairs.with_partners();
        pairs
    }

    /// Whether these interfaces, which have opened, need no search.
    pub fn are_ready(&self, interfaces: &[u32]) -> bool {
        interfaces.iter().all(|number| self.ready.binary_search(number).is_ok())
    }

    /// Lists the partners of the points of some parts again, because interfaces between them have opened.
    pub fn list_again(&mut self, parts: &[u32], joined: impl Fn(u32, &mut Vec<u32>)) {
        let mut around = Around::default();
        let then = std::mem::take(&mut self.then);
        for &part in parts {
            let part = part as usize;
            let points = self.points.of_elements(part..part + 1, 0..self.points.of_parts());
            if points.is_empty() {
                continue;
            }
            let groups = points.start / MOST..points.end.div_ceil(MOST);
            for group in groups.clone() {
                let (bonded, severed) = self.list(group, &mut around, &joined, |point| self.points.place(point, &then));
                self.bonded.replace(group, &bonded);
                self.severed.replace(group, &severed);
            }
            let all = groups.start * MOST..self.points.len().min(groups.end * MOST);
            if !self.followed.contains(&all) {
                self.followed.push(all);
            }
        }
        self.then = then;
    }

    /// Partners of as many points side by side as there are lanes, and those from which a cut severs them; none for points of
    /// other ranks.
    fn list(
        &self,
        group: usize,
        around: &mut Around,
        joined: &impl Fn(u32, &mut Vec<u32>),
        then: impl Fn(usize) -> [f64; 3],
    ) -> (Vec<u32>, Vec<u32>) {
        let nobody = self.points.len() as u32;
        let (mut bonded, mut severed) = (Vec::new(), Vec::new());
        for lane in 0..MOST {
            let point = group * MOST + lane;
            if self.points.is_point(point) && self.mine.iter().any(|mine| mine.contains(&point)) {
                self.find(point, around, joined, &then);
                lists::add(&mut bonded, lane, &around.partners, nobody);
                lists::add(&mut severed, lane, &around.severed, nobody);
            }
        }
        (bonded, severed)
    }

    /// Finds the partners of a point.
    fn find(
        &self,
        point: usize,
        around: &mut Around,
        joined: &impl Fn(u32, &mut Vec<u32>),
        then: &impl Fn(usize) -> [f64; 3],
    ) {
        let Around {
            partners,
            severed,
            joined_to,
            part,
        } = around;
        let (own, here) = (self.points.element[point], then(point));
        let is_of_part = self.points.is_of_part(point);
        if is_of_part && *part != Some(own) {
            *part = Some(own);
            joined(own, joined_to);
        }
        let reach = self.lengths.radius * self.lengths.radius;
        partners.clear();
        severed.clear();
        self.grid.near(here, |other| {
            let there = then(other as usize);
            let way = [there[0] - here[0], there[1] - here[1], there[2] - here[2]];
            let squared = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
            if squared < reach {
                let theirs = self.points.element[other as usize];
                let are_parts = is_of_part && self.points.is_of_part(other as usize);
                if own != theirs && !(are_parts && joined_to.contains(&theirs)) {
                    match self.points.are_severed(point, other as usize) {
                        true => severed.push(other),
                        false => partners.push(other),
                    }
                }
            }
        });
        partners.sort_unstable();
        severed.sort_unstable();
    }

    /// Points of this rank with partners, and these, as ranges.
    fn with_partners(&self) -> Vec<Range<usize>> {
        let count = self.points.len();
        let mut is_followed = vec![false; count];
        let groups = (0..self.force.len()).flat_map(|group| [&self.bonded, &self.severed].map(|lists| (group, lists)));
        let lists = groups.map(|(group, lists)| (group, lists.of_group(group)));
        for (group, list) in lists.filter(|(_, list)| !list.is_empty()) {
            let own = group * MOST..count.min((group + 1) * MOST);
            is_followed[own].fill(true);
            let partners = list.iter().map(|&partner| partner as usize);
            partners
                .filter(|&partner| partner < count)
                .for_each(|partner| is_followed[partner] = true);
        }
        ranges((0..count).filter(|&point| is_followed[point] && self.points.is_point(point)))
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
                let point = range.start + number;
                let [x, y, z] = self.points.place(point, position);
                *place = [x, y, z, self.points.weight(point)];
            });
        }
        self.is_current(position)
    }

    /// Whether no watched node has strayed from the even motion of all of them so far that a pair may have come within the
    /// cutoff that is not listed. A site of a part strays no farther than the nodes that carry it.
    pub fn is_current(&self, position: &Planes) -> bool {
        let reach = self.drift.reach(self.lengths);
        let strays = |node: usize| {
            let expected = self.drift.place(at(&self.then, node));
            let now = at(position, node);
            let way = [now[0] - expected[0], now[1] - expected[1], now[2] - expected[2]];
            // Written so that what is no number strays.
            let squared = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
            squared.is_nan() || squared > reach * reach
        };
        let nodes = self.watched.iter().cloned();
        nodes
            .into_iter()
            .all(|nodes| !nodes.into_par_iter().with_min_len(MOST * CHUNK).any(strays))
    }

    /// Sums from which all ranks together find the even motion of their nodes.
    pub fn motion(&self, position: &Planes) -> Moments {
        let mut moments = Moments::default();
        for node in self.watched.iter().cloned().flatten() {
            moments.add(at(&self.then, node), at(position, node));
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
            bonded,
            severed,
            places,
            force,
            held,
            ..
        } = self;
        let weighted = self.points.are_weighted();
        let mut held: Vec<&mut [[Side; PARTS]]> = held.chunks_mut(CHUNK).collect();
        held.resize_with(groups.div_ceil(CHUNK), Default::default);
        let chunks = force.par_chunks_mut(CHUNK).zip(held).enumerate();
        let crowded = chunks.flat_map_iter(|(chunk, (force, held))| {
            arch.dispatch(Sum::<S, MEASURED> {
                law: *law,
                close: close.squared_length,
                first: chunk * CHUNK,
                bonded,
                severed,
                spacing: close.spacing,
                weighted,
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
        for (lists, severed) in [(&self.bonded, false), (&self.severed, true)] {
            self.for_each_of(lists, group, |[point, partner], bond| {
                let squared = bond.iter().map(|component| component * component).sum();
                let count = bond_count([point, partner].map(|point| self.points.weight(point as usize)));
                crowds[point as usize % MOST].add(close, law, squared, severed, count);
            });
        }
        crowds.into_iter().fold(Crowd::NONE, Crowd::and)
    }

    /// Gives the vector from each point of this rank to each partner.
    pub fn for_each(&self, mut give: impl FnMut([u32; 2], [f64; 3])) {
        for lists in [&self.bonded, &self.severed] {
            (0..self.force.len()).for_each(|group| self.for_each_of(lists, group, &mut give));
        }
    }

    /// The same of the points of a group and of some lists.
    fn for_each_of(&self, lists: &Lists, group: usize, mut give: impl FnMut([u32; 2], [f64; 3])) {
        for (place, &partner) in lists.of_group(group).iter().enumerate() {
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

/// What the search for one point leaves for the next.
#[derive(Default)]
struct Around {
    partners: Vec<u32>,
    /// Those from which a cut severs it.
    severed: Vec<u32>,
    /// The parts that intact interfaces join to this part.
    joined_to: Vec<u32>,
    part: Option<u32>,
}

/// Ascending numbers as ranges.
pub fn ranges(numbers: impl Iterator<Item = usize>) -> Vec<Range<usize>> {
    let mut ranges: Vec<Range<usize>> = Vec::new();
    for number in numbers {
        match ranges.last_mut() {
            Some(last) if last.end == number => last.end += 1,
            _ => ranges.push(number..number + 1),
        }
    }
    ranges
}

#[inline(always)]
fn at(planes: &Planes, node: usize) -> [f64; 3] {
    [planes[0][node], planes[1][node], planes[2][node]]
}
