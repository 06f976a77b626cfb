//! One computation of the forces of a solid: what tiles, lists and ranks do after each other.

use std::collections::BTreeSet;
use std::ops::Range;
use std::time::Instant;

use rayon::prelude::*;

use super::drift::{Lengths, Moments};
use super::exposed::{self, Exposed, Sides};
use super::measure::PARTS;
use super::pairs::{self, Pairs};
use super::points::Points;
use super::scene::Scene;
use super::strained::{self, Strained};
use super::sweep::{self, Field, Sweep, Tile};
use super::{ForceError, Forces, Measure, Planes};
use crate::domain::{Call, Halo, Of};
use crate::forces::close::{self, Crowd};
use crate::lanes::MOST;
use crate::mesh::solid::interfaces::Run;
use crate::potential::{CutPotential, PairShape, with_law};

/// Runs of interfaces in one parallel task.
const RUNS_IN_A_TASK: usize = 256;

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
        let mut irregular = self.sum_tiles::<S, MEASURED>(&self.tiles, law, position, force, measure);
        loop {
            self.domain.hears_level();
            let mut crowd = Crowd::NONE;
            let is_current = self.pairs.as_mut().is_some_and(|pairs| pairs.follow(position));
            if !irregular.is_empty() {
                self.domain.call(Call::InterfaceChanged);
            } else if !is_current {
                self.domain.call(Call::ListOutdated);
            } else if let Some(pairs) = &mut self.pairs {
                crowd = pairs.sum::<S, MEASURED>(self.arch, law, self.close_bonds.close);
                self.domain.call_level(close::level(crowd.excess));
            }
            self.agree();
            if self.domain.hears(Call::InterfaceChanged) {
                let lost = self.domain.ranks().join(irregular);
                self.open(&lost);
                irregular = self.sum_again::<S, MEASURED>(&lost, law, position, force, measure);
            } else if self.domain.hears(Call::ListOutdated) {
                if !self.have_only_drifted(position) {
                    self.search(position)?;
                }
            } else {
                self.close_bonds.note(crowd, self.domain.hears_level());
                break;
            }
        }
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

    /// Sums again what the loss of some interfaces has left unfinished: those of the groups of parts beside them.
    fn sum_again<S: PairShape, const MEASURED: bool>(
        &self,
        lost: &[u32],
        law: &CutPotential<S>,
        position: &Planes,
        force: &mut Planes,
        measure: &mut Measure,
    ) -> Vec<u32> {
        let parts = lost
            .iter()
            .flat_map(|&number| self.beside(number))
            .map(|part| part as usize);
        let own = parts.filter(|&part| self.domain.is_mine(part));
        let groups: BTreeSet<usize> = own.map(|part| self.mesh.group_number(part)).collect();
        let tile = |group| sweep::tile(&self.mesh, &self.interfaces, group..group + 1);
        let tiles: Vec<Tile> = groups.into_iter().map(tile).collect();
        self.sum_tiles::<S, MEASURED>(&tiles, law, position, force, measure)
    }

    /// Sums of the parts of some tiles, which ascend; returns their interfaces that are no longer regular, ascending.
    fn sum_tiles<S: PairShape, const MEASURED: bool>(
        &self,
        tiles: &[Tile],
        law: &CutPotential<S>,
        position: &Planes,
        force: &mut Planes,
        measure: &mut Measure,
    ) -> Vec<u32> {
        let field = Field {
            law: *law,
            summation: self.summation,
            mesh: &self.mesh,
            classes: &self.classes,
            few: &self.few,
            intact: &self.intact,
            position,
        };
        let mut force = force.each_mut().map(|plane| &mut plane[..]);
        let mut held = measure.planes_mut().map(|plane| &mut plane[..]);
        let mut at = [0, 0];
        let mut tasks = Vec::with_capacity(tiles.len());
        for tile in tiles {
            for plane in &mut force {
                split_off(plane, tile.nodes.start - at[0]);
            }
            for plane in &mut held {
                split_off(plane, tile.elements.start - at[1]);
            }
            at = [tile.nodes.end, tile.elements.end];
            let force = force.each_mut().map(|plane| split_off(plane, tile.nodes.len()));
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
    fn have_only_drifted(&mut self, position: &Planes) -> bool {
        let Some(pairs) = &mut self.pairs else {
            return false;
        };
        let numbers = self.domain.ranks().merge(&pairs.motion(position).numbers());
        pairs.drift_with(Moments::from_numbers(&numbers).drift());
        if !pairs.is_current(position) {
            self.domain.call(Call::ListOutdated);
        }
        self.agree();
        !self.domain.hears(Call::ListOutdated)
    }

    /// Makes new lists of neighbours. Anything that has a side open may have come near, so all ranks learn where all of that is.
    fn search(&mut self, position: &mut Planes) -> Result<(), ForceError> {
        self.check_sound(position)?;
        let ready = in_order(self.domain.ranks().join(self.strained(position)));
        let not_firm = in_order([self.open_interfaces(), ready.clone()].concat());
        let sides = Sides::new(&self.interfaces, &not_firm);
        let start = Instant::now();
        self.share(&sides.parts, position);
        let shared = Instant::now();
        let lengths = Lengths::new(self.material.interaction.cutoff(), self.material.spacing);
        let scene = exposed::Scene {
            mesh: &self.mesh,
            interfaces: &self.interfaces,
            domain: &self.domain,
            position,
            not_firm: &not_firm,
            radius: lengths.radius,
        };
        let exposed = Exposed::new(&scene, sides);
        let pairs = Pairs::search(
            Scene {
                points: Points::new(&self.mesh, &exposed.sites, self.summation),
                watched: self.watched(&exposed.parts),
                parts: &exposed.parts,
                mesh: &self.mesh,
                ready,
                elements: self.domain.elements(),
                position,
                lengths,
            },
            |part, joined| self.joined(part, joined),
        );
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

    /// Refuses positions that are no numbers or far away.
    fn check_sound(&self, position: &Planes) -> Result<(), ForceError> {
        // Written so that a position that is not a number is refused.
        let is_near = |node: &usize| position.iter().all(|plane| plane[*node].abs() <= self.farthest);
        let mut own = self.domain.nodes().into_iter().flatten();
        let node = own.find(|node| !is_near(node)).map_or(u64::MAX, |node| node as u64);
        // All ranks tell the same error, that of the first node.
        match self.domain.ranks().least(node) {
            u64::MAX => Ok(()),
            node => Err(ForceError::FlewAway {
                element: self.mesh.element_of_node(node as usize),
            }),
        }
    }

    /// Brings the positions of some parts and of all atoms to all ranks.
    fn share(&self, parts: &[u32], position: &mut Planes) {
        let others = parts.iter().filter(|&&part| !self.domain.is_mine(part as usize));
        let others: Vec<u32> = others.copied().collect();
        let mut halo = Halo::ask(&self.domain, &self.mesh, &others);
        halo.bring(&self.domain, Of::Nodes, position.each_mut().map(Vec::as_mut_slice));
        position.iter_mut().for_each(|axis| self.domain.share_atoms(axis));
    }

    /// Intact interfaces of this rank that may open before the next search.
    fn strained(&self, position: &Planes) -> Vec<u32> {
        let longer = strained::LONG * self.material.spacing;
        let nearer = strained::NEAR * self.material.interaction.cutoff();
        let mine = self.domain.grouped();
        let runs: Vec<Run> = self
            .interfaces
            .runs
            .iter()
            .copied()
            .filter(|run| run.touches(&mine))
            .collect();
        let runs = runs.par_chunks(RUNS_IN_A_TASK);
        let found = runs.flat_map_iter(|runs| {
            self.arch.dispatch(Strained {
                mesh: &self.mesh,
                runs,
                intact: &self.intact,
                position,
                longer: longer * longer,
                nearer: nearer * nearer,
            })
        });
        found.collect()
    }

    /// Own nodes of these parts, and of all own atoms.
    fn watched(&self, parts: &[u32]) -> Vec<Range<usize>> {
        let own = parts
            .iter()
            .map(|&part| part as usize)
            .filter(|&part| self.domain.is_mine(part));
        let mut nodes: Vec<usize> = own.flat_map(|part| self.mesh.nodes_of(part)).collect();
        nodes.sort_unstable();
        let [_, atoms] = self.domain.nodes();
        pairs::ranges(nodes.into_iter().chain(atoms))
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
            // Whatever has no partner within the cutoff leaves no trace, not even the sign of a zero.
            if [x, y, z] == [0.0; 3] {
                continue;
            }
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

fn in_order(mut numbers: Vec<u32>) -> Vec<u32> {
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

fn split_off<'a>(plane: &mut &'a mut [f64], length: usize) -> &'a mut [f64] {
    let length = length.min(plane.len());
    let (part, rest) = std::mem::take(plane).split_at_mut(length);
    *plane = rest;
    part
}
