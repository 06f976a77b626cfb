//! Neighbour search on a grid of cells: who may have partners, and who they are.

use rayon::prelude::*;

use super::super::affine::site_position;
use super::super::interface::State;
use super::super::loosened::Loosened;
use super::super::summation::Summation;
use super::super::{CHUNK, Planes};
use super::Contacts;
use super::boxes::Boxes;
use super::grid::Grid;
use super::lattice::{AtomLattice, Surroundings, pair_along};
use super::near::{Bounds, Corners, are_apart, is_apart_from};
use super::partners::{PairKind, Partner};
use crate::domain::Domain;
use crate::lattice::triangular;
use crate::material::Material;
use crate::mesh::Mesh;
use crate::mesh::interfaces::Interfaces;

/// What decides which pairs belong to the search.
pub struct Field<'a> {
    pub mesh: &'a Mesh,
    pub domain: &'a Domain,
    pub interfaces: &'a Interfaces,
    pub states: &'a [State],
    pub summation: Summation,
    /// Length of the shortest bonds of the perfect lattice that no string holds, in spacings.
    pub unlisted: f64,
}

/// Triangles of the whole mesh that may meet something other than their intact neighbours, ascending, where these interfaces
/// are not tight.
pub fn searched(interfaces: &Interfaces, loosened: &[Loosened]) -> Vec<u32> {
    let beside = loosened.iter().flat_map(|known| known.both);
    let mut searched: Vec<u32> = interfaces.exposed().iter().copied().chain(beside).collect();
    searched.sort_unstable();
    searched.dedup();
    searched
}

impl Field<'_> {
    /// Those of some triangles that may come within a distance of other triangles to which no intact interface joins them,
    /// or of atoms, and what bounds all that they meet. Of two triangles one is of this rank.
    fn meeting(&self, triangles: &[u32], atoms: &[u32], distance: f64, position: &Planes) -> Vec<(u32, Bounds)> {
        let corners_of = |&triangle: &u32| {
            let nodes = self.mesh.corners_of(triangle as usize);
            nodes.map(|node| [0, 1].map(|axis: usize| position[axis][node]))
        };
        let corners: Vec<Corners> = triangles.iter().map(corners_of).collect();
        let around = |points: &[[f64; 2]]| {
            let mut bounds = Bounds::NOTHING;
            bounds.include(points);
            bounds
        };
        let bounds: Vec<Bounds> = corners.iter().map(|corners| around(corners)).collect();
        let boxes = Boxes::new(&bounds, distance);
        let mut met = vec![Bounds::NOTHING; triangles.len()];
        let is_mine: Vec<bool> = triangles
            .iter()
            .map(|&triangle| self.domain.is_mine(triangle as usize))
            .collect();
        for one in 0..triangles.len() {
            let near = bounds[one].widened(distance);
            boxes.for_each_near(&near, |other| {
                if other > one
                    && (is_mine[one] || is_mine[other])
                    && near.overlaps(&bounds[other])
                    && !are_apart(&corners[one], &corners[other], distance)
                    && !self.summed_elsewhere(triangles[one], triangles[other])
                {
                    met[one].include(&corners[other]);
                    met[other].include(&corners[one]);
                }
            });
        }
        for &atom in atoms {
            let node = 3 * self.mesh.triangles + atom as usize;
            let place = [position[0][node], position[1][node]];
            boxes.for_each_near(&around(&[place]).widened(distance), |triangle| {
                if !is_apart_from(&corners[triangle], place, distance) {
                    met[triangle].include(&[place]);
                }
            });
        }
        let triangles = triangles.iter().copied().zip(met);
        triangles.filter(|(_, met)| !met.are_nothing()).collect()
    }

    /// Whether a pair of sites of these elements is a bond of the lattice that is summed along strings although they parted.
    fn is_in_a_kept_string(&self, [a, b]: [u32; 2], [from, to]: [[i32; 2]; 2]) -> bool {
        let triangles = self.mesh.triangles as u32;
        if !self.summation.keeps_strings() || a >= triangles || b >= triangles {
            return false;
        }
        let squared = f64::from(triangular::squared_length([to[0] - from[0], to[1] - from[1]]));
        let interface = self.interfaces.between(a as usize, b as usize);
        squared < self.unlisted * self.unlisted
            && interface.is_some_and(|interface| !self.interfaces.pairs[interface].severed)
    }

    /// Whether pairs of sites of these elements are summed elsewhere: inside a triangle or along intact strings.
    fn summed_elsewhere(&self, a: u32, b: u32) -> bool {
        let [a, b] = [a as usize, b as usize];
        if a == b {
            return true;
        }
        let triangles = self.mesh.triangles;
        a < triangles
            && b < triangles
            && self
                .interfaces
                .between(a, b)
                .is_some_and(|interface| self.states[interface] != State::Open)
    }
}

/// Sites that may have partners: those of triangles first, then atoms.
struct Candidates {
    element: Vec<u32>,
    local: Vec<[i16; 2]>,
    position: Vec<[f64; 2]>,
    /// How many of them belong to triangles.
    carried: usize,
}

/// The partners of some consecutive candidates: how many each has, and who they are, ascending.
type Lists = Vec<(Vec<u32>, Vec<Partner>)>;

impl Contacts {
    /// Lists the partners of every site of the triangles to be [searched](searched), and of every atom, at these
    /// positions.
    pub fn search(
        field: &Field,
        triangles: &[u32],
        lattice: &mut AtomLattice,
        material: &Material,
        position: &Planes,
    ) -> Self {
        let skin = Self::SKIN * material.spacing;
        let radius = material.interaction.cutoff() + skin;
        let atoms = lattice.surroundings(field.mesh, position);
        let meeting = field.meeting(triangles, &atoms.candidates, radius, position);
        let candidates = Candidates::new(field.mesh, &meeting, radius, &atoms.candidates, position);
        let grid = Grid::new(&candidates.position, radius);
        let lists = candidates.partner_lists(field, lattice, &atoms, &grid, radius);
        let mut contacts = Self::from_lists(field, lattice, &atoms, &candidates, &lists);
        let first_atom = 3 * field.mesh.triangles as u32;
        let [my_triangles, my_atoms] = [field.domain.grouped(), field.domain.atoms()];
        let mine = triangles
            .iter()
            .filter(|&&triangle| my_triangles.contains(&(triangle as usize)));
        let of_triangles = mine.flat_map(|&triangle| field.mesh.corners_of(triangle as usize).map(|node| node as u32));
        let mine = atoms
            .candidates
            .iter()
            .filter(|&&atom| my_atoms.contains(&(atom as usize)));
        let of_atoms = mine.map(|atom| first_atom + atom);
        contacts.nodes = of_triangles.chain(of_atoms).collect();
        let place = |&node: &u32| [0, 1].map(|axis: usize| position[axis][node as usize]);
        contacts.reference = contacts.nodes.iter().map(place).collect();
        contacts.half_skin = 0.5 * skin;
        contacts.spacing = material.spacing;
        contacts
    }

    /// Keeps all atoms and those sites of triangles that have partners or are partners of mine, and numbers them anew.
    fn from_lists(
        field: &Field,
        lattice: &AtomLattice,
        atoms: &Surroundings,
        candidates: &Candidates,
        lists: &Lists,
    ) -> Self {
        let triangles = field.mesh.triangles;
        let my_atoms = field.domain.atoms();
        let counts: Vec<u32> = lists.iter().flat_map(|(counts, _)| counts).copied().collect();
        let mut contacts = Self::default();
        let met = candidates.others_met(field, lists);
        let mut number = Vec::with_capacity(candidates.element.len());
        for candidate in 0..candidates.carried {
            number.push(contacts.carrier.len());
            if counts[candidate] > 0 || met.binary_search(&(candidate as u32)).is_ok() {
                let triangle = candidates.element[candidate];
                if contacts.of_triangle.last().is_none_or(|&[last, _]| last != triangle) {
                    contacts.of_triangle.push([triangle, contacts.carrier.len() as u32]);
                }
                contacts.carrier.push(triangle);
                contacts.local.push(candidates.local[candidate]);
            }
        }
        let carried = contacts.carrier.len();
        number.extend(atoms.candidates.iter().map(|&atom| carried + atom as usize));
        contacts.of_triangle.push([triangles as u32, carried as u32]);
        contacts.needed = met
            .iter()
            .map(|&candidate| candidates.element[candidate as usize])
            .collect();
        contacts.needed.dedup();
        contacts.weigh_sites(field);
        let each_alone = !contacts.weight.is_empty();
        let partners = &mut contacts.partners;
        let mut next_atom = 0;
        let mut candidate: usize = 0;
        for (counts, mut listed) in lists.iter().map(|(counts, listed)| (counts, listed.as_slice())) {
            for &count in counts {
                let (mine, others) = listed.split_at(count as usize);
                listed = others;
                let renumbered = mine.iter().map(|other| other.renumbered(number[other.site()]));
                match candidate.checked_sub(candidates.carried) {
                    None if count > 0 || met.binary_search(&(candidate as u32)).is_ok() => {
                        partners.push(renumbered, each_alone);
                    }
                    None => {}
                    Some(atom) => {
                        let atom = atoms.candidates[atom] as usize;
                        if atoms.searched[atom] && my_atoms.contains(&atom) {
                            partners.extend(lattice.partners(), next_atom..atom, carried);
                            partners.push(renumbered, each_alone);
                            next_atom = atom + 1;
                        }
                    }
                }
                candidate += 1;
            }
        }
        partners.extend(lattice.partners(), next_atom..atoms.searched.len(), carried);
        partners.finish();
        contacts
    }

    fn weigh_sites(&mut self, field: &Field) {
        if field.summation == Summation::Nodal {
            let carried = self.carrier.iter().zip(&self.local).map(|(&carrier, &local)| {
                let carrier = &field.mesh.elements[carrier as usize];
                field.summation.site_weight(carrier, local.map(i32::from))
            });
            let atoms = field.mesh.elements.len() - field.mesh.triangles;
            self.weight = carried.chain(std::iter::repeat_n(1.0, atoms)).collect();
        }
    }
}

impl Candidates {
    /// Atoms, and the sites of triangles within a distance of what these meet.
    fn new(mesh: &Mesh, meeting: &[(u32, Bounds)], distance: f64, atoms: &[u32], nodes: &Planes) -> Self {
        let mut element = Vec::new();
        let mut local = Vec::new();
        let mut position = Vec::new();
        for &(triangle, met) in meeting {
            for site in mesh.elements[triangle as usize].locals() {
                let place = site_position(mesh, triangle as usize, site, nodes);
                if met.are_within(distance, place) {
                    element.push(triangle);
                    local.push(site.map(|k| k as i16));
                    position.push(place);
                }
            }
        }
        let carried = element.len();
        element.extend(atoms.iter().map(|&atom| mesh.triangles as u32 + atom));
        local.resize(element.len(), [0, 0]);
        let of_atoms = element[carried..].iter().map(|&atom| {
            let node = mesh.node(atom as usize, 0);
            [nodes[0][node], nodes[1][node]]
        });
        position.extend(of_atoms);
        Self {
            element,
            local,
            position,
            carried,
        }
    }

    /// Candidates of other ranks that are partners of mine, ascending.
    fn others_met(&self, field: &Field, lists: &Lists) -> Vec<u32> {
        if field.domain.ranks().count() == 1 {
            return Vec::new();
        }
        let partners = lists.iter().flat_map(|(_, partners)| partners);
        let met = partners.map(|partner| partner.site());
        let others = met.filter(|&candidate| !field.domain.is_mine(self.element[candidate] as usize));
        let mut others: Vec<u32> = others.map(|candidate| candidate as u32).collect();
        others.sort_unstable();
        others.dedup();
        others
    }

    /// The partners of the candidates of this rank; none for the others.
    fn partner_lists(
        &self,
        field: &Field,
        lattice: &AtomLattice,
        atoms: &Surroundings,
        grid: &Grid,
        radius: f64,
    ) -> Lists {
        let chunks = self.element.len().div_ceil(CHUNK);
        let list = |chunk: usize| {
            let mut counts = Vec::with_capacity(CHUNK);
            let mut partners = Vec::with_capacity(8 * CHUNK);
            for candidate in chunk * CHUNK..self.element.len().min((chunk + 1) * CHUNK) {
                let first = partners.len();
                let atom = candidate
                    .checked_sub(self.carried)
                    .map(|at| atoms.candidates[at] as usize);
                let is_searched = atom.is_none_or(|atom| atoms.searched[atom]);
                if is_searched && field.domain.is_mine(self.element[candidate] as usize) {
                    let is_watched = atom.is_some_and(|atom| !lattice.is_disturbed(atom));
                    self.collect_partners(field, grid, radius, candidate, is_watched, &mut partners);
                    partners[first..].sort_unstable_by_key(|partner| partner.site());
                }
                counts.push((partners.len() - first) as u32);
            }
            (counts, partners)
        };
        (0..chunks).into_par_iter().map(list).collect()
    }

    fn collect_partners(
        &self,
        field: &Field,
        grid: &Grid,
        radius: f64,
        candidate: usize,
        is_watched: bool,
        partners: &mut Vec<Partner>,
    ) {
        let [x, y] = self.position[candidate];
        let limit = radius * radius;
        let own = self.element[candidate];
        let site_of = |candidate: usize| {
            let element = &field.mesh.elements[self.element[candidate] as usize];
            element.site(self.local[candidate].map(i32::from))
        };
        let site = site_of(candidate);
        // The sites of an element follow each other in a cell, so the last answer is often the next.
        let mut last = (own, true);
        let mut summed_elsewhere = |element: u32| {
            if element != last.0 {
                last = (element, field.summed_elsewhere(own, element));
            }
            last.1
        };
        grid.for_each_near([x, y], |other| {
            let element = self.element[other];
            if element == own {
                return;
            }
            let [dx, dy] = [self.position[other][0] - x, self.position[other][1] - y];
            if dx * dx + dy * dy < limit && !summed_elsewhere(element) {
                let there = site_of(other);
                if field.is_in_a_kept_string([own, element], [site, there]) {
                    return;
                }
                let pair = if field.mesh.severed(site, there) {
                    PairKind::Severed
                } else if is_watched && other >= self.carried {
                    pair_along([there[0] - site[0], there[1] - site[1]])
                } else {
                    PairKind::Any
                };
                partners.push(Partner::new(other, pair));
            }
        });
    }
}
