//! Pairs found by neighbour search: atoms, triangles that border them, and whatever is no longer as in the lattice.
//!
//! Each site keeps the full list of its partners by rising number, and sums their forces on its own: pairs are
//! evaluated twice, and in return every sum has one fixed order. A list holds the pairs within the cutoff and a skin;
//! those beyond the cutoff add nothing, so the moment at which a list was made leaves no trace in the result.

mod search;
mod sums;

pub use search::Field;
use sums::sum_chunk;

use std::ops::Range;

use rayon::prelude::*;

use super::affine::site_position;
use super::{CHUNK, Planes};
use crate::mesh::Mesh;
use crate::potential::{CutPotential, PairShape};

/// Sites that have partners, their lists, and the sums of the last call.
#[derive(Default)]
pub struct Contacts {
    /// Element and local coordinates of each site, by element.
    element: Vec<u32>,
    local: Vec<[i16; 2]>,
    /// How many sites each stands for; empty where each stands for itself.
    weight: Vec<f64>,
    /// Where each site's partners start, and the total at the end.
    start: Vec<u32>,
    partners: Vec<Partner>,
    /// Where each element's sites start, and the total at the end. Empty: nothing has been searched yet.
    of_element: Vec<u32>,
    /// Node positions when the lists were made, and how far a node may go from there, nm.
    reference: Planes,
    /// Triangles whose sites are in the search. Atoms always are.
    searched: Vec<bool>,
    half_skin: f64,
    /// Where the faces of a cut meet, nm.
    spacing: f64,
    position: Planes,
    force: Planes,
}

/// Number of another site; the top bit says that a cut severs the pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Partner(u32);

impl Partner {
    const SEVERED: u32 = 1 << 31;

    fn new(site: usize, severed: bool) -> Self {
        Self(site as u32 | if severed { Self::SEVERED } else { 0 })
    }

    #[inline(always)]
    fn site(self) -> usize {
        (self.0 & !Self::SEVERED) as usize
    }

    #[inline(always)]
    fn severed(self) -> bool {
        self.0 & Self::SEVERED != 0
    }
}

impl Contacts {
    /// Lists are made with pairs up to the cutoff plus this, in spacings. With the cutoff of nearest neighbours it
    /// ends short of the second shell.
    const SKIN: f64 = 0.35;

    /// Makes the next call search anew.
    pub fn forget(&mut self) {
        self.of_element.clear();
    }

    /// Whether the lists still hold every pair within the cutoff.
    pub fn are_current(&self, mesh: &Mesh, position: &Planes) -> bool {
        if self.of_element.is_empty() {
            return false;
        }
        let limit = self.half_skin * self.half_skin;
        let near = |node: usize| {
            let [x, y] = [0, 1].map(|axis| position[axis][node] - self.reference[axis][node]);
            // Written so that a position that is not a number fails.
            x * x + y * y <= limit
        };
        let triangles = (0..mesh.triangles).into_par_iter().with_min_len(CHUNK);
        let atoms = (3 * mesh.triangles..mesh.node_count())
            .into_par_iter()
            .with_min_len(CHUNK);
        triangles.all(|triangle| !self.searched[triangle] || (3 * triangle..3 * triangle + 3).all(near))
            && atoms.all(near)
    }

    /// The sites of an element that have partners.
    #[inline(always)]
    pub fn sites_of(&self, element: usize) -> Range<usize> {
        self.of_element[element] as usize..self.of_element[element + 1] as usize
    }

    #[inline(always)]
    pub fn local(&self, site: usize) -> [i32; 2] {
        self.local[site].map(i32::from)
    }

    /// Force on a site by the last call of [`Self::sum`], eV/nm.
    #[inline(always)]
    pub fn force_on(&self, site: usize) -> [f64; 2] {
        [self.force[0][site], self.force[1][site]]
    }

    /// Computes where the sites are and what force each feels.
    pub fn sum<S: PairShape>(&mut self, law: &CutPotential<S>, mesh: &Mesh, spacing: f64, position: &Planes) {
        self.spacing = spacing;
        self.place_sites(mesh, position);
        let [mut force_x, mut force_y] = std::mem::take(&mut self.force);
        force_x.resize(self.element.len(), 0.0);
        force_y.resize(self.element.len(), 0.0);
        let planes = force_x.par_chunks_mut(CHUNK).zip(force_y.par_chunks_mut(CHUNK));
        planes
            .enumerate()
            .for_each(|(chunk, (x, y))| sum_chunk(self, law, chunk * CHUNK, x, y));
        self.force = [force_x, force_y];
    }

    /// Brings the positions of the sites up to date.
    pub fn place_sites(&mut self, mesh: &Mesh, position: &Planes) {
        let [mut site_x, mut site_y] = std::mem::take(&mut self.position);
        site_x.resize(self.element.len(), 0.0);
        site_y.resize(self.element.len(), 0.0);
        let planes = site_x.par_chunks_mut(CHUNK).zip(site_y.par_chunks_mut(CHUNK));
        planes.enumerate().for_each(|(chunk, (x, y))| {
            for k in 0..x.len() {
                let site = chunk * CHUNK + k;
                [x[k], y[k]] = site_position(mesh, self.element[site] as usize, self.local(site), position);
            }
        });
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
        for &partner in &self.partners[self.start[site] as usize..self.start[site + 1] as usize] {
            let other = partner.site();
            let count = self.count(site, other);
            call(
                [self.position[0][other] - x, self.position[1][other] - y],
                partner.severed(),
                count,
            );
        }
    }
}
