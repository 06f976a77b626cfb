//! Gauges: layers or patches of a solid whose mean velocity and stress every probe records.

use crate::forces::solid::Measure;
use crate::loading::{Carried, mean};
use crate::mesh::solid::Solid;
use crate::state::State;

/// Some sites of a solid.
#[derive(Clone, Debug, PartialEq)]
pub struct Gauge {
    /// What its columns are called by.
    pub name: String,
    /// Nodes and how many of the sites each stands for.
    shares: Vec<(u32, f64)>,
    /// Elements, how many of the sites each has, and how many in all.
    elements: Vec<(u32, [f64; 2])>,
}

impl Gauge {
    /// A gauge of the sites that are wanted.
    pub fn new(name: String, mesh: &Solid, is_wanted: impl Fn([i32; 3]) -> bool) -> Self {
        let (elements, sites) = Carried::of_solid(mesh, is_wanted);
        let counts = sites.elements().iter().map(|sites| sites.len() as f64);
        let elements = elements.into_iter().zip(counts);
        Self {
            name,
            shares: sites.shares(),
            elements: elements
                .map(|(element, count)| {
                    let all = mesh.elements[element as usize].site_count() as f64;
                    (element, [count, all])
                })
                .collect(),
        }
    }

    /// Mean velocity x, y, z, nm/ps, and virial stress xx, yy, zz, yz, xz, xy, eV/nm^3, with this reference volume of a site,
    /// nm^3. Not numbers where there are no sites.
    pub fn read(&self, state: &State<3>, measure: &Measure, site_volume: f64) -> [f64; 9] {
        let velocity = mean(&self.shares, &state.velocity);
        let (mut stress, mut sites) = ([0.0; 6], 0.0);
        for &(element, [count, all]) in &self.elements {
            let virial = measure.virial(element as usize);
            (0..6).for_each(|part| stress[part] += virial[part] * count / all);
            sites += count;
        }
        let [x, y, z] = velocity;
        let [xx, yy, zz, yz, xz, xy] = stress.map(|virial| virial / (sites * site_volume));
        [x, y, z, xx, yy, zz, yz, xz, xy]
    }
}
