//! One computation of the forces of a solid: what tiles, lists and ranks do after each other.

use std::time::Instant;

use rayon::prelude::*;

use super::drift::{Lengths, Moments};
use super::measure::PARTS;
use super::pairs::Pairs;
use super::points::Points;
use super::sweep::{Field, Sweep};
use super::{ForceError, Forces, Measure, Planes};
use crate::domain::{Call, Halo};
use crate::forces::close::{self, Crowd};
use crate::lanes::MOST;
use crate::potential::{CutPotential, PairShape, with_law};

impl Forces {
    /// Forces on all nodes of this rank, eV/nm. Brings the positions that they depend on from other ranks.
    pub fn compute(&mut self, position: &mut Planes, force: &mut Planes) -> Result<(), ForceError> {
        with_law!(self.material.interaction, law => self.sum::<_, false>(&law, position, force, &mut Measure::default()))
    }

    /// The same forces to the bit, and what every element holds.
    pub fn compute_and_measure(
        &mut self,
        position: &mut Planes,
        force: &mut Planes,
        measure: &mut Measure,
    ) -> Result<(), ForceError> {
        measure.fit(self.mesh.elements.len());
        with_law!(self.material.interaction, law => self.sum::<_, true>(&law, position, force, measure))
    }

    /// Sums, and sums again as often as any rank finds that interfaces are not what they were or that lists are out of date.
    fn sum<S: PairShape, const MEASURED: bool>(
        &mut self,
        law: &CutPotential<S>,
        position: &mut Planes,
        force: &mut Planes,
        measure: &mut Measure,
    ) -> Result<(), ForceError> {
        self.exchange(position);
        let mut irregular = self.sum_tiles::<S, MEASURED>(law, position, force, measure);
        loop {
            self.domain.hears_level();
            let mut crowd = Crowd::NONE;
            let is_current = self.pairs.as_mut().is_some_and(|pairs| pairs.follow(position));
            if !irregular.is_empty() {
                self.domain.call(Call::InterfaceChanged);
            } else if !is_current {
                self.domain.call(Call::ListOutdated);
            } else if let Some(pairs) = &mut self.pairs {
                crowd = pairs.sum::<S, MEASURED>(self.arch, law, self.close);
                self.domain.call_level(close::level(crowd.excess));
            }
            self.agree();
            if self.domain.hears(Call::InterfaceChanged) {
                let lost = self.domain.ranks().join(irregular);
                self.open(&lost);
                irregular = self.sum_tiles::<S, MEASURED>(law, position, force, measure);
            } else if self.domain.hears(Call::ListOutdated) {
                if !self.have_only_drifted() {
                    self.search(position)?;
                }
            } else {
                self.shortest = self.shortest.min(crowd.shortest.sqrt());
                break;
            }
        }
        self.close_level = self.domain.hears_level();
        self.add_pairs::<MEASURED>(force, measure);
        Ok(())
    }

    fn exchange(&mut self, position: &mut Planes) {
        let start = Instant::now();
        self.halo.exchange(&self.domain, position, |_| ());
        self.exchange_time += start.elapsed();
    }

    fn agree(&mut self) {
        let start = Instant::now();
        self.domain.agree();
        self.exchanges += 1;
        self.exchange_time += start.elapsed();
    }

    /// Sums of all parts of this rank; returns their interfaces that are no longer regular, ascending.
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
            few: &self.few,
            intact: &self.intact,
            position,
        };
        let [nodes, _] = self.domain.nodes();
        let [elements, _] = self.domain.elements();
        let mut rest = force.each_mut().map(|plane| &mut plane[nodes.clone()]);
        let mut held = measure.planes_mut().map(|plane| match MEASURED {
            true => &mut plane[elements.clone()],
            false => &mut plane[..],
        });
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

    /// Whether all points have moved so evenly that the lists of all ranks are good; all ranks ask together.
    fn have_only_drifted(&mut self) -> bool {
        let Some(pairs) = &mut self.pairs else {
            return false;
        };
        let numbers = self.domain.ranks().merge(&pairs.motion().numbers());
        pairs.drift_with(Moments::from_numbers(&numbers).drift());
        if !pairs.is_current() {
            self.domain.call(Call::ListOutdated);
        }
        self.agree();
        !self.domain.hears(Call::ListOutdated)
    }

    /// Makes new lists of neighbours. Anything may have come near, so all ranks learn all positions.
    fn search(&mut self, position: &mut Planes) -> Result<(), ForceError> {
        let start = Instant::now();
        position.iter_mut().for_each(|axis| self.domain.share_nodes(axis));
        let shared = Instant::now();
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
        let lengths = Lengths::new(self.material.interaction.cutoff(), self.material.spacing);
        let pairs = Pairs::search(points, self.domain.elements(), are_joined, position, lengths);
        let mut needed: Vec<u32> = self.bordering.iter().copied().chain(pairs.needed()).collect();
        needed.sort_unstable();
        needed.dedup();
        needed.retain(|&element| !self.domain.is_mine(element as usize));
        self.halo = Halo::ask(&self.domain, &self.mesh, &needed);
        self.pairs = Some(pairs);
        self.exchange_time += shared - start;
        self.searches += 1;
        self.search_time += shared.elapsed();
        Ok(())
    }

    /// Brings forces on points to the nodes that carry them, and what pairs hold to their elements.
    fn add_pairs<const MEASURED: bool>(&self, force: &mut Planes, measure: &mut Measure) {
        let Some(pairs) = &self.pairs else {
            return;
        };
        let points = &pairs.points;
        let [of_parts, atoms] = pairs.mine();
        for point in of_parts.clone() {
            let [x, y, z] = pairs.force[point / MOST].map(|plane| plane[point % MOST]);
            for &(node, weight) in points.carriers(point) {
                let node = node as usize;
                force[0][node] = x.mul_add(weight, force[0][node]);
                force[1][node] = y.mul_add(weight, force[1][node]);
                force[2][node] = z.mul_add(weight, force[2][node]);
            }
        }
        if !atoms.is_empty() {
            let first_node = points.atom_node(atoms.start);
            for (axis, plane) in force.iter_mut().enumerate() {
                let plane = plane[first_node..first_node + atoms.len()]
                    .par_iter_mut()
                    .zip(atoms.clone());
                plane
                    .with_min_len(4096)
                    .for_each(|(force, point)| *force = pairs.force[point / MOST][axis][point % MOST]);
            }
        }
        if MEASURED {
            let mut planes = measure.planes_mut();
            let [_, own_atoms] = self.domain.elements();
            planes.iter_mut().for_each(|plane| plane[own_atoms.clone()].fill(0.0));
            for point in of_parts.clone().chain(atoms.clone()) {
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
