//! How many elements of each size a specimen has.

use std::hash::{DefaultHasher, Hash, Hasher};

use super::leftovers::Leftovers;
use crate::lattice::triangular;
use crate::mesh::region::Shape;
use crate::mesh::{Mesh, Plan};

/// Elements by size, and what they amount to.
#[derive(Clone, Debug, PartialEq)]
pub struct Census {
    /// Size (1: atom) and number, by falling size.
    pub elements: Vec<(i32, f64)>,
    pub sites: u64,
    /// Sites in elements smaller than asked for; `None` where nobody has laid the elements.
    pub leftovers: Option<Leftovers>,
    /// Tells meshes apart.
    pub fingerprint: u64,
}

/// Specimens with more sites than this are not meshed to be counted.
pub const MESHED: u64 = 30_000_000;

/// What a process takes that computes hardly anything, and what an atom and a triangle add to it. Fitted to the peaks of
/// models A to E of Deng (2011), 99 to 257 MB, and of 1.8 million atoms, 397 MB.
const BYTES_A_PROCESS: u64 = 20_000_000;
const BYTES_AN_ATOM: f64 = 200.0;
const BYTES_A_TRIANGLE: f64 = 1250.0;

/// What of it every rank holds: of all triangles where they lie, of all atoms also who their partners are and where they were
/// last searched.
const BYTES_A_TRIANGLE_EVERYWHERE: f64 = 40.0;
const BYTES_AN_ATOM_EVERYWHERE: f64 = 80.0;

impl Census {
    /// The first of the sizes asked for that no element has.
    pub fn absent(&self, plan: &Plan) -> Option<i32> {
        let regions = plan.regions.iter().map(|region| region.element);
        let mut wanted = [plan.element].into_iter().chain(regions).map(i32::from);
        wanted.find(|&size| self.elements.iter().all(|element| element.0 != size))
    }

    /// Counts the elements of a mesh.
    pub fn counted(plan: &Plan, mesh: &Mesh) -> Self {
        let mut elements: Vec<(i32, f64)> = Vec::new();
        for element in &mesh.elements {
            match elements.last_mut() {
                Some((size, number)) if *size == element.size => *number += 1.0,
                _ => elements.push((element.size, 1.0)),
            }
        }
        Self {
            elements,
            sites: mesh.sites.len() as u64,
            leftovers: Some(Leftovers::of(plan, mesh)),
            fingerprint: fingerprint(&mesh.elements),
        }
    }

    /// From areas alone; the finest regions count first, and what they leave is for the coarser ones.
    pub fn by_area(plan: &Plan) -> Self {
        let spacing = plan.spacing;
        let length = plan.layout.length() * spacing;
        let height = f64::from(plan.layout.lattice_rows()) * triangular::ROW_HEIGHT * spacing;
        let mut regions: Vec<_> = plan.regions.iter().collect();
        regions.sort_by_key(|region| region.element);
        let mut rest = 1.0;
        let mut elements = Vec::new();
        let sites = plan.layout.site_count();
        let mut add = |size: u16, share: f64| {
            let held = f64::from(size) * (f64::from(size) + 1.0) / 2.0;
            elements.push((i32::from(size), share * sites as f64 / held));
        };
        for region in regions {
            let area = match region.shape {
                Shape::Band { half_width } => length * (2.0 * half_width).min(height),
                Shape::Box { from, to } => (to[0] - from[0]).min(length) * (to[1] - from[1]).min(height),
                Shape::Disc { radius, .. } => std::f64::consts::PI * radius * radius,
            };
            let share = (area / (length * height)).clamp(0.0, rest);
            rest -= share;
            add(region.element, share);
        }
        add(plan.element, rest);
        elements.sort_by_key(|&(size, _)| -size);
        Self {
            elements,
            sites,
            leftovers: None,
            fingerprint: fingerprint(format!("{:?} {:?}", plan.element, plan.regions)),
        }
    }

    /// The same with so many sites of its triangles as atoms.
    pub fn with_atoms(&self, atoms: f64) -> Self {
        let held = |size: i32| f64::from(size * (size + 1) / 2);
        let in_triangles = self.weigh(|size| if size == 1 { 0.0 } else { held(size) });
        let share = (atoms / in_triangles.max(1.0)).min(1.0);
        let of_atoms = self.weigh(|size| f64::from(u8::from(size == 1))) + share * in_triangles;
        let triangles = self.elements.iter().filter(|(size, _)| *size > 1);
        let left = triangles.map(|&(size, number)| (size, (1.0 - share) * number));
        Self {
            elements: left.chain([(1, of_atoms)]).collect(),
            ..self.clone()
        }
    }

    pub fn element_count(&self) -> u64 {
        self.sum(|_| 1.0)
    }

    pub fn node_count(&self) -> u64 {
        self.sum(|size| if size == 1 { 1.0 } else { 3.0 })
    }

    /// Elements that are single atoms.
    pub fn atoms_alone(&self) -> u64 {
        self.sum(|size| if size == 1 { 1.0 } else { 0.0 })
    }

    /// Bytes that so many ranks of a solver take together at most, while a crack runs and a picture is written.
    pub fn memory(&self, ranks: u32) -> u64 {
        let kept = self.sum(|size| if size == 1 { BYTES_AN_ATOM } else { BYTES_A_TRIANGLE });
        let by_each = self.sum(|size| {
            if size == 1 {
                BYTES_AN_ATOM_EVERYWHERE
            } else {
                BYTES_A_TRIANGLE_EVERYWHERE
            }
        });
        let ranks = u64::from(ranks);
        let others = ranks.saturating_sub(1).saturating_mul(by_each);
        ranks
            .saturating_mul(BYTES_A_PROCESS)
            .saturating_add(kept)
            .saturating_add(others)
    }

    /// Sum over all elements of a number for each size.
    pub fn sum(&self, each: impl Fn(i32) -> f64) -> u64 {
        self.weigh(each).round() as u64
    }

    pub fn weigh(&self, each: impl Fn(i32) -> f64) -> f64 {
        self.elements.iter().map(|&(size, number)| number * each(size)).sum()
    }
}

fn fingerprint(of: impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    of.hash(&mut hasher);
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::region::Region;
    use crate::mesh::sites::Layout;

    #[test]
    fn areas_tell_the_counts_of_a_mesh_within_a_tenth() {
        // The border of a band runs along elements, so that a band is up to an element row wider than asked for.
        let layout = Layout {
            block: 10,
            rows: 40,
            triangles: 101,
        };
        let band = Region {
            shape: Shape::Band { half_width: 17.0 },
            element: 1,
        };
        let plan = Plan {
            layout,
            element: 10,
            regions: vec![band],
            crack: None,
            grip_rows: 10,
            spacing: 0.25,
        };
        let [counted, by_area] = [Census::counted(&plan, &Mesh::new(&plan)), Census::by_area(&plan)];
        assert_eq!(counted.sites, by_area.sites);
        let ratio = by_area.node_count() as f64 / counted.node_count() as f64;
        assert!((0.9..1.1).contains(&ratio), "{ratio}");
    }
}
