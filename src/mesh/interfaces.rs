//! Which triangles are neighbours, and the bonds between them as strings.
//!
//! Bonds of one lattice vector between two triangles lie on straight lines of sites, and along such a string the bond
//! vector is linear in the position, because both triangles are affine.

mod neighbours;

use std::collections::HashMap;

use super::Mesh;
use super::element::Element;
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

/// Every pair of triangles with sites no farther apart than a reach, and what each triangle touches.
#[derive(Clone, Debug, Default)]
pub struct Interfaces {
    pub kinds: Vec<InterfaceKind>,
    /// first < second; those that are alike and follow each other in the mesh do so here.
    pub pairs: Vec<Interface>,
    /// For every triangle where its part of `of_triangle` starts, and the length at the end.
    start: Vec<u32>,
    /// Interfaces of each triangle, by the number of the neighbour.
    of_triangle: Vec<u32>,
    /// Triangles that border an atom or a free surface or a cut, ascending: they meet more than other triangles.
    pub exposed: Vec<u32>,
}

/// Interfaces stay together with those of so many triangles side by side, upright and inverted ones of a row: what belongs
/// together in space does in memory, and fits into the nearest cache.
const STRETCH: usize = 64;

/// Triangles whose sites come this close (in spacings) count as neighbours: the third shell.
const REACH: f64 = 2.0;

type KindKey = (i32, i32, i32, i32, i32, i32);

impl Interfaces {
    /// Finds the neighbours of a mesh; strings hold every bond no longer than `bond_length` spacings.
    pub fn new(mesh: &Mesh, bond_length: f64) -> Self {
        let bonds = triangular::vectors_within(bond_length);
        let around = triangular::vectors_within(REACH.max(bond_length));
        let mut found = Self::default();
        let mut kinds: HashMap<KindKey, u32> = HashMap::new();
        let mut near = Vec::new();
        let mut surroundings: HashMap<(i32, i32), Vec<[i32; 2]>> = HashMap::new();
        for (number, element) in mesh.elements[..mesh.triangles].iter().enumerate() {
            let shape = (element.size, element.sign);
            let surrounding = surroundings
                .entry(shape)
                .or_insert_with(|| neighbours::surrounding(element, &around));
            let borders_others = neighbours::collect(mesh, element, surrounding, &mut near);
            if borders_others || neighbours::borders_cut(mesh, element, &around) {
                found.exposed.push(number as u32);
            }
            for &other in near.iter().filter(|&&other| other as usize > number) {
                let second = &mesh.elements[other as usize];
                let key = (
                    element.size,
                    element.sign,
                    second.size,
                    second.sign,
                    second.column - element.column,
                    second.row - element.row,
                );
                let kind = *kinds.entry(key).or_insert_with(|| {
                    found.kinds.push(InterfaceKind::between(element, second, &bonds));
                    found.kinds.len() as u32 - 1
                });
                let severed = neighbours::is_severed(mesh, element, second, &around);
                found.pairs.push(Interface {
                    first: number as u32,
                    second: other,
                    kind,
                    severed,
                });
            }
        }
        found.sort_and_index(mesh);
        found
    }

    /// Puts interfaces that are alike together, and tells each triangle its own. They come by their first triangle and by
    /// their second, so that every triangle meets its neighbours in rising order. Those of a
    /// stretch of a row stay together.
    fn sort_and_index(&mut self, mesh: &Mesh) {
        let triangles = mesh.triangles;
        let has_strings = |found: &u32| {
            let kind = &self.kinds[self.pairs[*found as usize].kind as usize];
            !kind.strings.is_empty()
        };
        let (mut order, without): (Vec<u32>, Vec<u32>) = (0..self.pairs.len() as u32).partition(has_strings);
        order.extend(without);
        // They were found by their first triangle, so those of a row are together.
        let row_of = |found: u32| {
            let first = &mesh.elements[self.pairs[found as usize].first as usize];
            (has_strings(&found), first.size, first.lowest_row())
        };
        for of_row in order.chunk_by_mut(|one, other| row_of(*one) == row_of(*other)) {
            of_row.sort_unstable_by_key(|&found| {
                let pair = &self.pairs[found as usize];
                let first = pair.first as usize;
                let stretch = (first - mesh.groups.of(first).elements.start) / STRETCH;
                (stretch, mesh.groups.number_of(first), pair.kind, first)
            });
        }
        let mut number_of = vec![0; order.len()];
        (0..)
            .zip(&order)
            .for_each(|(number, &found)| number_of[found as usize] = number);

        let mut start = vec![0u32; triangles + 1];
        for pair in &self.pairs {
            start[pair.first as usize + 1] += 1;
            start[pair.second as usize + 1] += 1;
        }
        for k in 0..triangles {
            start[k + 1] += start[k];
        }
        let mut next = start.clone();
        let mut of_triangle = vec![0; start[triangles] as usize];
        for (pair, &number) in self.pairs.iter().zip(&number_of) {
            for owner in [pair.first as usize, pair.second as usize] {
                of_triangle[next[owner] as usize] = number;
                next[owner] += 1;
            }
        }
        self.pairs = order.into_iter().map(|found| self.pairs[found as usize]).collect();
        self.start = start;
        self.of_triangle = of_triangle;
    }

    /// The interfaces of a triangle by the number of the neighbour.
    #[inline(always)]
    pub fn of(&self, triangle: usize) -> &[u32] {
        &self.of_triangle[self.start[triangle] as usize..self.start[triangle + 1] as usize]
    }

    /// The interface between two triangles, if they are neighbours.
    #[inline(always)]
    pub fn between(&self, a: usize, b: usize) -> Option<usize> {
        let (first, second) = (a.min(b) as u32, a.max(b) as u32);
        let candidates = self.of(a).iter().map(|&number| number as usize);
        candidates
            .into_iter()
            .find(|&number| self.pairs[number].first == first && self.pairs[number].second == second)
    }

    pub fn strings(&self, interface: usize) -> &[BondString] {
        &self.kinds[self.pairs[interface].kind as usize].strings
    }
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
mod tests {
    use super::super::Plan;
    use super::super::cut::Crack;
    use super::super::sites::Layout;
    use super::*;

    fn mesh(element: u16, crack_length: Option<f64>) -> Mesh {
        let layout = Layout {
            block: 10,
            rows: 6,
            triangles: 13,
        };
        Mesh::new(&Plan {
            layout,
            element,
            regions: vec![],
            crack: crack_length.map(Crack::of_length),
            grip_rows: 10,
            spacing: 1.0,
        })
    }

    #[test]
    fn a_cell_of_two_55_site_triangles_has_57_bonds_along_edges_and_3_at_corners() {
        let mesh = mesh(10, None);
        let interfaces = Interfaces::new(&mesh, 1.4);
        let bonds = |number: usize| interfaces.strings(number).iter().map(|s| s.count).sum::<i32>();
        let counts: Vec<i32> = (0..interfaces.pairs.len()).map(bonds).collect();
        assert!(counts.iter().all(|count| [0, 1, 19].contains(count)), "{counts:?}");
        // All bonds of the site set: those inside elements and those across, found site by site.
        let across = mesh
            .sites
            .iter()
            .flat_map(|a| triangular::NEAREST.map(|v| (a, [a[0] + v[0], a[1] + v[1]])));
        let across = across.filter(|&(a, b)| mesh.owner_of(b).is_some_and(|owner| Some(owner) != mesh.owner_of(a)));
        assert_eq!(counts.iter().sum::<i32>() as usize, across.count());
        // An upright triangle in the middle of a row: three edges of 19 bonds, three corner bonds; half of each belongs to it.
        let inner = 2 * 13 + 3;
        let own: i32 = interfaces.of(inner).iter().map(|&number| bonds(number as usize)).sum();
        assert_eq!(own, 57 + 3);
    }

    #[test]
    fn long_bonds_between_unlike_triangles_are_all_listed_once() {
        for element in [7, 10, 4] {
            let mesh = mesh(element, None);
            let interfaces = Interfaces::new(&mesh, 2.4);
            let mut listed = 0;
            for (number, pair) in interfaces.pairs.iter().enumerate() {
                let [first, second] = pair.both().map(|e| mesh.elements[e as usize]);
                for string in interfaces.strings(number) {
                    for t in 0..string.count {
                        let [a, b] = string.ends(t);
                        let [a, b] = [first.site(a), second.site(b)];
                        assert_eq!(shift(a, string.bond, 1), b);
                        assert!(first.contains(a) && second.contains(b));
                        listed += 1;
                    }
                }
            }
            let triangle = |site| mesh.owner_of(site).filter(|&owner| owner < mesh.triangles);
            let half = triangular::half_vectors_within(2.4);
            let across = mesh
                .sites
                .iter()
                .flat_map(|a| half.iter().map(move |v| (a, shift(a, *v, 1))));
            let expected = across.filter(|&(a, b)| match (triangle(a), triangle(b)) {
                (Some(first), Some(second)) => first != second,
                _ => false,
            });
            assert_eq!(listed, expected.count(), "element {element}");
        }
    }

    #[test]
    fn every_triangle_meets_its_neighbours_in_rising_order_and_alike_ones_follow_each_other() {
        let mesh = mesh(10, Some(30.0));
        let interfaces = Interfaces::new(&mesh, 1.4);
        for triangle in 0..mesh.triangles {
            let pairs = interfaces
                .of(triangle)
                .iter()
                .map(|&number| interfaces.pairs[number as usize]);
            let met: Vec<u32> = pairs.map(|pair| pair.first ^ pair.second ^ triangle as u32).collect();
            assert!(met.is_sorted() && met.len() > 2);
        }
        let has_strings = |pair: &Interface| !interfaces.kinds[pair.kind as usize].strings.is_empty();
        assert!(interfaces.pairs.is_sorted_by_key(|pair| !has_strings(pair)));
        let runs = interfaces
            .pairs
            .chunk_by(|a, b| a.kind == b.kind && b.first == a.first + 1);
        assert!(8 * runs.count() < interfaces.pairs.len() * 3, "long runs");
    }

    #[test]
    fn interfaces_along_the_cut_are_severed_and_their_triangles_exposed() {
        let mesh = mesh(10, Some(30.0));
        let interfaces = Interfaces::new(&mesh, 1.4);
        let severed = interfaces.pairs.iter().filter(|pair| pair.severed).count();
        assert!(severed > 4 && severed < interfaces.pairs.len() / 4);
        let across = |pair: &Interface| {
            let rows = pair
                .both()
                .map(|e| mesh.elements[e as usize].row < mesh.cut.unwrap().row);
            rows[0] != rows[1]
        };
        assert!(interfaces.pairs.iter().filter(|pair| pair.severed).all(across));
    }
}
