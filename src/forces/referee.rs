//! Energy and forces by the definition: every pair of sites, one by one. Slow and obvious; it judges the fast paths.

use super::affine::site_position;
use super::{Planes, Summation};
use crate::material::Material;
use crate::mesh::Mesh;
use crate::potential::{PairValue, with_law};

/// What the sum over all site pairs gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// eV
    pub energy: f64,
    /// Force on every node, F_i = sum_a N_i(a) f_a, eV/nm: [Deng2011] Eq. (3-31) with every site a point of integration.
    pub force: Planes,
    /// Number of pairs within the cutoff; severed pairs do not count.
    pub pairs: f64,
    /// For every element the sum over its pairs of phi'/r d d, half of those it shares: xx, yy, xy, eV.
    pub virial: Vec<[f64; 3]>,
}

/// Sums over all pairs of sites, each weighed as its two sites are. The cost grows with the square of their number.
pub fn sum_over_all_pairs(mesh: &Mesh, material: &Material, position: &Planes, summation: Summation) -> Reference {
    let sites: Vec<[i32; 2]> = mesh.sites.iter().collect();
    let carried: Vec<(usize, [i32; 2])> = sites
        .iter()
        .map(|&site| {
            let element = mesh.owner_of(site).expect("every site has an element");
            (element, mesh.elements[element].local(site))
        })
        .collect();
    let place = |&(element, local): &(usize, [i32; 2])| site_position(mesh, element, local, position);
    let placed: Vec<[f64; 2]> = carried.iter().map(place).collect();
    let weigh = |&(element, local): &(usize, [i32; 2])| summation.site_weight(&mesh.elements[element], local);
    let weights: Vec<f64> = carried.iter().map(weigh).collect();
    let mut site_force = vec![[0.0; 2]; sites.len()];
    let mut reference = Reference {
        energy: 0.0,
        force: [vec![0.0; mesh.node_count()], vec![0.0; mesh.node_count()]],
        pairs: 0.0,
        virial: vec![[0.0; 3]; mesh.elements.len()],
    };
    for a in 0..sites.len() {
        for b in a + 1..sites.len() {
            let vector = [placed[b][0] - placed[a][0], placed[b][1] - placed[a][1]];
            let squared = vector[0] * vector[0] + vector[1] * vector[1];
            if squared >= material.interaction.cutoff().powi(2) {
                continue;
            }
            let severed = mesh.severed(sites[a], sites[b]);
            let value: PairValue = if severed {
                with_law!(material.interaction, law => law.repulsion(squared, material.spacing))
            } else {
                material.interaction.evaluate(squared)
            };
            let count = 0.5 * (weights[a] + weights[b]);
            reference.energy += count * value.energy;
            reference.pairs += if severed { 0.0 } else { count };
            let [x, y] = vector;
            for axis in 0..2 {
                site_force[a][axis] += count * value.slope * vector[axis];
                site_force[b][axis] -= count * value.slope * vector[axis];
            }
            for element in [carried[a].0, carried[b].0] {
                let half = 0.5 * count * value.slope;
                let virial = &mut reference.virial[element];
                (0..3).for_each(|k| virial[k] += half * [x * x, y * y, x * y][k]);
            }
        }
    }
    for (site, &(element, local)) in carried.iter().enumerate() {
        let shape = &mesh.elements[element];
        let weights = shape.shape_functions(local);
        for (node, weight) in mesh.nodes_of(element).zip(weights) {
            for axis in 0..2 {
                reference.force[axis][node] += weight * site_force[site][axis];
            }
        }
    }
    reference
}
