//! Forces on the nodes as the exact gradient of one energy, the plain sum over site pairs within the cutoff.
//!
//! Every pair is summed in exactly one of three ways: inside a triangle by lattice vector (`bulk`), between triangles
//! whose interface is intact along its strings (`interface`), and everywhere else by a neighbour search (`contact`).
//! `referee` sums over all pairs without any of this.
//!
//! Every sum runs in an order fixed by the mesh, so that results do not depend on the number of ranks or threads or on
//! when neighbour lists were made.

mod affine;
mod ahead;
mod bonds;
mod bulk;
mod certified;
mod close;
mod contact;
mod interface;
mod kinds;
mod loosened;
mod maps;
mod measure;
pub mod referee;
mod refine;
mod regular;
mod rows;
mod share;
pub mod solid;
mod stiffness;
mod strings;
mod summation;
mod sums;
mod tile;
mod vector;

pub use affine::{Affine, site_position};
pub use ahead::{Left, Motion};
pub use contact::AtomMotion;
pub use measure::Measure;
pub use share::burdens;
pub use summation::Summation;

use std::ops::Range;
use std::time::{Duration, Instant};

use crate::domain::{Domain, Halo, Ranks};
use crate::lattice::triangular;
use crate::material::Material;
use crate::mesh::Mesh;
use crate::mesh::interfaces::{Interfaces, Kind, Survey, Told};
use bulk::BulkBonds;
use certified::Certificate;
use close::CloseBonds;
use contact::Contacts;
use contact::lattice::AtomLattice;
use interface::{IntactLimit, State};
use kinds::SampledStrings;
use loosened::Loosened;
use pulp::Arch;
use tile::Tile;

/// Node positions or forces: a plane an axis, one entry a node.
pub type Planes<const D: usize = 2> = [Vec<f64>; D];

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
    domain: Domain,
    halo: Halo,
    /// Others' elements that border mine in the lattice, ascending.
    bordering: Vec<u32>,
    material: Material,
    summation: Summation,
    interfaces: Interfaces,
    strings: SampledStrings,
    bulk: BulkBonds,
    /// How the interfaces of my triangles stand; a state is never left for a tighter one.
    states: Vec<State>,
    atoms: AtomLattice,
    contacts: Contacts,
    tiles: Vec<Tile>,
    limit: IntactLimit,
    close_bonds: CloseBonds,
    /// Interfaces of all ranks that are not tight, ascending.
    loosened: Vec<Loosened>,
    /// Places of the interfaces of my triangles that are tested in every step.
    watched: Vec<u32>,
    /// Triangles of each tile whose forces nothing but the tile can change, and all others of mine, ascending.
    certain: Vec<Vec<Range<usize>>>,
    uncertain: Vec<u32>,
    certain_is_current: bool,
    /// Groups of triangles whose forces are looked at in every step.
    looked_at: Vec<bool>,
    /// Nodes of atoms whose forces are, ascending.
    looked_at_atoms: Vec<Range<usize>>,
    /// Nodes of atoms that the last step has not moved on.
    left_atoms: Vec<Range<usize>>,
    /// No sound coordinate is larger, nm.
    farthest: f64,
    /// The instructions that the processor has.
    arch: Arch,
    first_cut: Duration,
    searches: u64,
    search_time: Duration,
    exchanges: u64,
    exchange_time: Duration,
    /// Seconds that tiles and contacts have taken since the ranks last compared, and those of all ranks then.
    spent: [f64; 2],
    spent_by_all: Vec<f64>,
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
        Self::shared(Ranks::alone(), mesh, material, summation)
    }

    /// The part of this rank in the forces that all ranks compute together.
    pub fn shared(ranks: Ranks, mesh: Mesh, material: Material, summation: Summation) -> Self {
        let listed = Self::listed(&material);
        let bulk = BulkBonds::new(&mesh, listed, summation);
        let limit = IntactLimit::new(&material, triangular::next_length(listed));
        let atoms = AtomLattice::new(&mesh, listed, limit.regular);
        let [rank, count] = [ranks.rank(), ranks.count()];
        // Before anybody knows who computes what, each looks at an equal share.
        let share = rank * mesh.triangles / count..(rank + 1) * mesh.triangles / count;
        let mut survey = Survey::new(&mesh, listed, share);
        let told = of_all_ranks(ranks, survey.tell());
        let start = Instant::now();
        let domain = Domain::new(ranks, &mesh, share::costs(&mesh, &told.exposed));
        let cut = start.elapsed();
        let interfaces = Interfaces::of_triangles(&mesh, survey, told, domain.grouped());
        let state = |severed: bool| if severed { State::Open } else { State::Tight };
        let states = interfaces.pairs.iter().map(|pair| state(pair.severed)).collect();
        let certificate = limit.untouched.map(|regular| Certificate {
            material: &material,
            regular,
        });
        let strings = SampledStrings::new(&interfaces, summation, certificate);
        let start = Instant::now();
        let bordering = share::bordering(&domain, &mesh, &interfaces, &atoms);
        let halo = Halo::ask(&domain, &mesh, &bordering);
        let first_cut = cut + start.elapsed();
        let tiles = tile::tiles(&mesh, &interfaces, &strings, domain.grouped());
        let largest = mesh.farthest();
        let mut forces = Self {
            mesh,
            halo,
            domain,
            bordering,
            material,
            summation,
            interfaces,
            strings,
            bulk,
            states,
            atoms,
            contacts: Contacts::default(),
            tiles,
            close_bonds: CloseBonds::new(&material),
            limit,
            loosened: Vec::new(),
            watched: Vec::new(),
            certain: Vec::new(),
            uncertain: Vec::new(),
            certain_is_current: false,
            looked_at: Vec::new(),
            looked_at_atoms: Vec::new(),
            left_atoms: Vec::new(),
            farthest: Self::FARTHEST * largest,
            arch: Arch::new(),
            first_cut,
            searches: 0,
            search_time: Duration::ZERO,
            exchanges: 0,
            exchange_time: Duration::ZERO,
            spent: [0.0; 2],
            spent_by_all: Vec::new(),
        };
        forces.look_at(std::iter::empty());
        let places = 0..forces.interfaces.pairs.len();
        forces.loosen(places.filter(|&place| forces.interfaces.pairs[place].severed).collect());
        forces
    }

    /// Longest bond in the perfect lattice that is listed with the strings, in spacings.
    fn listed(material: &Material) -> f64 {
        material.interaction.cutoff() / material.spacing + Self::LISTED_BEYOND_CUTOFF
    }

    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The mesh alone.
    pub fn into_mesh(self) -> Mesh {
        self.mesh
    }

    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Keeps the forces on these nodes up to date in every step, and on the others of their groups of triangles.
    pub fn look_at(&mut self, nodes: impl Iterator<Item = u32>) {
        self.looked_at.resize(self.mesh.groups.all().len(), false);
        let mut atoms = Vec::new();
        for node in nodes {
            let element = self.mesh.element_of_node(node as usize);
            match element < self.mesh.triangles {
                true => self.looked_at[self.mesh.groups.number_of(element)] = true,
                false => atoms.push(node as usize),
            }
        }
        atoms.sort_unstable();
        let ranges = atoms.chunk_by(|a, b| *b == a + 1);
        self.looked_at_atoms
            .extend(ranges.map(|range| range[0]..range[range.len() - 1] + 1));
    }

    /// Seconds that the first cut of the specimen took: who computes what, and who tells whom.
    pub fn first_cut(&self) -> f64 {
        self.first_cut.as_secs_f64()
    }

    /// How often neighbours were searched, and for how many seconds.
    pub fn search_cost(&self) -> (u64, f64) {
        (self.searches, self.search_time.as_secs_f64())
    }

    /// How often ranks talked, and for how many seconds they waited for each other.
    pub fn exchange_cost(&self) -> (u64, f64) {
        (self.exchanges, self.exchange_time.as_secs_f64())
    }

    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    pub fn domain_mut(&mut self) -> &mut Domain {
        &mut self.domain
    }

    #[inline(always)]
    fn is_open(&self, interface: usize) -> bool {
        self.states[interface] == State::Open
    }

    /// What bonds closer than in a regular lattice do.
    pub fn close_bonds(&self) -> &CloseBonds {
        &self.close_bonds
    }

    pub fn close_bonds_mut(&mut self) -> &mut CloseBonds {
        &mut self.close_bonds
    }
}

/// What the surveys of all ranks have told.
fn of_all_ranks(ranks: Ranks, told: Told) -> Told {
    if ranks.count() == 1 {
        return told;
    }
    let kinds = ranks.join(told.kinds.iter().flat_map(|kind| kind.0).collect());
    let (kinds, _) = kinds.as_chunks();
    let counts = ranks.merge(told.counts.as_flattened());
    let all = Told {
        exposed: ranks.join(told.exposed),
        counts: counts.as_chunks().0.to_vec(),
        kinds: Vec::new(),
    };
    all.with_kinds(kinds.iter().copied().map(Kind))
}

/// Adds numbers to ascending ones, which few of them mostly are not among.
fn include(ascending: &mut Vec<u32>, mut more: Vec<u32>) {
    more.sort_unstable();
    ascending.extend(more);
    // Takes two ascending runs as they are.
    ascending.sort();
    ascending.dedup();
}

#[cfg(test)]
mod tests;
