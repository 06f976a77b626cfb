//! The state of a specimen in motion.

mod carried;
mod leap;
mod noise;
mod strip;

use std::array;
use std::ops::Range;
use std::slice;

use crate::lanes;
use crate::mesh::Mesh;
use crate::mesh::grouped::{self, Grouped, MassCoupling};

pub use leap::Leap;
pub use noise::Noise;
pub use strip::Strip;

/// Positions, velocities, forces and masses of the nodes in `D` dimensions, a plane an axis. Units nm, ps, eV.
#[derive(Clone, Debug, PartialEq)]
pub struct State<const D: usize = 2> {
    pub position: [Vec<f64>; D],
    pub velocity: [Vec<f64>; D],
    pub force: [Vec<f64>; D],
    /// Lumped mass, the sum of a row of the mass matrix, eV ps^2/nm^2.
    pub mass: Vec<f64>,
    /// The elements whose masses are coupled, ascending; empty where all masses are lumped.
    pub coupled: Vec<Coupled>,
    /// What a force is multiplied by to give the acceleration: the inverse of the mass, and zero where the motion is
    /// prescribed. With coupled masses the mean force of the element acts apart: see [`crate::integrator::kick`].
    pub mobility: [Vec<f64>; D],
}

/// Elements side by side whose masses are coupled alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupled {
    /// Nodes of all of them: first corners, second corners, and so on.
    pub nodes: Range<usize>,
    pub coupling: MassCoupling,
}

impl Coupled {
    /// How many elements there are.
    pub fn len(&self) -> usize {
        self.nodes.len() / self.coupling.corners
    }

    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The nodes of the element that has this one, and the one opposite to it in the order of the nodes.
    fn beside(&self, node: usize) -> (impl Iterator<Item = usize> + use<>, usize) {
        let count = self.len();
        let [corner, place] = [(node - self.nodes.start) / count, (node - self.nodes.start) % count];
        let first = self.nodes.start + place;
        let all = (0..self.coupling.corners).map(move |corner| first + corner * count);
        (all, first + (corner ^ 1) * count)
    }
}

impl<const D: usize> State<D> {
    /// Nodes at rest at these positions, free to move, with lumped masses. Nodes without mass are those of other ranks: what is
    /// kept of them are untouched zeros, which take no memory.
    pub fn at_rest(position: [Vec<f64>; D], mass: Vec<f64>) -> Self {
        let nodes = mass.len();
        let zeros = || array::from_fn(|_| vec![0.0; nodes]);
        let free = || {
            let mut free = vec![0.0; nodes];
            let own = mass.iter().zip(&mut free).filter(|(mass, _)| **mass > 0.0);
            own.for_each(|(mass, free)| *free = 1.0 / mass);
            free
        };
        let mobility = array::from_fn(|_| free());
        Self {
            position,
            velocity: zeros(),
            force: zeros(),
            mass,
            coupled: Vec::new(),
            mobility,
        }
    }

    /// Whether a node is there from the start, and not on another rank.
    #[inline(always)]
    pub fn has(&self, node: usize) -> bool {
        self.mass[node] > 0.0
    }

    /// Gives the elements of a mesh this share of the consistent mass matrix; the rest of it stays lumped. All nodes that are
    /// there become free.
    pub fn couple_masses(&mut self, mesh: &impl Grouped, consistent: f64) {
        let groups = mesh.mass_couplings().into_iter().enumerate();
        let coupled = groups.map(|(number, coupling)| Coupled {
            nodes: mesh.group(number)[1].clone(),
            coupling: coupling.times(consistent),
        });
        self.coupled = coupled.collect();
        for Coupled { nodes, coupling } in &self.coupled {
            let answer = coupling.answer();
            if self.mass[nodes.start] == 0.0 {
                continue;
            }
            for node in nodes.clone() {
                let mobility = 1.0 / (self.mass[node] * answer.mass);
                self.mobility.iter_mut().for_each(|plane| plane[node] = mobility);
            }
        }
    }

    /// The least part of its lumped mass that a node moves with; 1 where all masses are lumped.
    pub fn least_share_of_mass(&self) -> f64 {
        let shares = self.coupled.iter().map(|coupled| coupled.coupling.least());
        shares.fold(1.0, f64::min)
    }

    /// The mass that couples a node to another of its element, over the lumped mass of one; zero where it is lumped.
    pub fn coupling_of(&self, node: usize) -> f64 {
        coupled_at(&self.coupled, node).map_or(0.0, |coupled| coupled.coupling.share)
    }

    pub fn nodes(&self) -> usize {
        self.mass.len()
    }

    /// All nodes, as one range.
    pub fn every_node(&self) -> [Range<usize>; 1] {
        std::array::from_fn(|_| 0..self.nodes())
    }

    /// Kinetic energy, v^T M v/2, eV.
    pub fn kinetic_energy(&self) -> f64 {
        let [energy] = lanes::sums(self.nodes(), |node| [self.kinetic_energy_of(node)]);
        energy
    }

    /// The part of a node: with coupled masses each of an element has its velocity times its share of the momentum.
    #[inline(always)]
    pub fn kinetic_energy_of(&self, node: usize) -> f64 {
        let squared = match coupled_at(&self.coupled, node) {
            None => self.velocity.each_ref().map(|plane| plane[node] * plane[node]),
            Some(coupled) => self.velocity.each_ref().map(|plane| {
                let MassCoupling {
                    corners,
                    share,
                    opposite,
                } = coupled.coupling;
                let speed = plane[node];
                let (beside, other) = coupled.beside(node);
                let sum: f64 = beside.map(|node| plane[node]).sum();
                let mut momentum = speed + share * (sum - corners as f64 * speed);
                if opposite != 0.0 {
                    momentum += opposite * (plane[other] - speed);
                }
                speed * momentum
            }),
        };
        0.5 * self.mass[node] * squared.into_iter().sum::<f64>()
    }
}

impl State {
    /// The nodes of a mesh at rest in the perfect lattice, with the masses of their sites (eV ps^2/nm^2 each), of which those of
    /// triangles have a share of the consistent mass matrix.
    pub fn of_mesh(mesh: &Mesh, site_mass: f64, consistent: f64) -> Self {
        Self::of_elements(mesh, slice::from_ref(&(0..mesh.elements.len())), site_mass, consistent)
    }

    /// The same of some ranges of elements, which start and end with groups or are atoms.
    pub fn of_elements(mesh: &Mesh, elements: &[Range<usize>], site_mass: f64, consistent: f64) -> Self {
        let masses = grouped::masses_of(mesh, elements);
        let mut state = Self::at_rest(mesh.node_positions_of(elements), times(masses, site_mass));
        if consistent > 0.0 {
            state.couple_masses(mesh, consistent);
        }
        state
    }

    /// How the nodes of each group of a mesh answer to forces.
    pub fn inertias(&self, mesh: &Mesh) -> Vec<Inertia> {
        let of_group = |nodes: Range<usize>| {
            let same = |plane: &Vec<f64>| {
                plane[nodes.clone()]
                    .iter()
                    .all(|mobility| *mobility == plane[nodes.start])
            };
            let is_same = self.mobility.iter().all(same);
            Inertia {
                mobility: is_same.then(|| self.mobility.each_ref().map(|plane| plane[nodes.start])),
                share: self.coupling_of(nodes.start),
            }
        };
        mesh.groups.all().iter().map(|group| of_group(group.nodes())).collect()
    }
}

/// Masses in another unit. Those of nodes of other ranks stay untouched.
pub fn times(mut masses: Vec<f64>, unit: f64) -> Vec<f64> {
    masses
        .iter_mut()
        .filter(|mass| **mass > 0.0)
        .for_each(|mass| *mass *= unit);
    masses
}

/// How the nodes of a group of triangles answer to forces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertia {
    /// What a force along x and along y is multiplied by to give the acceleration, where it is the same for all.
    pub mobility: Option<[f64; 2]>,
    /// See [`State::coupling_of`].
    pub share: f64,
}

/// Of some elements with coupled masses, ascending, those that a node belongs to.
fn coupled_at(coupled: &[Coupled], node: usize) -> Option<&Coupled> {
    let after = coupled.partition_point(|coupled| coupled.nodes.start <= node);
    let coupled = coupled.get(after.checked_sub(1)?)?;
    coupled.nodes.contains(&node).then_some(coupled)
}
