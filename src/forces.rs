//! Forces on the nodes as the exact gradient of one energy, the plain sum over site pairs within the cutoff.
//!
//! Every pair is summed in exactly one of three ways: inside a triangle by lattice vector (`bulk`), between triangles
//! whose interface is intact along its strings (`interface`), and everywhere else by a neighbour search (`contact`).
//! `referee` sums over all pairs without any of this.
//!
//! Every sum runs in an order fixed by the mesh, so that results do not depend on the number of threads or on when
//! neighbour lists were made.

mod affine;
mod bonds;
mod bulk;
mod contact;
mod interface;
mod maps;
mod measure;
pub mod referee;
mod regular;
mod stiffness;
mod summation;
mod tile;

pub use affine::{Affine, site_position};
pub use measure::Measure;
pub use summation::Summation;

use std::time::{Duration, Instant};

use crate::lattice::triangular;
use crate::material::Material;
use crate::mesh::Mesh;
use crate::mesh::interfaces::Interfaces;
use crate::potential::{CutPotential, PairShape, with_law};
use bulk::BulkBonds;
use contact::Contacts;
use contact::lattice::AtomLattice;
use interface::{IntactLimit, Pair, State};
use maps::Maps;
use measure::in_parts;
use pulp::Arch;
use rayon::prelude::*;
use summation::SampledStrings;
use tile::{Scratch, Tile};

/// Node positions or forces: x and y, one entry a node.
pub type Planes = [Vec<f64>; 2];

/// Elements in one parallel task. It sets no order of summation.
const CHUNK: usize = 128;

/// Why no forces can be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ForceError {
    #[error("element {element} flew away")]
    FlewAway { element: usize },
    #[error("element {element} turned inside out")]
    Inverted { element: usize },
}

impl ForceError {
    /// The element that went wrong.
    pub fn element(&self) -> usize {
        let (Self::FlewAway { element } | Self::Inverted { element }) = self;
        *element
    }
}

/// The force computation of one specimen: its mesh and material and what it remembers between steps.
pub struct Forces {
    mesh: Mesh,
    material: Material,
    summation: Summation,
    interfaces: Interfaces,
    strings: SampledStrings,
    bulk: BulkBonds,
    /// How the interfaces stand; a state is never left for a tighter one.
    states: Vec<State>,
    atoms: AtomLattice,
    contacts: Contacts,
    maps: Maps,
    tiles: Vec<Tile>,
    limit: IntactLimit,
    /// Interfaces that are not tight, ascending.
    loosened: Vec<u32>,
    /// Interfaces that are tested in every step.
    watched: Vec<u32>,
    /// No sound coordinate is larger, nm.
    farthest: f64,
    /// The instructions that the processor has.
    arch: Arch,
    searches: u64,
    search_time: Duration,
}

impl Forces {
    /// Bonds this much longer than the cutoff (in spacings) are listed with the strings, so that an intact interface
    /// stays intact under moderate strain.
    const LISTED_BEYOND_CUTOFF: f64 = 0.3;

    /// Largest coordinate over the largest of the specimen. No fragment flies so far in the time of a run; what blows
    /// up does so within a few steps, and would make the neighbour search compare all sites with all others.
    const FARTHEST: f64 = 100.0;

    /// Forces that sum every bond.
    pub fn new(mesh: Mesh, material: Material) -> Self {
        Self::with_summation(mesh, material, Summation::Exact)
    }

    pub fn with_summation(mesh: Mesh, material: Material, summation: Summation) -> Self {
        let cutoff = material.interaction.cutoff() / material.spacing;
        let listed = cutoff + Self::LISTED_BEYOND_CUTOFF;
        let interfaces = Interfaces::new(&mesh, listed);
        let state = |severed: bool| if severed { State::Open } else { State::Tight };
        let states = interfaces.pairs.iter().map(|pair| state(pair.severed)).collect();
        let bulk = BulkBonds::new(&mesh, listed, summation);
        let strings = SampledStrings::new(&interfaces, summation);
        let maps = Maps::new(&mesh);
        let tiles = tile::tiles(&mesh, &interfaces, &strings);
        let limit = IntactLimit::new(&material, triangular::next_length(listed));
        let atoms = AtomLattice::new(&mesh, listed, limit.regular);
        let reference = mesh.node_positions();
        let largest = reference
            .iter()
            .flatten()
            .fold(0.0, |most: f64, place| most.max(place.abs()));
        let mut forces = Self {
            mesh,
            material,
            summation,
            interfaces,
            strings,
            bulk,
            states,
            atoms,
            contacts: Contacts::default(),
            maps,
            tiles,
            limit,
            loosened: Vec::new(),
            watched: Vec::new(),
            farthest: Self::FARTHEST * largest,
            arch: Arch::new(),
            searches: 0,
            search_time: Duration::ZERO,
        };
        let severed = (0..).zip(&forces.interfaces.pairs).filter(|(_, pair)| pair.severed);
        let severed: Vec<u32> = severed.map(|(number, _)| number).collect();
        forces.watch(severed.into_iter());
        forces
    }

    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Numbers of the interfaces that have left the intact path, ascending: the only memory that a restart must keep.
    pub fn open_interfaces(&self) -> Vec<u32> {
        let loosened = self.loosened.iter().copied();
        loosened.filter(|&number| self.is_open(number as usize)).collect()
    }

    /// Puts back what [`Self::open_interfaces`] gave.
    pub fn restore_open_interfaces(&mut self, open: &[u32]) {
        self.states.fill(State::Tight);
        open.iter()
            .for_each(|&number| self.states[number as usize] = State::Open);
        self.loosened.clear();
        self.watch(open.iter().copied());
        self.atoms.calm();
        self.contacts.forget();
    }

    pub fn interface_count(&self) -> usize {
        self.states.len()
    }

    /// How often neighbours were searched, and for how many seconds.
    pub fn search_cost(&self) -> (u64, f64) {
        (self.searches, self.search_time.as_secs_f64())
    }

    #[inline(always)]
    fn is_open(&self, interface: usize) -> bool {
        self.states[interface] == State::Open
    }

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

    /// Finds out which interfaces must be tested in every step: those of triangles with an open interface. What follows from
    /// regular bonds ends where a crack begins.
    fn watch(&mut self, changed: impl Iterator<Item = u32>) {
        self.loosened.extend(changed);
        self.loosened.sort_unstable();
        self.loosened.dedup();
        let open = self
            .loosened
            .iter()
            .map(|&number| number as usize)
            .filter(|&number| self.is_open(number));
        let beside = open.flat_map(|number| {
            [
                self.interfaces.pairs[number].first,
                self.interfaces.pairs[number].second,
            ]
        });
        let of_those = beside
            .flat_map(|triangle| self.interfaces.of(triangle as usize))
            .copied();
        let mut watched: Vec<u32> = of_those.filter(|&number| !self.is_open(number as usize)).collect();
        watched.sort_unstable();
        watched.dedup();
        self.watched = watched;
    }

    fn prepare_contacts(&mut self, position: &Planes) -> Result<(), ForceError> {
        if self.contacts.are_current(position) {
            return Ok(());
        }
        self.check_sound(position)?;
        let field = contact::Field {
            mesh: &self.mesh,
            interfaces: &self.interfaces,
            states: &self.states,
            loosened: &self.loosened,
            summation: self.summation,
        };
        let start = Instant::now();
        self.contacts = Contacts::search(&field, &mut self.atoms, &self.material, position);
        self.searches += 1;
        self.search_time += start.elapsed();
        Ok(())
    }

    /// Refuses positions that are no numbers or far away, and triangles that are inside out.
    fn check_sound(&self, position: &Planes) -> Result<(), ForceError> {
        for (element, shape) in self.mesh.elements.iter().enumerate() {
            let first = self.mesh.first_node(element);
            // Written so that a position that is not a number is refused.
            let is_near = |node: usize| position.iter().all(|axis| axis[node].abs() <= self.farthest);
            if !(first..first + shape.node_count()).all(is_near) {
                return Err(ForceError::FlewAway { element });
            }
            if !shape.is_atom() {
                let affine = Affine::of_triangle(shape.size, first, position);
                if affine.determinant() <= 0.0 {
                    return Err(ForceError::Inverted { element });
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
