//! The plain sum over all pairs of sites of a solid, without anything that makes it fast.

use super::nodal::{bond_count, site_weight};
use super::{Measure, Planes};
use crate::forces::Summation;
use crate::material::Material;
use crate::mesh::solid::Solid;

/// Forces on the nodes and what every element holds, from every pair of sites within the cutoff: [Deng2011] Eq. (3-31) with
/// the sums over sites written out, or Eq. (3-33) with a sum over nodes. Pairs that a cut severs only repel, and do not count. It takes a time that grows as the
/// square of the number of sites.
pub fn forces(mesh: &Solid, material: &Material, summation: Summation, position: &Planes) -> (Planes, Measure) {
    let mut force = [0, 1, 2].map(|_| vec![0.0; mesh.node_count()]);
    let mut measure = Measure::default();
    measure.fit(mesh.elements.len());
    let mut sites = Vec::new();
    for (number, element) in mesh.elements.iter().enumerate() {
        for local in element.locals() {
            let site = element.site(local);
            let carriers: Vec<(usize, f64)> = mesh.carriers(number, local).collect();
            let place = position
                .each_ref()
                .map(|plane| carriers.iter().map(|&(node, weight)| weight * plane[node]).sum::<f64>());
            let weight = site_weight(summation, *element, local);
            sites.push((number, site, weight, place, carriers));
        }
    }
    let squared_cutoff = material.interaction.cutoff().powi(2);
    for (number, (first, site, weight, here, own)) in sites.iter().enumerate() {
        for (second, other, other_weight, there, others) in &sites[number + 1..] {
            let bond: [f64; 3] = std::array::from_fn(|axis| there[axis] - here[axis]);
            let squared: f64 = bond.iter().map(|component| component * component).sum();
            if squared >= squared_cutoff {
                continue;
            }
            let severed = mesh.sites.severs(*site, *other);
            let value = match severed {
                true => material.interaction.repulsion(squared, material.spacing),
                false => material.interaction.evaluate(squared),
            };
            let stands_for = bond_count([*weight, *other_weight]);
            for axis in 0..3 {
                let pull = stands_for * value.slope * bond[axis];
                own.iter()
                    .for_each(|&(node, weight)| force[axis][node] += weight * pull);
                others
                    .iter()
                    .for_each(|&(node, weight)| force[axis][node] -= weight * pull);
            }
            let [x, y, z] = bond;
            let virial = [x * x, y * y, z * z, y * z, x * z, x * y].map(|product| value.slope * product);
            let count = if severed { 0.0 } else { 1.0 };
            let held = [value.energy, count].into_iter().chain(virial);
            for (plane, part) in measure.planes_mut().into_iter().zip(held) {
                plane[*first] += 0.5 * stands_for * part;
                plane[*second] += 0.5 * stands_for * part;
            }
        }
    }
    (force, measure)
}
