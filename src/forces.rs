//! Forces on the nodes as the exact gradient of one energy, the plain sum over site pairs within the cutoff.
//!
//! Every pair is summed in exactly one of three ways: inside a triangle by lattice vector (`bulk`), between triangles
//! whose interface is intact along its strings (`interface`), and everywhere else by a neighbour search (`contact`).
//! `referee` sums over all pairs without any of this.
//!
//! Every sum runs in an order fixed by the numbers of elements, interfaces and sites, so that results do not depend
//! on the number of threads or on when neighbour lists were made.

mod affine;
mod assembly;
mod bonds;
mod bulk;
mod contact;
mod intact;
mod interface;
mod lanes;
mod maps;
mod measure;
pub mod referee;
mod stiffness;
mod summation;

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
use intact::IntactForces;
use interface::State;
use maps::Maps;
use summation::SampledStrings;

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
    contacts: Contacts,
    maps: Maps,
    intact: IntactForces,
    /// No sound coordinate is larger, nm.
    farthest: f64,
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
        let intact = IntactForces::new(&interfaces, &strings);
        let reference = mesh.node_positions();
        let largest = reference
            .iter()
            .flatten()
            .fold(0.0, |most: f64, place| most.max(place.abs()));
        Self {
            mesh,
            material,
            summation,
            interfaces,
            strings,
            bulk,
            states,
            contacts: Contacts::default(),
            maps,
            intact,
            farthest: Self::FARTHEST * largest,
            searches: 0,
            search_time: Duration::ZERO,
        }
    }

    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Length in spacings of the shortest bonds that strings and bulk do not list.
    fn unlisted_length(&self) -> f64 {
        let cutoff = self.material.interaction.cutoff() / self.material.spacing;
        triangular::next_length(cutoff + Self::LISTED_BEYOND_CUTOFF)
    }

    /// Numbers of the interfaces that have left the intact path, ascending: the only memory that a restart must keep.
    pub fn open_interfaces(&self) -> Vec<u32> {
        (0..self.states.len() as u32)
            .filter(|&number| self.is_open(number as usize))
            .collect()
    }

    /// Puts back what [`Self::open_interfaces`] gave.
    pub fn restore_open_interfaces(&mut self, open: &[u32]) {
        self.states.fill(State::Tight);
        open.iter()
            .for_each(|&number| self.states[number as usize] = State::Open);
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
        with_law!(self.material.interaction, law => {
            self.sum_interfaces(&law, position);
            self.prepare_contacts(position)?;
            self.contacts.sum(&law, &self.mesh, self.material.spacing, position);
            assembly::assemble(self, &law, position, force);
        });
        Ok(())
    }

    /// Brings lists and states of interfaces up to date with the positions without computing forces.
    pub fn refresh(&mut self, position: &Planes) -> Result<(), ForceError> {
        with_law!(self.material.interaction, law => self.sum_interfaces(&law, position));
        self.prepare_contacts(position)
    }

    /// Sums the strings of interfaces that are not open, and notes those that loosen or open.
    fn sum_interfaces<S: PairShape>(&mut self, law: &CutPotential<S>, position: &Planes) {
        self.maps.update(position);
        let [cutoff, spacing] = [law.cutoff(), self.material.spacing];
        let unlisted = self.unlisted_length();
        let changed = self.intact.sum(&intact::Field {
            law,
            limit: interface::IntactLimit {
                cutoff,
                unlisted,
                spacing,
                quick: interface::QuickTest::new(unlisted, cutoff, spacing),
            },
            mesh: &self.mesh,
            interfaces: &self.interfaces,
            strings: &self.strings,
            states: &self.states,
            maps: &self.maps,
            position,
        });
        if !changed.is_empty() {
            changed
                .into_iter()
                .for_each(|(number, state)| self.states[number] = state);
            self.contacts.forget();
        }
    }

    fn prepare_contacts(&mut self, position: &Planes) -> Result<(), ForceError> {
        if self.contacts.are_current(&self.mesh, position) {
            return Ok(());
        }
        self.check_sound(position)?;
        let field = contact::Field {
            mesh: &self.mesh,
            interfaces: &self.interfaces,
            states: &self.states,
            summation: self.summation,
        };
        let start = Instant::now();
        self.contacts = Contacts::search(&field, &self.material, position);
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
