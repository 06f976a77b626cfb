//! The state of a specimen in motion.

mod leap;
mod noise;
mod strip;

use std::array;
use std::ops::Range;

use crate::lanes;
use crate::mesh::Mesh;

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
    /// The triangles whose masses are coupled, ascending; empty where all masses are lumped.
    pub coupled: Vec<Coupled>,
    /// What a force is multiplied by to give the acceleration: the inverse of the mass, and zero where the motion is
    /// prescribed. With coupled masses the mean force of the triangle acts apart: see [`crate::integrator::kick`].
    pub mobility: [Vec<f64>; D],
}

/// Triangles side by side whose mass matrix is not lumped: the block of each is mass ((1 - 3 c) I + c 1 1^T), c the share.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupled {
    /// Nodes of all of them: first corners, second corners, third corners.
    pub nodes: Range<usize>,
    /// The mass that couples two nodes over the lumped mass of one.
    pub share: f64,
}

impl Coupled {
    /// How many triangles there are.
    pub fn len(&self) -> usize {
        self.nodes.len() / 3
    }

    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The three nodes of the triangle that has this one.
    fn beside(&self, node: usize) -> [usize; 3] {
        let first = self.nodes.start + (node - self.nodes.start) % self.len();
        [0, 1, 2].map(|corner| first + corner * self.len())
    }
}

impl<const D: usize> State<D> {
    /// Nodes at rest at these positions, free to move, with lumped masses.
    pub fn at_rest(position: [Vec<f64>; D], mass: Vec<f64>) -> Self {
        let nodes = mass.len();
        let free: Vec<f64> = mass.iter().map(|mass| 1.0 / mass).collect();
        let zeros = || array::from_fn(|_| vec![0.0; nodes]);
        Self {
            position,
            velocity: zeros(),
            force: zeros(),
            mass,
            coupled: Vec::new(),
            mobility: array::from_fn(|_| free.clone()),
        }
    }

    /// The mass that couples a node to another of its triangle, over the lumped mass of one; zero where it is lumped.
    pub fn coupling_of(&self, node: usize) -> f64 {
        coupled_at(&self.coupled, node).map_or(0.0, |coupled| coupled.share)
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

    /// The part of a node: with coupled masses c m (sum v)^2, which the nodes of a triangle share, is c m v (sum v) of each.
    #[inline(always)]
    pub fn kinetic_energy_of(&self, node: usize) -> f64 {
        let squared = match coupled_at(&self.coupled, node) {
            None => self.velocity.each_ref().map(|plane| plane[node] * plane[node]),
            Some(coupled) => self.velocity.each_ref().map(|plane| {
                let speed = plane[node];
                let sum: f64 = coupled.beside(node).into_iter().map(|node| plane[node]).sum();
                speed * (speed + coupled.share * (sum - 3.0 * speed))
            }),
        };
        0.5 * self.mass[node] * squared.into_iter().sum::<f64>()
    }
}

impl State {
    /// Gives the triangles of a mesh this share of the consistent mass matrix; the rest of it stays lumped. All nodes
    /// become free.
    pub fn couple_masses(&mut self, mesh: &Mesh, consistent: f64) {
        let groups = mesh.groups.all().iter().zip(mesh.mass_couplings());
        let coupled = groups.map(|(group, coupling)| Coupled {
            nodes: group.nodes(),
            share: consistent * coupling,
        });
        self.coupled = coupled.collect();
        for Coupled { nodes, share } in &self.coupled {
            for node in nodes.clone() {
                let mobility = 1.0 / (self.mass[node] * (1.0 - 3.0 * share));
                self.mobility.iter_mut().for_each(|plane| plane[node] = mobility);
            }
        }
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

/// How the nodes of a group of triangles answer to forces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertia {
    /// What a force along x and along y is multiplied by to give the acceleration, where it is the same for all.
    pub mobility: Option<[f64; 2]>,
    /// See [`State::coupling_of`].
    pub share: f64,
}

/// Of some triangles with coupled masses, ascending, those that a node belongs to.
fn coupled_at(coupled: &[Coupled], node: usize) -> Option<&Coupled> {
    let after = coupled.partition_point(|coupled| coupled.nodes.start <= node);
    let coupled = coupled.get(after.checked_sub(1)?)?;
    coupled.nodes.contains(&node).then_some(coupled)
}
