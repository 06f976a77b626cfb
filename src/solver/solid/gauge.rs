//! Gauges: layers or patches of a solid whose mean velocity and stress every probe records.

use crate::domain::Domain;
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
    /// nm^3. Not numbers where there are no sites. All ranks must ask for it together.
    pub fn read(&self, domain: &Domain, state: &State<3>, measure: &Measure, site_volume: f64) -> [f64; 9] {
        let [x, y, z] = mean(domain, &self.shares, &state.velocity);
        let mut terms = vec![[0.0; 6]; self.elements.len()];
        let own = terms.iter_mut().zip(&self.elements);
        for (term, &(element, [count, all])) in own.filter(|(_, (element, _))| domain.is_mine(*element as usize)) {
            *term = measure.virial(element as usize).map(|virial| virial * count / all);
        }
        let all = domain.ranks().merge(terms.as_flattened());
        let mut sum = [0.0; 6];
        for term in all.as_chunks::<6>().0 {
            (0..6).for_each(|part| sum[part] += term[part]);
        }
        let sites: f64 = self.elements.iter().map(|(_, [count, _])| count).sum();
        let [xx, yy, zz, yz, xz, xy] = sum.map(|virial| virial / (sites * site_volume));
        [x, y, z, xx, yy, zz, yz, xz, xy]
    }
}
