//! Pairs found by neighbour search: atoms, triangles that border them, and whatever is no longer as in the lattice.
//!
//! Each site keeps the full list of its partners by rising number, and sums their forces on its own: pairs are
//! evaluated twice, and in return every sum has one fixed order. A list holds the pairs within the cutoff and a skin;
//! those beyond the cutoff add nothing, so the moment at which a list was made leaves no trace in the result.

pub mod lattice;
mod partners;
mod search;
mod sums;
pub mod tally;

pub use search::Field;

use std::ops::Range;

use pulp::Arch;
use rayon::prelude::*;

use super::affine::site_position;
use super::regular::Regular;
use super::{CHUNK, Planes};
use crate::lanes::MOST;
use crate::mesh::Mesh;
use crate::potential::{CutPotential, PairShape};
use partners::Partners;

/// Sites that may have partners, their lists, and the sums of the last call.
#[derive(Default)]
pub struct Contacts {
    /// Triangle and local coordinates of the sites that triangles carry, by triangle; all atoms follow by number.
    carrier: Vec<u32>,
    local: Vec<[i16; 2]>,
    /// Where each triangle's sites start, and their total at the end. Empty: nothing has been searched yet.
    of_triangle: Vec<u32>,
    /// How many sites each stands for; empty where each stands for itself.
    weight: Vec<f64>,
    partners: Partners,
    /// Nodes of what was searched, where they were, and how far one may go from there, nm.
    nodes: Vec<u32>,
    reference: Vec<[f64; 2]>,
    half_skin: f64,
    /// Where the faces of a cut meet, nm.
    spacing: f64,
    /// With room for lanes beyond the last site.
    position: Planes,
    force: Planes,
}

/// What the sums are taken over.
pub struct SumField<'a, S> {
    pub arch: Arch,
    pub law: &'a CutPotential<S>,
    pub regular: Option<Regular>,
    pub mesh: &'a Mesh,
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
            None => self.of_triangle[element] as usize..self.of_triangle[element + 1] as usize,
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

    /// Computes where the sites are and what force each feels, eV/nm; returns atoms that turn out to be disturbed.
    pub fn sum<S: PairShape>(&mut self, field: &SumField<S>, position: &Planes) -> Vec<u32> {
        self.spacing = field.mesh.spacing;
        self.place_sites(field.mesh, position);
        let [mut force_x, mut force_y] = std::mem::take(&mut self.force);
        force_x.resize(self.partners.site_count(), 0.0);
        force_y.resize(self.partners.site_count(), 0.0);
        let planes = force_x
            .par_chunks_mut(Self::TASK)
            .zip(force_y.par_chunks_mut(Self::TASK));
        let irregular = planes.enumerate().flat_map_iter(|(task, (x, y))| {
            let sites = task * Self::TASK..task * Self::TASK + x.len();
            sums::sum_sites(field.arch, self, field.law, field.regular, sites, x, y)
        });
        let carried = self.carrier.len() as u32;
        let irregular = irregular.map(|site| site - carried).collect();
        self.force = [force_x, force_y];
        irregular
    }

    /// Adds the forces of the last call of [`Self::sum`] to those on the nodes of triangles and puts them on atoms.
    pub fn add_to(&self, mesh: &Mesh, force: &mut Planes) {
        let sites = self.carrier.len();
        let nodes = 3 * mesh.triangles;
        for (axis, force) in force.iter_mut().enumerate() {
            let (triangles, atoms) = force.split_at_mut(nodes);
            let chunks = triangles.par_chunks_mut(3 * CHUNK).enumerate();
            chunks.for_each(|(chunk, force)| self.add_to_triangles(mesh, chunk * CHUNK, &self.force[axis], force));
            let planes = atoms
                .par_chunks_mut(Self::TASK)
                .zip(self.force[axis][sites..].par_chunks(Self::TASK));
            planes.for_each(|(atoms, forces)| atoms.copy_from_slice(forces));
        }
    }

    fn add_to_triangles(&self, mesh: &Mesh, from: usize, of_site: &[f64], force: &mut [f64]) {
        let [first, last] = [from, from + force.len() / 3].map(|triangle| self.of_triangle[triangle] as usize);
        for site in first..last {
            let carrier = self.carrier[site] as usize;
            let weights = mesh.elements[carrier].shape_functions(self.local(site));
            (0..3).for_each(|node| force[3 * (carrier - from) + node] += weights[node] * of_site[site]);
        }
    }

    /// Brings the positions of the sites up to date.
    pub fn place_sites(&mut self, mesh: &Mesh, position: &Planes) {
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
            let planes = atoms.par_chunks_mut(Self::TASK);
            let planes = planes.zip(nodes[3 * mesh.triangles..].par_chunks(Self::TASK));
            planes.for_each(|(atoms, nodes)| atoms.copy_from_slice(nodes));
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
