//! One computation of the forces: what tiles, lists and ranks do after each other.

use std::time::{Duration, Instant};

use rayon::prelude::*;

use super::ahead::Motion;
use super::close::{self, Crowd};
use super::interface::{Pair, State};
use super::loosened::Loosened;
use super::measure::in_lengths;
use super::tile;
use super::{Affine, CHUNK, ForceError, Forces, Measure, Planes, contact};
use crate::domain::{Call, Halo, Of};
use crate::potential::{CutPotential, PairShape, with_law};

impl Forces {
    /// Forces on all nodes of this rank, eV/nm. Brings the positions that they depend on from other ranks.
    pub fn compute(&mut self, position: &mut Planes, force: &mut Planes) -> Result<(), ForceError> {
        self.sum::<false>(position, force, &mut Measure::default(), None)?;
        Ok(())
    }

    /// The same forces to the bit, and what every element holds.
    pub fn compute_and_measure(
        &mut self,
        position: &mut Planes,
        force: &mut Planes,
        measure: &mut Measure,
    ) -> Result<(), ForceError> {
        measure.fit(self.mesh.elements.len());
        self.sum::<true>(position, force, measure, None)?;
        Ok(())
    }

    /// Brings lists and states of interfaces up to date with the positions without giving forces.
    pub fn refresh(&mut self, position: &Planes) -> Result<(), ForceError> {
        let mut unused = position.each_ref().map(|axis| vec![0.0; axis.len()]);
        self.compute(&mut position.clone(), &mut unused)
    }

    pub(super) fn sum<const MEASURED: bool>(
        &mut self,
        position: &mut Planes,
        force: &mut Planes,
        measure: &mut Measure,
        motion: Option<&mut Motion>,
    ) -> Result<Vec<u32>, ForceError> {
        with_law!(self.material.interaction, law => {
            self.sum_with::<_, MEASURED>(&law, position, force, measure, motion)
        })
    }

    /// Sums, and sums again as often as any rank finds that interfaces are not what they were or that lists are out of
    /// date. Contacts are summed with the lists at hand before that is known, because it mostly turns out well. Returns the
    /// triangles with irregular bonds and those whose interfaces have changed.
    fn sum_with<S: PairShape, const MEASURED: bool>(
        &mut self,
        law: &CutPotential<S>,
        position: &mut Planes,
        force: &mut Planes,
        measure: &mut Measure,
        mut motion: Option<&mut Motion>,
    ) -> Result<Vec<u32>, ForceError> {
        let mut irregular = self.sum_all_tiles::<S, MEASURED>(law, position, force, measure, motion.as_deref_mut());
        let mut changed_beside = Vec::new();
        loop {
            let changed = self.changed_interfaces(&irregular, position);
            let mut disturbed = Vec::new();
            let mut crowd = Crowd::NONE;
            self.domain.hears_level();
            if !changed.is_empty() {
                self.domain.call(Call::InterfaceChanged);
            } else if !self.contacts.are_current(position) {
                self.domain.call(Call::ListOutdated);
            } else {
                let field = contact::SumField {
                    arch: self.arch,
                    law,
                    regular: self.limit.regular,
                    untouched: self.limit.untouched,
                    close: self.close_bonds.close,
                    mesh: &self.mesh,
                    domain: &self.domain,
                };
                let start = Instant::now();
                let atoms = motion
                    .as_deref_mut()
                    .map(|motion| motion.of_atoms(&self.looked_at_atoms));
                let found = self
                    .contacts
                    .sum::<S, MEASURED>(&field, position, force, measure, atoms);
                (disturbed, self.left_atoms) = (found.disturbed, found.left);
                crowd = found.crowd;
                self.domain.call_level(close::level(crowd.excess));
                self.spent[1] += start.elapsed().as_secs_f64();
                if !disturbed.is_empty() {
                    self.domain.call(Call::ListOutdated);
                }
            }
            self.agree();
            if self.domain.hears(Call::InterfaceChanged) {
                let (touched, beside) = self.change_interfaces(&changed);
                changed_beside.extend(beside);
                irregular.extend(self.sum_these_tiles::<S, MEASURED>(law, position, force, measure, &touched, None));
            } else if self.domain.hears(Call::ListOutdated) {
                let disturbed = self.domain.ranks().join(disturbed);
                disturbed.into_iter().for_each(|atom| self.atoms.disturb(atom as usize));
                self.search(position)?;
            } else {
                self.close_bonds.note(crowd, self.domain.hears_level());
                break;
            }
        }
        self.contacts.add_to(&self.mesh, &self.domain, force, measure);
        irregular.extend(changed_beside);
        Ok(irregular)
    }

    fn agree(&mut self) {
        let start = Instant::now();
        self.domain.agree();
        self.exchanges += 1;
        self.exchange_time += start.elapsed();
    }

    /// Sums of all triangles; those that need nothing of other ranks come first, while positions travel. Returns those whose
    /// interfaces may loosen or open.
    fn sum_all_tiles<S: PairShape, const MEASURED: bool>(
        &mut self,
        law: &CutPotential<S>,
        position: &mut Planes,
        force: &mut Planes,
        measure: &mut Measure,
        mut motion: Option<&mut Motion>,
    ) -> Vec<u32> {
        let inside: Vec<bool> = self.tiles.iter().map(|tile| !tile.is_at_border).collect();
        let at_border: Vec<bool> = inside.iter().map(|inside| !inside).collect();
        let mut halo = std::mem::take(&mut self.halo);
        let start = Instant::now();
        let mut computing = Duration::ZERO;
        let mut irregular = halo.exchange(&self.domain, position, |position| {
            let start = Instant::now();
            let irregular =
                self.sum_these_tiles::<S, MEASURED>(law, position, force, measure, &inside, motion.as_deref_mut());
            computing = start.elapsed();
            irregular
        });
        let arrived = Instant::now();
        self.exchange_time += arrived - start - computing;
        self.halo = halo;
        irregular.extend(self.sum_these_tiles::<S, MEASURED>(law, position, force, measure, &at_border, motion));
        self.spent[0] += (computing + arrived.elapsed()).as_secs_f64();
        irregular
    }

    /// Sums of the triangles of some tiles; returns those whose interfaces may loosen or open.
    fn sum_these_tiles<S: PairShape, const MEASURED: bool>(
        &self,
        law: &CutPotential<S>,
        position: &Planes,
        force: &mut Planes,
        measure: &mut Measure,
        these: &[bool],
        motion: Option<&mut Motion>,
    ) -> Vec<u32> {
        let field = tile::Field {
            arch: self.arch,
            law: *law,
            limit: &self.limit,
            mesh: &self.mesh,
            strings: &self.strings,
            bulk: &self.bulk,
            states: &self.states,
            position,
        };
        let mine = self.domain.grouped();
        let [nodes, _] = self.domain.nodes();
        let lengths = self.tiles.iter().map(|tile| tile.triangles.len());
        let of_nodes = lengths.clone().map(|triangles| 3 * triangles);
        let force = in_lengths(force.each_mut().map(|axis| &mut axis[nodes.clone()]), of_nodes.clone());
        let [held, _] = measure.split(self.mesh.triangles);
        let held = held.map(|plane| contact::part_of(plane, &mine));
        let outputs = force
            .zip(in_lengths(held, lengths))
            .map(|(force, held)| tile::Output { force, held });
        let mut ahead: Vec<Option<tile::Ahead>> = Vec::new();
        if let Some(motion) = motion {
            let (before, advance) = (motion.before, motion.advance);
            let [velocity, next] = [&mut *motion.velocity, &mut *motion.next].map(|planes| {
                let planes = planes.each_mut().map(|axis| &mut axis[nodes.clone()]);
                in_lengths(planes, of_nodes.clone())
            });
            let parts = velocity.zip(next).zip(&self.certain);
            ahead.extend(parts.map(|((velocity, next), certain)| {
                Some(tile::Ahead {
                    certain,
                    looked_at: &self.looked_at,
                    before,
                    velocity,
                    next,
                    advance,
                })
            }));
        }
        ahead.resize_with(self.tiles.len(), || None);
        let tiles = self.tiles.iter().zip(outputs).zip(ahead).zip(these);
        let tiles: Vec<_> = tiles.filter(|&(_, &asked)| asked).map(|(tile, _)| tile).collect();
        tiles
            .into_par_iter()
            .flat_map_iter(|((tile, output), ahead)| tile::sum::<S, MEASURED>(&field, tile, output, ahead))
            .collect()
    }

    /// Interfaces to be watched or of these triangles that are no longer what they were, and what they are.
    fn changed_interfaces(&self, irregular: &[u32], position: &Planes) -> Vec<(u32, State)> {
        let test = |&number: &u32| {
            let before = self.states[number as usize];
            if before == State::Open {
                return None;
            }
            let pair = Pair::new(&self.mesh, &self.interfaces, number as usize, position);
            let state = pair.state(&self.limit, pair.gap());
            (state > before).then_some((number, state))
        };
        let watched = self.watched.par_iter().with_min_len(CHUNK).filter_map(test);
        let irregular = irregular.par_iter().with_min_len(CHUNK);
        let of_irregular =
            irregular.flat_map_iter(|&triangle| self.interfaces.of(triangle as usize).iter().filter_map(test));
        watched.chain(of_irregular).collect()
    }

    /// Puts in force what any rank has found of interfaces; returns which of my tiles and of my triangles they touch.
    fn change_interfaces(&mut self, mine: &[(u32, State)]) -> (Vec<bool>, Vec<u32>) {
        let mine = mine
            .iter()
            .map(|&(place, state)| Loosened::at(&self.interfaces, place as usize, state));
        let changed = Loosened::of_all_ranks(&self.domain, &mine.collect::<Vec<_>>());
        let mut touched = vec![false; self.tiles.len()];
        let triangles = self.domain.grouped();
        let mut beside = Vec::new();
        for triangle in changed.iter().flat_map(|known| known.both) {
            if triangles.contains(&(triangle as usize)) {
                touched[tile::of_triangle(&self.tiles, triangle as usize)] = true;
                beside.push(triangle);
            }
        }
        self.watch(&changed);
        self.contacts.forget();
        (touched, beside)
    }

    /// Makes new lists of neighbours. Anything that is not as in the lattice may have come near, so all ranks learn where all of
    /// that is.
    fn search(&mut self, position: &mut Planes) -> Result<(), ForceError> {
        let start = Instant::now();
        let triangles = contact::searched(&self.interfaces, &self.loosened);
        self.share(&triangles, position);
        let shared = Instant::now();
        let field = contact::Field {
            mesh: &self.mesh,
            domain: &self.domain,
            interfaces: &self.interfaces,
            states: &self.states,
            summation: self.summation,
            unlisted: self.limit.unlisted,
        };
        self.check_sound(&triangles, position)?;
        self.contacts = contact::Contacts::search(&field, &triangles, &mut self.atoms, &self.material, position);
        let mut needed = [&self.bordering[..], self.contacts.needed()].concat();
        needed.sort_unstable();
        needed.dedup();
        self.halo = Halo::ask(&self.domain, &self.mesh, &needed);
        self.contacts.place_atoms(&self.domain, &self.halo);
        self.exchanges += 1;
        self.exchange_time += shared - start;
        self.searches += 1;
        self.search_time += shared.elapsed();
        Ok(())
    }

    /// Brings the positions of some triangles and of all atoms to all ranks.
    fn share(&self, triangles: &[u32], position: &mut Planes) {
        let mine = self.domain.grouped();
        let others = triangles
            .iter()
            .filter(|&&triangle| !mine.contains(&(triangle as usize)));
        let others: Vec<u32> = others.copied().collect();
        let mut halo = Halo::ask(&self.domain, &self.mesh, &others);
        halo.bring(&self.domain, Of::Nodes, position.each_mut().map(Vec::as_mut_slice));
        position.iter_mut().for_each(|axis| self.domain.share_atoms(axis));
    }

    /// Refuses positions that are no numbers or far away, and triangles that are inside out, among atoms and these triangles;
    /// what the others' interfaces stand for is as in the lattice.
    fn check_sound(&self, triangles: &[u32], position: &Planes) -> Result<(), ForceError> {
        let [mine, atoms] = self.domain.elements();
        let triangles = triangles.par_iter().map(|&triangle| triangle as usize);
        let mine = triangles.filter(|triangle| mine.contains(triangle));
        let error = mine
            .chain(atoms)
            .filter_map(|element| self.what_is_wrong_with(element, position))
            .find_first(|_| true);
        // All ranks tell the same error, that of the first element.
        let told = error.map_or(u64::MAX, |error| error.number());
        match self.domain.ranks().least(told) {
            u64::MAX => Ok(()),
            number => Err(ForceError::from_number(number)),
        }
    }

    fn what_is_wrong_with(&self, element: usize, position: &Planes) -> Option<ForceError> {
        let shape = &self.mesh.elements[element];
        // Written so that a position that is not a number is refused.
        let is_near = |node: usize| position.iter().all(|axis| axis[node].abs() <= self.farthest);
        if !self.mesh.nodes_of(element).all(is_near) {
            return Some(ForceError::FlewAway { element });
        }
        let is_sound = shape.is_atom() || Affine::of_triangle(&self.mesh, element, position).determinant() > 0.0;
        (!is_sound).then_some(ForceError::Inverted { element })
    }
}

impl ForceError {
    /// The first element that went wrong has the least number.
    fn number(&self) -> u64 {
        match self {
            Self::FlewAway { element } => 2 * *element as u64,
            Self::Inverted { element } => 2 * *element as u64 + 1,
        }
    }

    fn from_number(number: u64) -> Self {
        let element = (number / 2) as usize;
        match number % 2 {
            0 => Self::FlewAway { element },
            _ => Self::Inverted { element },
        }
    }
}
