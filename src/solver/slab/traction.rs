//! The traction across the crack plane: the forces of the bonds that cross it, over the area that they cross.

use super::probe::ProfileLine;
use crate::analysis::series::Setting;
use crate::lattice::triangular;
use crate::material::Material;
use crate::mesh::Mesh;
use crate::state::State;

/// Reference bonds this much longer than the cutoff (in spacings) may come within it while the lattice is strained.
const BEYOND_CUTOFF: f64 = 0.3;

/// The reference bonds across the crack plane by the bins of the profile. Bonds of one kind cross it a spacing apart, so each
/// stands for a spacing of its length, and counts in every bin with its share of that. Pairs that come together where the lattice has
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
    /// Bins, and the share of the bond in each.
    bins: [(u32, f64); 2],
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
        let bins = profile.bins();
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
                    let bins = bins.spread(x, mesh.spacing);
                    bonds.push(Bond { bins, below, above });
                }
            }
        }
        Self {
            bins: bins.count,
            area: bins.width * setting.thickness,
            bonds,
        }
    }

    /// Nodes that carry the sites of the bonds.
    pub fn nodes(&self) -> impl Iterator<Item = u32> {
        let sites = self.bonds.iter().flat_map(|bond| [&bond.below, &bond.above]);
        sites.flat_map(|site| site.nodes)
    }

    /// Force x, y with which what is above pulls at what is below, over the area, in every bin, eV/nm^3.
    pub fn read(&self, material: &Material, state: &State) -> Vec<[f64; 2]> {
        let mut sums = vec![[0.0; 2]; self.bins];
        for bond in &self.bonds {
            let vector = [0, 1].map(|axis| bond.above.place(state, axis) - bond.below.place(state, axis));
            let squared = vector[0] * vector[0] + vector[1] * vector[1];
            let slope = material.interaction.evaluate(squared).slope;
            for (bin, share) in bond.bins {
                (0..2).for_each(|axis| sums[bin as usize][axis] += share * slope * vector[axis]);
            }
        }
        sums.into_iter().map(|sum| sum.map(|force| force / self.area)).collect()
    }
}

fn site(mesh: &Mesh, site: [i32; 2]) -> Option<Site> {
    let owner = mesh.owner_of(site)?;
    let element = &mesh.elements[owner];
    let last = element.node_count() - 1;
    Some(Site {
        nodes: [0, 1, 2].map(|corner| mesh.node(owner, last.min(corner)) as u32),
        shares: element.shape_functions(element.local(site)),
    })
}

impl Site {
    fn place(&self, state: &State, axis: usize) -> f64 {
        let carried = self.nodes.iter().zip(self.shares);
        carried
            .map(|(&node, share)| share * state.position[axis][node as usize])
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::super::setting::setting;
    use super::*;
    use crate::forces::Forces;
    use crate::mesh::Plan;
    use crate::mesh::region::{Region, Shape};
    use crate::mesh::sites::Layout;
    use crate::potential::{AtCutoff, CutPotential, Interaction, LennardJones};

    /// Rounding of sums of some hundred bonds.
    const ROUNDING: f64 = 1e-9;

    /// Elements an edge, and the half width of a band of atoms along the middle.
    const MESHES: [(u16, Option<f64>); 4] = [(1, None), (5, None), (5, Some(3.0)), (3, None)];
    const STRAIN: f64 = 0.01;

    fn material(cutoff: f64) -> Material {
        let law = LennardJones {
            epsilon: 1.0,
            sigma: 1.0,
        };
        let at_cutoff = AtCutoff::Smooth { from: 0.9 * cutoff };
        let law = CutPotential::new(law, cutoff, at_cutoff);
        Material::new(Interaction::LennardJones(law), 1.0).unwrap()
    }

    fn mesh(element: u16, band: Option<f64>, triangles: i32, spacing: f64) -> Mesh {
        let atoms = |half_width| Region {
            shape: Shape::Band { half_width },
            element: 1,
        };
        Mesh::new(&Plan {
            layout: Layout {
                block: 5,
                rows: 12,
                triangles,
            },
            element,
            regions: band.map(atoms).into_iter().collect(),
            crack: None,
            grip_rows: 5,
            spacing,
        })
    }

    /// Stress and traction of an evenly stretched specimen in the bins in its middle, where no side is felt.
    fn stretched(mesh: Mesh, material: Material) -> Vec<([f64; 3], [f64; 2])> {
        let loading = crate::loading::Stretching::new(&mesh, 1e-3, crate::loading::Grip::Clamped, false);
        let setting = setting(&mesh, &material, &loading.into(), 1.0);
        let mut state = State::at_rest(mesh.node_positions(), mesh.lumped_masses());
        state.position[1].iter_mut().for_each(|y| *y *= 1.0 + STRAIN);
        let profile = ProfileLine::new(&mesh, &setting, setting.element_at_crack);
        let traction = Traction::new(&mesh, &material, &profile, &setting);
        let found = traction.read(&material, &state);
        let mut forces = Forces::new(mesh, material);
        let measure = forces.measure(&state.position).unwrap();
        let both = profile.stress(&measure, &setting).into_iter().zip(found);
        let inside = profile
            .centres()
            .iter()
            .map(|x| (0.2..0.8).contains(&(x / setting.length)));
        both.zip(inside)
            .filter(|(_, inside)| *inside)
            .map(|(bin, _)| bin)
            .collect()
    }

    #[test]
    fn the_traction_of_even_stretching_is_its_stress_in_every_bin_whatever_carries_the_sites() {
        for cutoff in [1.6, 2.5] {
            let material = material(cutoff);
            for (element, band) in MESHES {
                // Lengths on which bins of two spacings and more fall differently.
                for triangles in [21, 23, 25, 27] {
                    let bins = stretched(mesh(element, band, triangles, material.spacing), material);
                    assert!(bins.len() > 8);
                    let expected = bins[0].0[1];
                    for ([_, stress, shear], traction) in bins {
                        let label = format!("cutoff {cutoff}, element {element}, {band:?}, {triangles}");
                        assert!(shear.abs() < ROUNDING && traction[0].abs() < ROUNDING, "{label}");
                        assert!(
                            (stress / expected - 1.0).abs() < ROUNDING,
                            "{label}: {stress} {expected}"
                        );
                        // The virial over the reference area weighs bonds as they are stretched, the traction as they were.
                        let error = traction[1] * (1.0 + STRAIN) / expected - 1.0;
                        assert!(error.abs() < ROUNDING, "{label}: {error:e}");
                    }
                }
            }
        }
    }
}
