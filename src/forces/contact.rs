//! Pairs found by neighbour search: atoms, triangles that border them, and whatever is no longer as in the lattice.
//!
//! Each site keeps the full list of its partners by rising number, and sums their forces on its own: pairs are
//! evaluated twice, and in return every sum has one fixed order. A list holds the pairs within the cutoff and a skin;
//! those beyond the cutoff add nothing, so the moment at which a list was made leaves no trace in the result.

mod ahead;
mod boxes;
mod grid;
pub mod lattice;
mod near;
mod partners;
mod search;
mod sums;
pub mod tally;

pub use ahead::{AtomMotion, AtomsAhead};
pub use search::{Field, searched};

use std::ops::Range;

use pulp::Arch;
use rayon::prelude::*;

use super::affine::site_position;
use super::close::{Close, Crowd};
use super::measure::{Measure, PARTS, in_lengths, in_parts};
use super::regular::Regular;
use super::{CHUNK, Planes};
use crate::domain::{Domain, Halo};
use crate::lanes::MOST;
use crate::mesh::Mesh;
use crate::potential::{CutPotential, PairShape};
use partners::{Part, Partners, Step};

/// Sites that may have partners, their lists, and the sums of the last call.
#[derive(Default)]
pub struct Contacts {
    /// Triangle and local coordinates of the sites that triangles carry, by triangle; all atoms follow by number.
    carrier: Vec<u32>,
    local: Vec<[i16; 2]>,
    /// The triangles that have sites, ascending, and where those of each start; one past all with their total at the end. Empty:
    /// nothing has been searched yet.
    of_triangle: Vec<[u32; 2]>,
    /// How many sites each stands for; empty where each stands for itself.
    weight: Vec<f64>,
    partners: Partners,
    /// Elements of other ranks whose sites are partners of mine, ascending.
    needed: Vec<u32>,
    /// Atoms of this rank and partners of its sites.
    placed: Vec<Range<usize>>,
    /// Those of them that are looked at one by one.
    met: Vec<Range<usize>>,
    /// Nodes of what was searched, where they were, and how far one may go from there, nm.
    nodes: Vec<u32>,
    reference: Vec<[f64; 2]>,
    half_skin: f64,
    /// Where the faces of a cut meet, nm.
    spacing: f64,
    /// With room for lanes beyond the last site.
    position: Planes,
    /// Sums of the sites that triangles carry.
    of_carried: [Vec<f64>; SUMS],
}

/// Sums of a site: its force, x and y, and half of what its bonds hold.
const SUMS: usize = 2 + PARTS;

/// What the sums are taken over.
pub struct SumField<'a, S> {
    pub arch: Arch,
    pub law: &'a CutPotential<S>,
    pub regular: Option<Regular>,
    /// The same, where the cutoff leaves such bonds untouched.
    pub untouched: Option<Regular>,
    pub close: Close,
    pub mesh: &'a Mesh,
    pub domain: &'a Domain,
}

/// What the sums have found.
pub struct Found {
    /// Atoms that turn out to be disturbed.
    pub disturbed: Vec<u32>,
    /// Nodes of atoms that have not moved ahead.
    pub left: Vec<Range<usize>>,
    pub crowd: Crowd,
}

impl Contacts {
    /// Lists are made with pairs up to the cutoff plus this, in spacings. With the cutoff of nearest neighbours it
    /// ends short of the second shell.
    const SKIN: f64 = 0.35;

    /// Sites in one parallel task. It sets no order of summation.
    const TASK: usize = 1024;

    /// Makes the next call search anew.
    pub fn forget(&mut self) {
        self.of_triangle.clear();
    }

    /// Whether the lists still hold every pair within the cutoff, as far as that depends on what was searched.
    pub fn are_current(&self, position: &Planes) -> bool {
        if self.of_triangle.is_empty() {
            return false;
        }
        let limit = self.half_skin * self.half_skin;
        let is_near = |(&node, from): (&u32, &[f64; 2])| {
            let [x, y] = [0, 1].map(|axis| position[axis][node as usize] - from[axis]);
            // Written so that a position that is not a number fails.
            x * x + y * y <= limit
        };
        let nodes = self
            .nodes
            .par_chunks(Self::TASK)
            .zip(self.reference.par_chunks(Self::TASK));
        nodes.all(|(nodes, reference)| nodes.iter().zip(reference).all(is_near))
    }

    /// The sites of an element that may have partners.
    #[inline(always)]
    pub fn sites_of(&self, mesh: &Mesh, element: usize) -> Range<usize> {
        match element.checked_sub(mesh.triangles) {
            None => self.sites_of_triangles(element..element + 1),
            Some(atom) => {
                let site = self.carrier.len() + atom;
                site..site + 1
            }
        }
    }

    #[inline(always)]
    pub fn local(&self, site: usize) -> [i32; 2] {
        self.local.get(site).map_or([0, 0], |local| local.map(i32::from))
    }

    /// Computes where the sites are and what force each feels, eV/nm. Puts the forces of atoms where they belong, and what
    /// atoms hold if it is to be `MEASURED`. Atoms that move `ahead` need not have their forces put down.
    pub fn sum<S: PairShape, const MEASURED: bool>(
        &mut self,
        field: &SumField<S>,
        position: &Planes,
        force: &mut Planes,
        measure: &mut Measure,
        ahead: Option<AtomsAhead>,
    ) -> Found {
        self.spacing = field.mesh.spacing;
        self.place_sites(field.mesh, position, ahead.is_none());
        let carried = self.carrier.len();
        let mut of_carried = std::mem::take(&mut self.of_carried);
        for (part, plane) in of_carried.iter_mut().enumerate() {
            plane.resize(if MEASURED || part < 2 { carried } else { 0 }, 0.0);
        }
        let mine = self.sites_of_triangles(field.domain.grouped());
        let own = of_carried.each_mut().map(|plane| part_of(plane, &mine));
        let places = position.each_ref().map(|plane| &plane[3 * field.mesh.triangles..]);
        let of_triangles = self.sum_sites::<S, MEASURED>(field, mine, own, places, Vec::new());
        self.of_carried = of_carried;
        let triangles = field.mesh.triangles;
        let atoms = field.domain.atoms();
        let [_, nodes] = field.domain.nodes();
        let [x, y] = force.each_mut().map(|plane| &mut plane[nodes.clone()]);
        let [_, held] = measure.split(triangles);
        let [energy, pairs, xx, yy, xy] = held.map(|plane| part_of(plane, &atoms));
        let of_atoms = [x, y, energy, pairs, xx, yy, xy];
        let sites = carried + atoms.start..carried + atoms.end;
        let first = nodes.start - (sites.start - carried);
        let ahead = ahead.map_or_else(Vec::new, |ahead| ahead.tasks(sites.clone(), nodes, Self::TASK));
        let of_atoms = self.sum_sites::<S, MEASURED>(field, sites, of_atoms, places, ahead);
        let close = of_triangles.iter().chain(&of_atoms).flat_map(|found| &found.close);
        let crowds = close.map(|&site| self.crowd(field, site as usize, places));
        let crowd = crowds.fold(Crowd::NONE, Crowd::and);
        let (mut disturbed, mut left) = (Vec::new(), Vec::new());
        for found in of_atoms {
            disturbed.extend(found.irregular.into_iter().map(|site| site - carried as u32));
            let nodes = |sites: Range<usize>| first + sites.start - carried..first + sites.end - carried;
            left.extend(found.left.into_iter().map(nodes));
        }
        Found { disturbed, left, crowd }
    }

    /// What its close bonds do to a site.
    fn crowd<S: PairShape>(&self, field: &SumField<S>, site: usize, atoms: [&[f64]; 2]) -> Crowd {
        // Those of atoms that are not looked at one by one are not kept.
        let place = |site: usize| match site.checked_sub(self.carrier.len()) {
            Some(atom) => atoms.map(|plane| plane[atom]),
            None => self.position.each_ref().map(|plane| plane[site]),
        };
        let [here_x, here_y] = place(site);
        let mut crowd = Crowd::NONE;
        self.partners.for_each_of(site, |partner| {
            let [x, y] = place(partner.site());
            let squared = (x - here_x) * (x - here_x) + (y - here_y) * (y - here_y);
            let count = self.count(site, partner.site());
            crowd.add(field.close, field.law, squared, partner.severed(), count);
        });
        crowd
    }

    /// Sums of consecutive sites, and what each task has found.
    fn sum_sites<S: PairShape, const MEASURED: bool>(
        &self,
        field: &SumField<S>,
        sites: Range<usize>,
        sums: [&mut [f64]; SUMS],
        atoms: [&[f64]; 2],
        mut ahead: Vec<Option<ahead::Task>>,
    ) -> Vec<sums::Found> {
        let parts = in_parts(sums, Self::TASK, sites.len().div_ceil(Self::TASK));
        let starts = sites.clone().step_by(Self::TASK);
        ahead.resize_with(starts.len(), || None);
        let tasks: Vec<_> = starts.zip(parts).zip(ahead).collect();
        let sum = |((from, sums), ahead): ((usize, [&mut [f64]; SUMS]), Option<ahead::Task>)| {
            let task = from..sites.end.min(from + Self::TASK);
            sums::sum_sites::<S, MEASURED>(field, self, atoms, task, sums, ahead)
        };
        tasks.into_par_iter().map(sum).collect()
    }

    /// Adds the last sums of the sites that triangles carry to the forces on nodes and to what triangles hold.
    pub fn add_to(&self, mesh: &Mesh, domain: &Domain, force: &mut Planes, measure: &mut Measure) {
        if self.carrier.is_empty() {
            return;
        }
        let mine = domain.grouped();
        let groups = mesh.groups.of_range(&mine);
        let [nodes, _] = domain.nodes();
        let [x, y, held @ ..] = &self.of_carried;
        for (plane, of_site) in force.iter_mut().zip([x, y]) {
            let lengths = groups.iter().map(|group| group.nodes().len());
            let parts: Vec<_> = groups
                .iter()
                .zip(in_lengths([&mut plane[nodes.clone()]], lengths))
                .collect();
            parts.into_par_iter().for_each(|(group, [force])| {
                for (site, carrier) in self.carried_by(group.elements.clone()) {
                    let weights = mesh.elements[carrier].shape_functions(self.local(site));
                    for (corner, weight) in weights.into_iter().enumerate() {
                        force[group.node(carrier, corner) - group.nodes().start] += weight * of_site[site];
                    }
                }
            });
        }
        let [of_triangles, _] = measure.split(mesh.triangles);
        for (plane, of_site) in of_triangles.into_iter().zip(held) {
            for (site, carrier) in self.carried_by(within(&mine, plane.len())) {
                plane[carrier] += of_site[site];
            }
        }
    }

    /// The sites of some triangles, and by which each is carried.
    fn carried_by(&self, triangles: Range<usize>) -> impl Iterator<Item = (usize, usize)> {
        let sites = self.sites_of_triangles(triangles);
        sites.map(|site| (site, self.carrier[site] as usize))
    }

    fn sites_of_triangles(&self, triangles: Range<usize>) -> Range<usize> {
        let first = |triangle: usize| {
            let before = self
                .of_triangle
                .partition_point(|&[known, _]| (known as usize) < triangle);
            self.of_triangle[before][1] as usize
        };
        first(triangles.start)..first(triangles.end)
    }

    /// Elements of other ranks whose sites are partners of mine, ascending.
    pub fn needed(&self) -> &[u32] {
        &self.needed
    }

    /// Tells which atoms have places to follow.
    pub fn place_atoms(&mut self, domain: &Domain, halo: &Halo) {
        self.placed = halo.atoms(domain).chain([domain.atoms()]).collect();
        let carried = self.carrier.len();
        let mut is_met = vec![false; self.partners.site_count() - carried];
        let mine = self.sites_of_triangles(domain.grouped());
        let atoms = domain.atoms();
        for sites in [mine, carried + atoms.start..carried + atoms.end] {
            for part in self.partners.parts(sites) {
                let sites = match part {
                    Part::Alike { sites, steps } if self.are_atoms(&sites, steps) => continue,
                    Part::Alike { sites, .. } | Part::Listed { sites, .. } => sites,
                };
                for site in sites {
                    let mut meet = |site: usize| {
                        if let Some(atom) = site.checked_sub(carried) {
                            is_met[atom] = true;
                        }
                    };
                    meet(site);
                    self.partners.for_each_of(site, |partner| meet(partner.site()));
                }
            }
        }
        let mut met = Vec::new();
        for (atom, _) in is_met.iter().enumerate().filter(|(_, met)| **met) {
            match met.last_mut() {
                Some(Range { end, .. }) if *end == atom => *end += 1,
                _ => met.push(atom..atom + 1),
            }
        }
        self.met = met;
    }

    /// Whether some alike sites and all that they meet are atoms.
    fn are_atoms(&self, sites: &Range<usize>, steps: &[Step]) -> bool {
        let lowest = steps.iter().map(|step| step.by as isize).fold(0, isize::min);
        sites.start.wrapping_add_signed(lowest) >= self.carrier.len() && sites.start >= self.carrier.len()
    }

    /// Brings the positions of the sites up to date: of all, or of those alone that are looked at one by one.
    fn place_sites(&mut self, mesh: &Mesh, position: &Planes, all: bool) {
        let [mut site_x, mut site_y] = std::mem::take(&mut self.position);
        let sites = self.partners.site_count();
        site_x.resize(sites + MOST, 0.0);
        site_y.resize(sites + MOST, 0.0);
        let (carried_x, atoms_x) = site_x[..sites].split_at_mut(self.carrier.len());
        let (carried_y, atoms_y) = site_y[..sites].split_at_mut(self.carrier.len());
        let planes = carried_x.par_chunks_mut(CHUNK).zip(carried_y.par_chunks_mut(CHUNK));
        planes.enumerate().for_each(|(chunk, (x, y))| {
            for k in 0..x.len() {
                let site = chunk * CHUNK + k;
                [x[k], y[k]] = site_position(mesh, self.carrier[site] as usize, self.local(site), position);
            }
        });
        for (atoms, nodes) in [atoms_x, atoms_y].into_iter().zip(position) {
            let nodes = &nodes[3 * mesh.triangles..];
            for placed in if all { &self.placed } else { &self.met } {
                let planes = atoms[placed.clone()].par_chunks_mut(Self::TASK);
                let planes = planes.zip(nodes[placed.clone()].par_chunks(Self::TASK));
                planes.for_each(|(atoms, nodes)| atoms.copy_from_slice(nodes));
            }
        }
        self.position = [site_x, site_y];
    }

    /// How many pairs one of two sites stands for.
    #[inline(always)]
    fn count(&self, site: usize, other: usize) -> f64 {
        match self.weight.is_empty() {
            true => 1.0,
            false => 0.5 * (self.weight[site] + self.weight[other]),
        }
    }

    /// Calls with the vector to each listed partner of a site, whether a cut severs the pair, and how many it stands for.
    #[inline(always)]
    pub fn for_each_partner(&self, site: usize, mut call: impl FnMut([f64; 2], bool, f64)) {
        let [x, y] = [self.position[0][site], self.position[1][site]];
        self.partners.for_each_of(site, |partner| {
            let other = partner.site();
            let vector = [self.position[0][other] - x, self.position[1][other] - y];
            call(vector, partner.severed(), self.count(site, other));
        });
    }
}

/// The part of a range that a plane has; none of a plane that is not kept.
fn within(range: &Range<usize>, length: usize) -> Range<usize> {
    range.start.min(length)..range.end.min(length)
}

pub(super) fn part_of<'a>(plane: &'a mut [f64], range: &Range<usize>) -> &'a mut [f64] {
    let range = within(range, plane.len());
    &mut plane[range]
}
