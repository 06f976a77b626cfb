//! Elements of a slab that become atoms while it moves.

use super::{Probes, Slab};
use crate::analysis::series::Setting;
use crate::forces::{Forces, Measure};
use crate::loading::Load;
use crate::mesh::Mesh;
use crate::mesh::element::Element;
use crate::solver::{Refine, Settings};
use crate::state::State;

/// Which triangles of a slab have become atoms.
pub struct Refinement {
    refine: Refine,
    settings: Settings,
    /// The mesh of the start, and atoms an edge of its elements along the crack plane.
    start: Mesh,
    element: u32,
    /// Pairs of its triangles that border on each other, and those at the cut.
    neighbours: Vec<[u32; 2]>,
    at_cut: Vec<u32>,
    /// Its triangles that have become atoms, ascending: with it they are the present mesh.
    refined: Vec<u32>,
    /// What they come to be in the next mesh.
    next: Vec<u32>,
    outruns: u64,
}

impl Refinement {
    /// Of forces on the mesh of the start. All ranks must make it together.
    pub fn new(refine: Refine, forces: &Forces, element: u32, settings: &Settings) -> Self {
        let neighbours = forces.neighbours();
        let severed = neighbours.iter().filter(|(_, is_severed)| *is_severed);
        Self {
            refine,
            settings: settings.clone(),
            start: forces.mesh().clone(),
            element,
            at_cut: severed.flat_map(|(both, _)| *both).collect(),
            neighbours: neighbours.into_iter().map(|(both, _)| both).collect(),
            refined: Vec::new(),
            next: Vec::new(),
            outruns: 0,
        }
    }

    /// Time between looks at the mesh, ps: in which the fastest wave crosses an element at the crack plane. No crack runs half as
    /// fast, so that one layer of elements ahead of it would do.
    pub fn looks_every(&self, setting: &Setting) -> f64 {
        f64::from(self.element) * setting.spacing / setting.longitudinal_speed
    }

    /// Triangles of the mesh of the start that have become atoms, ascending.
    pub fn refined(&self) -> &[u32] {
        &self.refined
    }

    pub fn restore_outruns(&mut self, outruns: u64) {
        self.outruns = outruns;
    }

    /// Adds to some triangles of the mesh of the start those that they border on, layer by layer.
    fn add_layers(&self, among: &mut [bool], layers: u32) {
        for _ in 0..layers {
            let inner = among.to_vec();
            for both in self
                .neighbours
                .iter()
                .map(|both| both.map(|triangle| triangle as usize))
            {
                if both.iter().any(|&triangle| inner[triangle]) {
                    both.into_iter().for_each(|triangle| among[triangle] = true);
                }
            }
        }
    }

    /// Of the mesh of the start the triangles that border on what has become atoms or on the cut.
    fn front(&self) -> Vec<bool> {
        let mut front = vec![false; self.start.triangles];
        let inner = self.refined.iter().chain(&self.at_cut);
        inner.for_each(|&triangle| front[triangle as usize] = true);
        self.add_layers(&mut front, 1);
        front
    }

    /// Which triangles of the mesh of the start are to be atoms where the present ones have these errors; `None` if no others
    /// than are.
    ///
    /// Atoms spread from the cut: a triangle with too large an error becomes atoms where it borders on it or on those that have,
    /// and one whose bonds are at their end wherever it is. The teeth of the faces, which no crack comes near, stay.
    fn wanted(&self, errors: &[f64]) -> Option<Vec<u32>> {
        let left = self.start.left_by(&self.refined);
        let front = self.front();
        let is_free = |triangle: usize| self.start.grip_of(&self.start.elements[triangle]) == 0;
        let mut wanted = vec![false; self.start.triangles];
        for (&number, &error) in left.iter().zip(errors) {
            let number = number as usize;
            let is_too_large = error > self.refine.error && (front[number] || error.is_infinite());
            wanted[number] = is_too_large && is_free(number);
        }
        if !wanted.contains(&true) {
            return None;
        }
        self.add_layers(&mut wanted, self.refine.ahead);
        self.refined
            .iter()
            .for_each(|&triangle| wanted[triangle as usize] = true);
        let numbers = (0..).zip(wanted);
        let wanted = numbers.filter(|&(number, is_wanted)| is_wanted && is_free(number));
        Some(wanted.map(|(number, _)| number as u32).collect())
    }

    /// Why these triangles and so many nodes are not those of this specimen.
    fn refuse_foreign(&self, refined: &[u32], nodes: usize) -> Result<(), &'static str> {
        let triangles = self.start.elements[..self.start.triangles].iter();
        let triangles: Vec<&Element> = triangles.collect();
        let mut expected = self.start.node_count();
        for &number in refined {
            let known = triangles.get(number as usize);
            let Some(triangle) = known.filter(|triangle| self.start.grip_of(triangle) == 0) else {
                return Err("it was refined where it has no elements for it");
            };
            expected += triangle.site_count() - triangle.node_count();
        }
        match refined.is_sorted_by(|a, b| a < b) && nodes == expected {
            true => Ok(()),
            false => Err("it has another number of nodes"),
        }
    }
}

impl Slab {
    /// How many interfaces between triangles have opened before these had become atoms.
    pub(super) fn outruns(&self) -> u64 {
        self.refinement.as_ref().map_or(0, |refinement| refinement.outruns)
    }

    /// Whether triangles between the grips carry too large an error, and what is to become atoms with them.
    pub(super) fn find_too_coarse(&mut self, state: &State) -> bool {
        let Some(refinement) = &mut self.refinement else {
            return false;
        };
        let errors = self.forces.strain_errors(&state.position);
        let Some(wanted) = refinement.wanted(&errors) else {
            return false;
        };
        refinement.outruns += self.forces.opened_interfaces() as u64;
        refinement.next = wanted;
        true
    }

    /// Goes over to the mesh that [`Self::find_too_coarse`] has found.
    pub(super) fn refine_further(&mut self, state: &mut State) {
        let Some(refinement) = &mut self.refinement else {
            return;
        };
        let domain = self.forces.domain();
        let planes = state.position.iter_mut().chain(&mut state.velocity);
        planes.for_each(|plane| domain.share_nodes(plane));
        refinement.refined = std::mem::take(&mut refinement.next);
        let mesh = refinement.start.refined(&refinement.refined);
        let site_mass = self.forces.material().site_mass;
        let consistent = refinement.settings.consistent_mass;
        let next = state.carried(self.forces.mesh(), &mesh, site_mass, consistent);
        self.go_over_to(mesh, next, state);
    }

    /// Goes over to the mesh in which these triangles of that of the start have become atoms. Where nodes are is not known then.
    pub(super) fn go_to_refined(
        &mut self,
        refined: &[u32],
        nodes: usize,
        state: &mut State,
    ) -> Result<(), &'static str> {
        let Some(refinement) = &mut self.refinement else {
            let is_same = refined.is_empty() && nodes == state.nodes();
            return is_same.then_some(()).ok_or("it has another number of nodes");
        };
        refinement.refuse_foreign(refined, nodes)?;
        if refinement.refined != refined {
            refinement.refined = refined.to_vec();
            let mesh = refinement.start.refined(refined);
            let site_mass = self.forces.material().site_mass;
            let next = State::of_mesh(&mesh, site_mass, refinement.settings.consistent_mass);
            self.go_over_to(mesh, next, state);
        }
        Ok(())
    }

    /// Takes another mesh and a state of free nodes on it. All that is known by number is made anew; what has been seen of the
    /// crack is known by lattice site and stays.
    fn go_over_to(&mut self, mesh: Mesh, next: State, state: &mut State) {
        let Some(refinement) = &self.refinement else {
            return;
        };
        *state = next;
        let ranks = self.forces.domain().ranks();
        self.loading.go_over_to(&mesh, ranks);
        self.loading.hold(state);
        self.setting.nodes = mesh.node_count() as u64;
        self.setting.elements = mesh.elements.len() as u64;
        let material = *self.forces.material();
        let (loading, setting) = (&self.loading, &self.setting);
        let probes = Probes::new(
            &mesh,
            material,
            loading,
            setting,
            refinement.element,
            &refinement.settings,
        );
        let before = std::mem::replace(&mut self.probes, probes);
        self.probes.broken = before.broken;
        self.probes.crack = before.crack;
        self.probes.watch = before.watch;
        self.forces.go_over_to(mesh);
        self.forces.look_at(self.loading.held().into_iter());
        let nothing = self.loading.nothing_booked();
        self.loading.belong_to(&self.forces.domain().nodes(), &nothing);
        self.measure = Measure::default();
        self.next = super::Next::default();
    }
}
