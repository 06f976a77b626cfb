//! Forces on the nodes of a solid as the exact gradient of one energy, the plain sum over site pairs within the cutoff.
//!
//! Every pair is summed in exactly one of three ways, as in two dimensions: inside a part by classes of equal bonds
//! (`inside`), between parts whose interface is intact by patches and strings (`faces`, `edges`), and everywhere else by a
//! neighbour search (`pairs`). [`referee`] sums over all pairs without any of this.
//!
//! Interfaces are used where the potential reaches nearest neighbours alone. One is intact as long as all of its bonds are
//! within the cutoff and no second neighbours across it are; then it opens for good. Those along a cut are open from the start,
//! and pairs that it severs only repel each other ([`CutPotential::repulsion`](crate::potential::CutPotential::repulsion)).

mod burden;
mod certified;
mod drift;
mod edges;
mod exposed;
mod extents;
mod faces;
mod frequency;
mod grid;
mod inside;
mod listed;
mod lists;
mod measure;
mod nodal;
mod pairs;
mod points;
pub mod referee;
mod rule;
mod scene;
mod strained;
mod sums;
mod sweep;
#[cfg(test)]
mod tests;
mod vector;

pub use burden::burdens;
pub use measure::Measure;

use std::collections::HashMap;
use std::sync::OnceLock;
use std::time::Duration;

use pulp::Arch;

use super::Summation;
use super::close::CloseBonds;
use crate::domain::{Domain, Halo, Ranks};
use crate::material::Material;
use crate::mesh::solid::Solid;
use crate::mesh::solid::element::Shape;
use crate::mesh::solid::interfaces::{Interfaces, SECOND_NEIGHBOURS};
use certified::Few;
use inside::Class;
use pairs::Pairs;
use sweep::Tile;

/// Node positions or forces: x, y and z, one entry a node.
pub type Planes = [Vec<f64>; 3];

/// Why no forces can be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ForceError {
    #[error("element {element} flew away")]
    FlewAway { element: usize },
}

/// Bonds this much longer than the cutoff (in spacings) are summed inside parts, and of long cutoffs between them, because they
/// come within it where parts are compressed.
const LISTED_BEYOND_CUTOFF: f64 = 0.3;

/// Largest coordinate over the largest of the specimen. No fragment flies so far in the time of a run.
const FARTHEST: f64 = 100.0;

/// What a part costs beside an atom.
const PART: f64 = 3.0;

/// The force computation of one solid: its mesh and material and what it remembers between steps.
pub struct Forces {
    mesh: Solid,
    domain: Domain,
    halo: Halo,
    /// Others' parts that border mine, ascending.
    bordering: Vec<u32>,
    material: Material,
    summation: Summation,
    interfaces: Interfaces,
    classes: HashMap<(Shape, i32), Vec<Class>>,
    /// Places that stand for all bonds of patches between parts of blocks of a size.
    few: HashMap<i32, Few>,
    /// One for each interface of this rank that is intact, zero for others. Untouched for those of other ranks.
    intact: Vec<f64>,
    /// Whether all interfaces are open from the start.
    starts_open: bool,
    /// Interfaces of all ranks that have opened, ascending.
    opened: Vec<u32>,
    tiles: Vec<Tile>,
    /// `None` before the first search and after an interface has opened that was not ready for it.
    pairs: Option<Pairs>,
    farthest: f64,
    /// Share of the consistent mass matrix; the rest of the masses is lumped.
    consistent_mass: f64,
    /// The squared highest frequency of the crystal at rest, 1/ps^2, once it has been asked for.
    frequency_at_rest: OnceLock<f64>,
    close_bonds: CloseBonds,
    arch: Arch,
    searches: u64,
    search_time: Duration,
    exchanges: u64,
    exchange_time: Duration,
}

impl Forces {
    pub fn new(mesh: Solid, material: Material) -> Self {
        Self::shared(Ranks::alone(), mesh, material, Summation::Exact)
    }

    /// The part of this rank in the forces that all ranks compute together.
    pub fn shared(ranks: Ranks, mesh: Solid, material: Material, summation: Summation) -> Self {
        let reach = material.interaction.cutoff() / material.spacing;
        let mut classes = HashMap::new();
        for group in mesh.groups() {
            let of_kind = || inside::classes(summation, group.shape, group.size, reach + LISTED_BEYOND_CUTOFF);
            classes.entry((group.shape, group.size)).or_insert_with(of_kind);
        }
        let mut sizes: Vec<i32> = classes.keys().map(|&(_, size)| size).collect();
        sizes.sort_unstable();
        sizes.dedup();
        sizes.retain(|_| summation != Summation::Nodal);
        let few = sizes
            .into_iter()
            .filter_map(|size| Some((size, Few::new(&material, summation, size - 2)?)));
        let starts_open = reach > SECOND_NEIGHBOURS;
        let largest = mesh.farthest().max(mesh.spacing);
        let parts = mesh.parts;
        let domain = Domain::new(ranks, &mesh, |element| if element < parts { PART } else { 1.0 });
        // Elements that are compressed bring pairs from beyond the cutoff; second neighbours are watched apart.
        let beyond = if starts_open { LISTED_BEYOND_CUTOFF } else { 0.0 };
        let interfaces = Interfaces::listed_for(&mesh, reach + beyond, domain.grouped());
        let bordering = bordering(&domain, &interfaces);
        Self {
            intact: intact(&interfaces, &domain, starts_open),
            starts_open,
            opened: interfaces.severed.clone(),
            tiles: sweep::tiles(&mesh, &interfaces, domain.grouped(), rayon::current_num_threads()),
            halo: Halo::ask(&domain, &mesh, &bordering),
            farthest: FARTHEST * largest,
            close_bonds: CloseBonds::new(&material),
            mesh,
            domain,
            bordering,
            material,
            summation,
            interfaces,
            few: few.collect(),
            classes,
            pairs: None,
            consistent_mass: 0.0,
            frequency_at_rest: OnceLock::new(),
            arch: Arch::new(),
            searches: 0,
            search_time: Duration::ZERO,
            exchanges: 0,
            exchange_time: Duration::ZERO,
        }
    }

    /// With this share of the consistent mass matrix; the rest of the masses is lumped. Frequencies depend on it.
    pub fn with_consistent_mass(self, consistent_mass: f64) -> Self {
        Self {
            consistent_mass,
            frequency_at_rest: OnceLock::new(),
            ..self
        }
    }

    pub fn mesh(&self) -> &Solid {
        &self.mesh
    }

    /// The mesh alone.
    pub fn into_mesh(self) -> Solid {
        self.mesh
    }

    pub fn material(&self) -> &Material {
        &self.material
    }

    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    pub fn domain_mut(&mut self) -> &mut Domain {
        &mut self.domain
    }

    /// Numbers of the interfaces that are no longer intact, ascending: the only memory that a restart must keep.
    pub fn open_interfaces(&self) -> Vec<u32> {
        match self.starts_open {
            true => (0..self.interface_count() as u32).collect(),
            false => self.opened.clone(),
        }
    }

    /// Puts back what [`Self::open_interfaces`] gave.
    pub fn restore_open_interfaces(&mut self, open: &[u32]) {
        if !self.starts_open {
            self.intact = intact(&self.interfaces, &self.domain, false);
            self.opened.clear();
            self.open(open);
        }
    }

    pub fn interface_count(&self) -> usize {
        self.interfaces.count()
    }

    /// What bonds closer than in a regular lattice do.
    pub fn close_bonds(&self) -> &CloseBonds {
        &self.close_bonds
    }

    pub fn close_bonds_mut(&mut self) -> &mut CloseBonds {
        &mut self.close_bonds
    }

    /// The parts on both sides of an interface.
    pub fn beside(&self, interface: u32) -> [u32; 2] {
        self.interfaces.pair(interface)
    }

    /// Parts that have a side along which atoms or parts of another size lie, ascending.
    pub fn beside_others(&self) -> Vec<u32> {
        self.interfaces.beside_others()
    }

    /// How often neighbours were searched, and for how many seconds.
    pub fn search_cost(&self) -> (u64, f64) {
        (self.searches, self.search_time.as_secs_f64())
    }

    /// How often ranks talked, and for how many seconds they waited for each other.
    pub fn exchange_cost(&self) -> (u64, f64) {
        (self.exchanges, self.exchange_time.as_secs_f64())
    }

    fn open(&mut self, interfaces: &[u32]) {
        interfaces.iter().for_each(|&number| self.intact[number as usize] = 0.0);
        self.opened.extend(interfaces);
        self.opened.sort_unstable();
        self.opened.dedup();
        let Some(mut pairs) = self.pairs.take_if(|pairs| pairs.are_ready(interfaces)) else {
            self.pairs = None;
            return;
        };
        let mut parts: Vec<u32> = interfaces.iter().flat_map(|&number| self.beside(number)).collect();
        parts.sort_unstable();
        parts.dedup();
        pairs.list_again(&parts, |part, joined| self.joined(part, joined));
        self.pairs = Some(pairs);
    }

    /// Replaces what it is given by the parts that intact interfaces join to a part.
    fn joined(&self, part: u32, joined: &mut Vec<u32>) {
        joined.clear();
        for &number in self.interfaces.of(part as usize) {
            if self.intact[number as usize] > 0.0 {
                joined.extend(self.beside(number).into_iter().filter(|&other| other != part));
            }
        }
    }
}

/// For each interface of a rank one where it is intact at the start.
fn intact(interfaces: &Interfaces, domain: &Domain, starts_open: bool) -> Vec<f64> {
    let mut intact = vec![0.0; interfaces.count()];
    let mine = domain.grouped();
    for run in interfaces.runs.iter().filter(|run| !starts_open && run.touches(&mine)) {
        intact[run.number..run.number + run.len].fill(1.0);
    }
    let severed = interfaces.severed.iter();
    severed.for_each(|&number| intact[number as usize] = 0.0);
    intact
}

/// Others' parts that have interfaces with mine, ascending.
fn bordering(domain: &Domain, interfaces: &Interfaces) -> Vec<u32> {
    let mine = domain.grouped();
    let is_mine = |part: &u32| mine.contains(&(*part as usize));
    let at_border = interfaces
        .runs
        .iter()
        .filter(|run| mine.contains(&run.first) != mine.contains(&run.second));
    let pairs = at_border.flat_map(|run| (run.number..run.number + run.len).map(|number| run.pair(number)));
    let mut others: Vec<u32> = pairs.flatten().filter(|part| !is_mine(part)).collect();
    others.sort_unstable();
    others.dedup();
    others
}
