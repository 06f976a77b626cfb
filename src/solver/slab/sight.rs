//! What the first rank reads in a probe of elements that others compute.

use super::Slab;
use super::gauges::Gauges;
use super::j_integral::Rings;
use super::probe::ProfileLine;
use super::traction::Traction;
use crate::domain::{Halo, Of};
use crate::loading::{Load, SlabLoad};
use crate::mesh::Mesh;
use crate::state::State;

/// Elements that every probe reads, ascending; those around the tip of a crack come on top.
#[derive(Clone, Debug, PartialEq)]
pub struct Sight(Vec<u32>);

impl Sight {
    pub fn new(mesh: &Mesh, loading: &SlabLoad, profile: &ProfileLine, traction: &Traction, gauges: &Gauges) -> Self {
        let nodes = traction.nodes().chain(loading.held());
        let of_nodes = nodes.map(|node| mesh.element_of_node(node as usize) as u32);
        let elements = profile.elements().chain(gauges.elements());
        let mut seen: Vec<u32> = of_nodes.chain(elements).collect();
        seen.sort_unstable();
        seen.dedup();
        Self(seen)
    }

    pub fn add(&mut self, elements: impl Iterator<Item = u32>) {
        self.0.extend(elements);
        self.0.sort_unstable();
        self.0.dedup();
    }
}

impl Slab {
    /// Brings to the first rank what it reads of others in a probe: the whole state would take longer than some steps.
    pub(super) fn bring_into_sight(&mut self, state: &mut State, rings: Option<Rings>) {
        let domain = self.forces.domain();
        if domain.ranks().count() == 1 {
            return;
        }
        let mut seen = Vec::new();
        if domain.ranks().is_first() {
            let integral = self.probes.j_integral.as_ref();
            let around_tip = rings.zip(integral);
            let around_tip = around_tip.map(|(rings, integral)| integral.elements_read(self.forces.mesh(), &rings));
            seen = [&self.probes.sight.0, &around_tip.unwrap_or_default()[..]].concat();
            seen.retain(|&element| !domain.is_mine(element as usize));
            seen.sort_unstable();
            seen.dedup();
        }
        let mut parcels = Halo::ask(domain, self.forces.mesh(), &seen);
        let State {
            position,
            velocity,
            force,
            mass,
            ..
        } = &mut *state;
        let [[x, y], [velocity_x, velocity_y], [force_x, force_y]] =
            [position, velocity, force].map(|planes| planes.each_mut().map(Vec::as_mut_slice));
        let planes = [x, y, velocity_x, velocity_y, force_x, force_y, mass];
        parcels.bring(domain, Of::Nodes, planes);
        self.measure.bring(&mut parcels, domain);
        // The thermometer reads all atoms.
        let velocities = state.velocity.iter_mut();
        velocities.for_each(|plane| domain.gather_atoms(plane));
    }
}
