//! Forces on the nodes of a solid as the exact gradient of one energy, the plain sum over site pairs within the cutoff.
//!
//! Every pair is summed in exactly one of three ways, as in two dimensions: inside a part by classes of equal bonds
//! (`inside`), between parts whose interface is intact by patches and strings (`faces`, `edges`), and everywhere else by a
//! neighbour search (`pairs`). [`referee`] sums over all pairs without any of this.
//!
//! Interfaces are used where the potential reaches nearest neighbours alone. One is intact as long as all of its bonds are
//! within the cutoff and no second neighbours across it are; then it opens for good.

mod edges;
mod faces;
mod frequency;
mod grid;
mod inside;
mod measure;
mod pairs;
mod points;
pub mod referee;
mod sweep;
#[cfg(test)]
mod tests;
mod vector;

pub use measure::Measure;

use std::collections::HashMap;

use pulp::Arch;
use rayon::prelude::*;

use crate::lanes::MOST;
use crate::material::Material;
use crate::mesh::solid::Solid;
use crate::mesh::solid::element::Shape;
use crate::mesh::solid::interfaces::{Interfaces, SECOND_NEIGHBOURS};
use crate::potential::{CutPotential, PairShape, with_law};
use inside::Class;
use measure::PARTS;
use pairs::Pairs;
use points::Points;
use sweep::{Field, Sweep, Tile};

/// Node positions or forces: x, y and z, one entry a node.
pub type Planes = [Vec<f64>; 3];

/// Why no forces can be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ForceError {
    #[error("element {element} flew away")]
    FlewAway { element: usize },
}

/// Bonds this much longer than the cutoff (in spacings) are summed inside parts, because they come within it where parts are
/// compressed.
const LISTED_BEYOND_CUTOFF: f64 = 0.3;

/// Largest coordinate over the largest of the specimen. No fragment flies so far in the time of a run.
const FARTHEST: f64 = 100.0;

/// The force computation of one solid: its mesh and material and what it remembers between steps.
pub struct Forces {
    mesh: Solid,
    material: Material,
    interfaces: Interfaces,
    classes: HashMap<(Shape, i32), Vec<Class>>,
    /// One for each interface that is intact, zero for others.
    intact: Vec<f64>,
    tiles: Vec<Tile>,
    /// `None` before the first search and after an interface has opened.
    pairs: Option<Pairs>,
    farthest: f64,
    arch: Arch,
    searches: u64,
}

impl Forces {
    pub fn new(mesh: Solid, material: Material) -> Self {
        let reach = material.interaction.cutoff() / material.spacing;
        let reaches_second_neighbours = reach > SECOND_NEIGHBOURS;
        let interfaces = Interfaces::new(&mesh, reach);
        let mut classes = HashMap::new();
        for group in mesh.groups() {
            let of_kind = || inside::classes(group.shape, group.size, reach + LISTED_BEYOND_CUTOFF);
            classes.entry((group.shape, group.size)).or_insert_with(of_kind);
        }
        let intact = if reaches_second_neighbours { 0.0 } else { 1.0 };
        let largest = mesh
            .node_positions()
            .iter()
            .flatten()
            .fold(mesh.spacing, |most: f64, place| most.max(place.abs()));
        Self {
            intact: vec![intact; interfaces.pairs.len()],
            tiles: sweep::tiles(&mesh, &interfaces, rayon::current_num_threads()),
            farthest: FARTHEST * largest,
            mesh,
            material,
            interfaces,
            classes,
            pairs: None,
            arch: Arch::new(),
            searches: 0,
        }
    }

    pub fn mesh(&self) -> &Solid {
        &self.mesh
    }

    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Numbers of the interfaces that are no longer intact, ascending: the only memory that a restart must keep.
    pub fn open_interfaces(&self) -> Vec<u32> {
        let open = (0..).zip(&self.intact).filter(|(_, intact)| **intact == 0.0);
        open.map(|(number, _)| number).collect()
    }

    /// Puts back what [`Self::open_interfaces`] gave.
    pub fn restore_open_interfaces(&mut self, open: &[u32]) {
        self.intact.fill(1.0);
        self.open(open);
    }

    /// The two elements of an interface.
    pub fn beside(&self, interface: u32) -> [u32; 2] {
        self.interfaces.pairs[interface as usize]
    }

    pub fn interface_count(&self) -> usize {
        self.intact.len()
    }

    /// How often neighbours were searched.
    pub fn searches(&self) -> u64 {
        self.searches
    }

    fn open(&mut self, interfaces: &[u32]) {
        interfaces.iter().for_each(|&number| self.intact[number as usize] = 0.0);
        self.pairs = None;
    }

    /// Forces on all nodes, eV/nm.
    pub fn compute(&mut self, position: &Planes, force: &mut Planes) -> Result<(), ForceError> {
        with_law!(self.material.interaction, law => self.sum::<_, false>(&law, position, force, &mut Measure::default()))
    }

    /// The same forces to the bit, and what every element holds.
    pub fn compute_and_measure(
        &mut self,
        position: &Planes,
        force: &mut Planes,
        measure: &mut Measure,
    ) -> Result<(), ForceError> {
        measure.fit(self.mesh.elements.len());
        with_law!(self.material.interaction, law => self.sum::<_, true>(&law, position, force, measure))
    }

    fn sum<S: PairShape, const MEASURED: bool>(
        &mut self,
        law: &CutPotential<S>,
        position: &Planes,
        force: &mut Planes,
        measure: &mut Measure,
    ) -> Result<(), ForceError> {
        loop {
            let irregular = self.sum_tiles::<S, MEASURED>(law, position, force, measure);
            if irregular.is_empty() {
                break;
            }
            self.open(&irregular);
        }
        let is_current = self.pairs.as_mut().is_some_and(|pairs| pairs.follow(position));
        if !is_current {
            self.search(position)?;
        }
        let arch = self.arch;
        if let Some(pairs) = &mut self.pairs {
            pairs.sum::<S, MEASURED>(arch, law);
        }
        self.add_pairs::<MEASURED>(force, measure);
        Ok(())
    }

    /// Sums of all parts; returns the interfaces that are no longer regular, ascending.
    fn sum_tiles<S: PairShape, const MEASURED: bool>(
        &self,
        law: &CutPotential<S>,
        position: &Planes,
        force: &mut Planes,
        measure: &mut Measure,
    ) -> Vec<u32> {
        let field = Field {
            law: *law,
            mesh: &self.mesh,
            classes: &self.classes,
            intact: &self.intact,
            position,
        };
        let mut rest = force.each_mut().map(|plane| &mut plane[..]);
        let mut held = measure.planes_mut().map(|plane| &mut plane[..]);
        let mut tasks = Vec::with_capacity(self.tiles.len());
        for tile in &self.tiles {
            let force = rest.each_mut().map(|plane| split_off(plane, tile.nodes.len()));
            let held = held.each_mut().map(|plane| split_off(plane, tile.elements.len()));
            tasks.push(Sweep::<S, MEASURED> {
                field: &field,
                tile,
                force,
                held,
            });
        }
        let irregular = tasks.into_par_iter().flat_map_iter(|sweep| self.arch.dispatch(sweep));
        let mut irregular: Vec<u32> = irregular.collect();
        irregular.sort_unstable();
        irregular.dedup();
        irregular
    }

    fn search(&mut self, position: &Planes) -> Result<(), ForceError> {
        // Written so that a position that is not a number is refused.
        let is_near = |node: &usize| position.iter().all(|plane| plane[*node].abs() <= self.farthest);
        if let Some(node) = (0..self.mesh.node_count()).find(|node| !is_near(node)) {
            let element = self.mesh.element_of_node(node);
            return Err(ForceError::FlewAway { element });
        }
        let points = Points::new(&self.mesh, &self.interfaces, &self.intact, position);
        let are_joined = |one: u32, other: u32| {
            let numbers = self.interfaces.of(one as usize).iter();
            let mut joining = numbers.filter(|&&number| self.intact[number as usize] > 0.0);
            joining.any(|&number| self.interfaces.pairs[number as usize].contains(&other))
        };
        let lengths = [self.material.interaction.cutoff(), self.material.spacing];
        let mut pairs = Pairs::search(points, are_joined, position, lengths);
        pairs.follow(position);
        self.pairs = Some(pairs);
        self.searches += 1;
        Ok(())
    }

    /// Brings forces on points to the nodes that carry them, and what pairs hold to their elements.
    fn add_pairs<const MEASURED: bool>(&self, force: &mut Planes, measure: &mut Measure) {
        let Some(pairs) = &self.pairs else {
            return;
        };
        let points = &pairs.points;
        for point in 0..points.of_parts() {
            let [x, y, z] = pairs.force[point / MOST].map(|plane| plane[point % MOST]);
            for &(node, weight) in points.carriers(point) {
                let node = node as usize;
                force[0][node] = x.mul_add(weight, force[0][node]);
                force[1][node] = y.mul_add(weight, force[1][node]);
                force[2][node] = z.mul_add(weight, force[2][node]);
            }
        }
        let [first_node, first_group] = [self.mesh.part_nodes(), points.first_atom() / MOST];
        for (axis, plane) in force.iter_mut().enumerate() {
            let atoms = plane[first_node..]
                .par_chunks_mut(MOST)
                .zip(pairs.force[first_group..].par_iter());
            atoms
                .with_min_len(512)
                .for_each(|(plane, sums)| plane.copy_from_slice(&sums[axis][..plane.len()]));
        }
        if MEASURED {
            let mut planes = measure.planes_mut();
            planes.iter_mut().for_each(|plane| plane[self.mesh.parts..].fill(0.0));
            for point in (0..points.len()).filter(|&point| points.is_point(point)) {
                let element = points.element[point] as usize;
                for part in 0..PARTS {
                    planes[part][element] += 0.5 * pairs.held[point / MOST][part][point % MOST];
                }
            }
        }
    }
}

fn split_off<'a>(plane: &mut &'a mut [f64], length: usize) -> &'a mut [f64] {
    let length = length.min(plane.len());
    let (part, rest) = std::mem::take(plane).split_at_mut(length);
    *plane = rest;
    part
}
