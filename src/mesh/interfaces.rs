//! Which triangles are neighbours, and the bonds between them as strings.
//!
//! Bonds of one lattice vector between two triangles lie on straight lines of sites, and along such a string the bond
//! vector is linear in the position, because both triangles are affine.

mod neighbours;
mod survey;

pub use survey::{Kind, Survey, Told};

use std::ops::Range;

use super::Mesh;
use super::element::Element;
use super::groups::Group;
use crate::lattice::triangular;

/// A run of equal bonds between two triangles: sites start + t step of the first, t = 0 .. count, each joined to the
/// site `bond` away in the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BondString {
    pub bond: [i32; 2],
    pub count: i32,
    /// Local coordinates in the first and in the second triangle of the first bond's ends, and their steps.
    pub first: [i32; 2],
    pub first_step: [i32; 2],
    pub second: [i32; 2],
    pub second_step: [i32; 2],
}

impl BondString {
    /// Local coordinates of both ends of a bond.
    pub fn ends(&self, t: i32) -> [[i32; 2]; 2] {
        [
            shift(self.first, self.first_step, t),
            shift(self.second, self.second_step, t),
        ]
    }
}

/// All there is to know of two neighbouring triangles but where they are: shared by all pairs alike.
#[derive(Clone, Debug, PartialEq)]
pub struct InterfaceKind {
    /// Two triangles of this kind.
    pub elements: [Element; 2],
    pub strings: Vec<BondString>,
    /// Two lattice sites between which the triangles face each other, relative to the first triangle's anchor site.
    pub anchors: [[i32; 2]; 2],
}

/// A pair of neighbouring triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interface {
    pub first: u32,
    pub second: u32,
    pub kind: u32,
    /// A cut severs some of its bonds, so that they cannot be summed as strings.
    pub severed: bool,
}

impl Interface {
    /// Its two triangles.
    pub fn both(&self) -> [u32; 2] {
        [self.first, self.second]
    }
}

/// The pairs of triangles with sites no farther apart than a reach to which some triangles belong, those of a rank or all,
/// and what each of these touches. They are known by their places here. Each has a number in the whole mesh, too, in which
/// they ascend.
#[derive(Clone, Debug, Default)]
pub struct Interfaces {
    pub kinds: Vec<InterfaceKind>,
    /// first < second; those that are alike and follow each other in the mesh do so here.
    pub pairs: Vec<Interface>,
    /// Place and number of the first of each run of consecutive numbers.
    numbered: Vec<[u32; 2]>,
    /// How many there are in the whole mesh.
    count: usize,
    /// For every triangle of the mesh where its part of `of_triangle` starts and ends. Untouched, and so not in memory, for
    /// those that border on none of these.
    range: Vec<[u32; 2]>,
    /// Interfaces of each triangle, by the number of the neighbour.
    of_triangle: Vec<u32>,
    told: Told,
}

/// Interfaces stay together with those of so many triangles side by side, upright and inverted ones of a row: what belongs
/// together in space does in memory, and fits into the nearest cache.
const STRETCH: usize = 64;

/// Triangles whose sites come this close (in spacings) count as neighbours: the third shell.
const REACH: f64 = 2.0;

impl Interfaces {
    /// Finds all neighbours of a mesh; strings hold every bond no longer than `bond_length` spacings.
    pub fn new(mesh: &Mesh, bond_length: f64) -> Self {
        let mut survey = Survey::new(mesh, bond_length, 0..mesh.triangles);
        let told = survey.tell();
        Self::of_triangles(mesh, survey, told, 0..mesh.triangles)
    }

    /// Those of consecutive triangles that start and end with groups, from a survey and from what all surveys have told.
    pub fn of_triangles(mesh: &Mesh, mut survey: Survey, told: Told, triangles: Range<usize>) -> Self {
        let reach = survey.reach();
        let kinds = told.kinds.iter().map(|kind| kind.in_full(survey.bonds())).collect();
        survey.know(&told.kinds);
        let mut found = Self {
            kinds,
            ..Self::default()
        };
        let near = near_rows(mesh, &triangles, reach);
        found.collect(mesh, &told, triangles, &near, |row, pairs| {
            survey.pairs_of(mesh, row, pairs);
        });
        drop(survey);
        found.index(mesh.triangles, &near);
        found.told = told;
        found
    }

    /// Those of other triangles of the same mesh, with strings of the same bonds.
    pub fn of_others(&self, mesh: &Mesh, bond_length: f64, triangles: Range<usize>) -> Self {
        let survey = Survey::new(mesh, bond_length, 0..0);
        Self::of_triangles(mesh, survey, self.told.clone(), triangles)
    }

    /// Puts interfaces that are alike together, and tells each triangle its own. In every row of triangles of a size those of a
    /// stretch stay together, then those of a group and of a kind, so that their order does not depend on which rows are known.
    fn collect(
        &mut self,
        mesh: &Mesh,
        told: &Told,
        triangles: Range<usize>,
        near: &[Range<usize>],
        mut pairs_of: impl FnMut(Range<usize>, &mut Vec<Interface>),
    ) {
        let totals = [0, 1].map(|half| told.counts.iter().map(|counts| counts[half] as usize).sum::<usize>());
        self.count = totals.iter().sum();
        // Those with strings have the first numbers.
        let mut next = [0, totals[0]];
        let mut halves = [Vec::new(), Vec::new()];
        let mut numbered: [Vec<[u32; 2]>; 2] = Default::default();
        let mut of_row = Vec::new();
        let mut near = near.iter().peekable();
        for (row, counts) in rows(mesh).into_iter().zip(&told.counts) {
            if near.next_if_eq(&&row).is_some() {
                of_row.clear();
                pairs_of(row, &mut of_row);
                of_row.sort_unstable_by_key(|pair| {
                    let first = pair.first as usize;
                    let stretch = (first - mesh.groups.of(first).elements.start) / STRETCH;
                    (stretch, mesh.groups.number_of(first), pair.kind, first)
                });
                let mut numbers = next;
                for pair in &of_row {
                    let half = usize::from(self.kinds[pair.kind as usize].strings.is_empty());
                    let number = numbers[half] as u32;
                    numbers[half] += 1;
                    if pair
                        .both()
                        .iter()
                        .any(|&triangle| triangles.contains(&(triangle as usize)))
                    {
                        let place = halves[half].len() as u32;
                        match numbered[half].last() {
                            Some(&[from, first]) if first + (place - from) == number => {}
                            _ => numbered[half].push([place, number]),
                        }
                        halves[half].push(*pair);
                    }
                }
            }
            (0..2).for_each(|half| next[half] += counts[half] as usize);
        }
        let [with_strings, without] = halves;
        let before = with_strings.len() as u32;
        let [first, second] = numbered;
        self.numbered = first;
        self.numbered
            .extend(second.into_iter().map(|[place, number]| [before + place, number]));
        self.pairs = with_strings;
        self.pairs.extend(without);
        self.pairs.shrink_to_fit();
    }

    /// Tells each triangle its own, in the order of its neighbours; all that border on any of these are in some ranges.
    fn index(&mut self, triangles: usize, near: &[Range<usize>]) {
        let mut range = vec![[0; 2]; triangles];
        for triangle in self.pairs.iter().flat_map(Interface::both) {
            range[triangle as usize][1] += 1;
        }
        let mut total = 0;
        for triangle in near.iter().cloned().flatten() {
            let [start, end] = &mut range[triangle];
            *start = total;
            total += *end;
            *end = *start;
        }
        let mut of_triangle = vec![0; total as usize];
        for (place, pair) in (0..).zip(&self.pairs) {
            for triangle in pair.both() {
                let [_, end] = &mut range[triangle as usize];
                of_triangle[*end as usize] = place;
                *end += 1;
            }
        }
        for triangle in near.iter().cloned().flatten() {
            let [start, end] = range[triangle];
            of_triangle[start as usize..end as usize].sort_unstable_by_key(|&place| {
                let pair = &self.pairs[place as usize];
                pair.first ^ pair.second ^ triangle as u32
            });
        }
        self.range = range;
        self.of_triangle = of_triangle;
    }

    /// How many interfaces the whole mesh has.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Triangles of the whole mesh that border an atom or a free surface or a cut, ascending: they meet more than other
    /// triangles.
    pub fn exposed(&self) -> &[u32] {
        &self.told.exposed
    }

    /// The number in the whole mesh of the interface at a place.
    pub fn number_of(&self, place: usize) -> u32 {
        let after = self.numbered.partition_point(|run| run[0] as usize <= place);
        let [from, number] = self.numbered[after - 1];
        number + (place as u32 - from)
    }

    /// The place of the interface with a number in the whole mesh; `None` where it is not one of these.
    pub fn place_of(&self, number: u32) -> Option<usize> {
        let after = self.numbered.partition_point(|run| run[1] <= number);
        let [from, first] = self.numbered[after.checked_sub(1)?];
        let end = self.numbered.get(after).map_or(self.pairs.len() as u32, |run| run[0]);
        let place = from + (number - first);
        (place < end).then_some(place as usize)
    }

    /// The places of the interfaces of a triangle by the number of the neighbour, of one that is not of these triangles only
    /// those with them.
    #[inline(always)]
    pub fn of(&self, triangle: usize) -> &[u32] {
        let [start, end] = self.range[triangle];
        &self.of_triangle[start as usize..end as usize]
    }

    /// The interface between two triangles, if they are neighbours and one of them is of these triangles.
    #[inline(always)]
    pub fn between(&self, a: usize, b: usize) -> Option<usize> {
        let (first, second) = (a.min(b) as u32, a.max(b) as u32);
        let candidates = self.of(a).iter().map(|&place| place as usize);
        candidates
            .into_iter()
            .find(|&place| self.pairs[place].first == first && self.pairs[place].second == second)
    }

    pub fn strings(&self, interface: usize) -> &[BondString] {
        &self.kinds[self.pairs[interface].kind as usize].strings
    }
}

/// The rows of triangles of one size, upright and inverted ones: consecutive triangles.
fn rows(mesh: &Mesh) -> Vec<Range<usize>> {
    let row_of = |group: &Group| {
        let first = &mesh.elements[group.elements.start];
        (first.size, first.lowest_row())
    };
    let rows = mesh.groups.all().chunk_by(|one, other| row_of(one) == row_of(other));
    rows.map(|row| row[0].elements.start..row[row.len() - 1].elements.end)
        .collect()
}

/// The rows that come within a reach, in lattice rows, of those of some triangles: all that these border on are there.
fn near_rows(mesh: &Mesh, triangles: &Range<usize>, reach: i32) -> Vec<Range<usize>> {
    let rows = rows(mesh);
    let extents = rows.iter().map(|row| {
        let first = &mesh.elements[row.start];
        first.lowest_row()..first.lowest_row() + first.size
    });
    let extents: Vec<Range<i32>> = extents.collect();
    let is_own = |row: &Range<usize>| row.start < triangles.end && triangles.start < row.end;
    let mut own: Vec<&Range<i32>> = rows
        .iter()
        .zip(&extents)
        .filter(|(row, _)| is_own(row))
        .map(|(_, extent)| extent)
        .collect();
    own.sort_unstable_by_key(|extent| extent.start);
    let is_near = |extent: &Range<i32>| {
        own.iter()
            .any(|own| extent.start < own.end + reach && own.start < extent.end + reach)
    };
    let near = rows.iter().zip(&extents).filter(|(_, extent)| is_near(extent));
    near.map(|(row, _)| row.clone()).collect()
}

impl InterfaceKind {
    fn between(first: &Element, second: &Element, bonds: &[[i32; 2]]) -> Self {
        let strings = bonds
            .iter()
            .flat_map(|&bond| strings_along(first, second, bond))
            .collect();
        Self {
            elements: [*first, *second],
            strings,
            anchors: facing_sites(first, second),
        }
    }
}

/// Groups the bonds of one lattice vector into straight runs along that close-packed direction which gives the fewest.
fn strings_along(first: &Element, second: &Element, bond: [i32; 2]) -> Vec<BondString> {
    let ends: Vec<[i32; 2]> = first
        .locals()
        .filter(|&local| second.contains(shift(first.site(local), bond, 1)))
        .collect();
    let runs = triangular::NEAREST.map(|direction| runs_along(&ends, direction));
    let fewest = runs.into_iter().min_by_key(Vec::len).unwrap_or_default();
    let string = |(start, step, count): ([i32; 2], [i32; 2], i32)| {
        let end = |t| second.local(shift(first.site(shift(start, step, t)), bond, 1));
        let [a, b] = [end(0), end(1)];
        BondString {
            bond,
            count,
            first: start,
            first_step: step,
            second: a,
            second_step: [b[0] - a[0], b[1] - a[1]],
        }
    };
    fewest.into_iter().map(string).collect()
}

/// Maximal runs of sites along a direction: start, step, count.
fn runs_along(sites: &[[i32; 2]], direction: [i32; 2]) -> Vec<([i32; 2], [i32; 2], i32)> {
    let starts = sites
        .iter()
        .filter(|&&site| !sites.contains(&shift(site, direction, -1)));
    let run = |&start: &[i32; 2]| {
        let count = (1..)
            .find(|&t| !sites.contains(&shift(start, direction, t)))
            .expect("a triangle ends");
        (start, direction, count)
    };
    starts.map(run).collect()
}

fn shift([i, j]: [i32; 2], [di, dj]: [i32; 2], times: i32) -> [i32; 2] {
    [i + times * di, j + times * dj]
}

/// The ends of the stretch of the first triangle's sites that are closest to the second, relative to its anchor site.
fn facing_sites(first: &Element, second: &Element) -> [[i32; 2]; 2] {
    let distance = |a: [i32; 2]| {
        let to = |b: [i32; 2]| triangular::squared_length([a[0] - b[0], a[1] - b[1]]);
        second.sites().map(to).min().expect("an element has sites")
    };
    let closest = first.sites().map(distance).min().expect("an element has sites");
    let facing: Vec<[i32; 2]> = first.sites().filter(|&site| distance(site) == closest).collect();
    let [start, end] = [facing[0], facing[facing.len() - 1]];
    [start, end].map(|site| [site[0] - first.column, site[1] - first.row])
}

#[cfg(test)]
mod tests;
