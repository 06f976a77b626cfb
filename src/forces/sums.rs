//! The sums that make the forces: tiles of triangles, then what is found by search or is an atom's.

use rayon::prelude::*;

use super::measure::in_parts;
use super::tile::{self, Scratch};
use super::{ForceError, Forces, Measure, Planes, contact};
use crate::potential::{CutPotential, PairShape, with_law};

impl Forces {
    /// Forces on all nodes, eV/nm.
    pub fn compute(&mut self, position: &Planes, force: &mut Planes) -> Result<(), ForceError> {
        self.sum::<false>(position, force, &mut Measure::default())
    }

    /// The same forces to the bit, and what every element holds.
    pub fn compute_and_measure(
        &mut self,
        position: &Planes,
        force: &mut Planes,
        measure: &mut Measure,
    ) -> Result<(), ForceError> {
        measure.fit(self.mesh.elements.len());
        self.sum::<true>(position, force, measure)
    }

    fn sum<const MEASURED: bool>(
        &mut self,
        position: &Planes,
        force: &mut Planes,
        measure: &mut Measure,
    ) -> Result<(), ForceError> {
        with_law!(self.material.interaction, law => {
            self.sum_tiles::<_, MEASURED>(&law, position, force, measure);
            self.sum_contacts::<_, MEASURED>(&law, position, force, measure)?;
        });
        self.contacts.add_to(&self.mesh, force, measure);
        Ok(())
    }

    /// Brings lists and states of interfaces up to date with the positions without giving forces.
    pub fn refresh(&mut self, position: &Planes) -> Result<(), ForceError> {
        let mut unused = position.each_ref().map(|axis| vec![0.0; axis.len()]);
        self.compute(position, &mut unused)
    }

    /// Sums what is found by search or is an atom's, as often as some atom turns out to be disturbed.
    fn sum_contacts<S: PairShape, const MEASURED: bool>(
        &mut self,
        law: &CutPotential<S>,
        position: &Planes,
        force: &mut Planes,
        measure: &mut Measure,
    ) -> Result<(), ForceError> {
        loop {
            self.prepare_contacts(position)?;
            let field = contact::SumField {
                arch: self.arch,
                law,
                regular: self.limit.regular,
                mesh: &self.mesh,
            };
            let disturbed = self.contacts.sum::<S, MEASURED>(&field, position, force, measure);
            if disturbed.is_empty() {
                return Ok(());
            }
            disturbed.into_iter().for_each(|atom| self.atoms.disturb(atom as usize));
            self.contacts.forget();
        }
    }

    /// Sums what happens inside triangles and between those whose interfaces are not open, and notes interfaces that
    /// loosen or open.
    fn sum_tiles<S: PairShape, const MEASURED: bool>(
        &mut self,
        law: &CutPotential<S>,
        position: &Planes,
        force: &mut Planes,
        measure: &mut Measure,
    ) {
        self.maps.update(position);
        let everywhere = vec![true; self.tiles.len()];
        let mut irregular = self.sum_these_tiles::<S, MEASURED>(law, position, force, measure, &everywhere);
        loop {
            let changed = self.changed_interfaces(&irregular, position);
            if changed.is_empty() {
                return;
            }
            let mut touched = vec![false; self.tiles.len()];
            let length = tile::tile_length(self.mesh.triangles);
            for &(number, state) in &changed {
                let pair = self.interfaces.pairs[number as usize];
                self.states[number as usize] = state;
                for triangle in [pair.first, pair.second] {
                    touched[triangle as usize / length] = true;
                }
            }
            self.watch(changed.into_iter().map(|(number, _)| number));
            self.contacts.forget();
            irregular.extend(self.sum_these_tiles::<S, MEASURED>(law, position, force, measure, &touched));
        }
    }

    /// Sums of the triangles of some tiles; returns those whose interfaces may loosen or open.
    fn sum_these_tiles<S: PairShape, const MEASURED: bool>(
        &self,
        law: &CutPotential<S>,
        position: &Planes,
        force: &mut Planes,
        measure: &mut Measure,
        these: &[bool],
    ) -> Vec<u32> {
        let field = tile::Field {
            arch: self.arch,
            law: *law,
            limit: &self.limit,
            mesh: &self.mesh,
            strings: &self.strings,
            bulk: &self.bulk,
            states: &self.states,
            maps: &self.maps,
            position,
        };
        let triangles = self.mesh.triangles;
        let [length, count] = [tile::tile_length(triangles), self.tiles.len()];
        let force = in_parts(
            force.each_mut().map(|axis| &mut axis[..3 * triangles]),
            3 * length,
            count,
        );
        let [held, _] = measure.split(triangles);
        let outputs = force.zip(in_parts(held, length, count));
        let tiles = self.tiles.iter().zip(outputs).zip(these).filter(|&(_, &asked)| asked);
        let tiles: Vec<_> = tiles.map(|(tile, _)| tile).collect();
        tiles
            .into_par_iter()
            .map_init(Scratch::default, |scratch, (tile, (force, held))| {
                tile::sum::<S, MEASURED>(&field, tile, scratch, tile::Output { force, held })
            })
            .flatten_iter()
            .collect()
    }
}
