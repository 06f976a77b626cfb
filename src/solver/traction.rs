//! The traction across the crack plane: the forces of the bonds that cross it, over the area that they cross.

use super::probe::ProfileLine;
use crate::analysis::series::Setting;
use crate::lattice::triangular;
use crate::material::Material;
use crate::mesh::Mesh;
use crate::state::State;

/// Reference bonds this much longer than the cutoff (in spacings) may come within it while the lattice is strained.
const BEYOND_CUTOFF: f64 = 0.3;

/// The reference bonds across the crack plane by the bins of the profile. Pairs that come together where the lattice has
/// slipped are not among them, so it holds where the lattice is whole: ahead of the tip.
#[derive(Clone, Debug, PartialEq)]
pub struct Traction {
    bins: usize,
    /// Length of a bin along the crack times the thickness, nm^2.
    area: f64,
    bonds: Vec<Bond>,
}

#[derive(Clone, Debug, PartialEq)]
struct Bond {
    bin: u32,
    below: Site,
    above: Site,
}

/// A site as its nodes carry it.
#[derive(Clone, Debug, PartialEq)]
struct Site {
    nodes: [u32; 3],
    shares: [f64; 3],
}

impl Traction {
    pub fn new(mesh: &Mesh, material: &Material, profile: &ProfileLine, setting: &Setting) -> Self {
        let bins = profile.centres().len();
        let width = setting.length / bins as f64;
        let middle = mesh.sites.middle_row();
        let plane = f64::from(middle) - 0.5;
        let reach = material.interaction.cutoff() / material.spacing + BEYOND_CUTOFF;
        let upward = triangular::half_vectors_within(reach)
            .into_iter()
            .filter(|vector| vector[1] > 0);
        let mut bonds = Vec::new();
        for vector in upward {
            for row in middle - vector[1]..middle {
                let share = (plane - f64::from(row)) / f64::from(vector[1]);
                for column in mesh.sites.columns(row) {
                    let [from, to] = [[column, row], [column + vector[0], row + vector[1]]];
                    let Some((below, above)) = site(mesh, from).zip(site(mesh, to)) else {
                        continue;
                    };
                    if mesh.severed(from, to) {
                        continue;
                    }
                    let [left, right] = [from, to].map(|site| mesh.reference(site)[0]);
                    let x = left + share * (right - left) - setting.left_x;
                    let bin = ((x / width).max(0.0) as usize).min(bins - 1) as u32;
                    bonds.push(Bond { bin, below, above });
                }
            }
        }
        Self {
            bins,
            area: width * setting.thickness,
            bonds,
        }
    }

    /// Force x, y with which what is above pulls at what is below, over the area, in every bin, eV/nm^3.
    pub fn read(&self, material: &Material, state: &State) -> Vec<[f64; 2]> {
        let mut sums = vec![[0.0; 2]; self.bins];
        for bond in &self.bonds {
            let vector = [0, 1].map(|axis| bond.above.place(state, axis) - bond.below.place(state, axis));
            let squared = vector[0] * vector[0] + vector[1] * vector[1];
            let slope = material.interaction.evaluate(squared).slope;
            let sum = &mut sums[bond.bin as usize];
            (0..2).for_each(|axis| sum[axis] += slope * vector[axis]);
        }
        sums.into_iter().map(|sum| sum.map(|force| force / self.area)).collect()
    }
}

fn site(mesh: &Mesh, site: [i32; 2]) -> Option<Site> {
    let owner = mesh.owner_of(site)?;
    let element = &mesh.elements[owner];
    let first = mesh.first_node(owner) as u32;
    let last = element.node_count() as u32 - 1;
    Some(Site {
        nodes: [0, 1, 2].map(|node| first + last.min(node)),
        shares: element.shape_functions(element.local(site)),
    })
}

impl Site {
    fn place(&self, state: &State, axis: usize) -> f64 {
        let carried = self.nodes.iter().zip(self.shares);
        carried.map(|(&node, share)| share * state.position[axis][node as usize]).sum()
    }
}
