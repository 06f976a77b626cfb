//! What falls to each rank, and what it needs of others.

use super::contact::lattice::AtomLattice;
use crate::domain::Domain;
use crate::mesh::Mesh;
use crate::mesh::interfaces::Interfaces;

/// Costs of a triangle and of each site along its edges, whose bonds are looked at one by one, and of such a site where it
/// meets others by search; microseconds on one core, but only their ratios matter.
const TRIANGLE: f64 = 0.2;
const EDGE_SITE: f64 = 0.015;
const SEARCHED_SITE: f64 = 0.1;

/// Estimates what an element costs in a step.
pub fn costs<'a>(mesh: &'a Mesh, interfaces: &'a Interfaces) -> impl Fn(usize) -> f64 + Copy + use<'a> {
    let exposed = &interfaces.exposed;
    move |element: usize| {
        let shape = &mesh.elements[element];
        if shape.is_atom() {
            return 1.0;
        }
        let is_exposed = exposed.binary_search(&(element as u32)).is_ok();
        let edge_site = EDGE_SITE + if is_exposed { SEARCHED_SITE } else { 0.0 };
        TRIANGLE + 3.0 * f64::from(shape.size) * edge_site
    }
}

/// Others' elements that border mine in the lattice, ascending: neighbours of triangles, and partners of atoms.
pub fn bordering(domain: &Domain, mesh: &Mesh, interfaces: &Interfaces, atoms: &AtomLattice) -> Vec<u32> {
    if domain.ranks().count() == 1 {
        return Vec::new();
    }
    let mut found = Vec::new();
    let triangles = domain.triangles();
    for triangle in triangles.clone() {
        for &number in interfaces.of(triangle) {
            let pair = interfaces.pairs[number as usize];
            let others = [pair.first, pair.second].into_iter();
            found.extend(others.filter(|&other| !triangles.contains(&(other as usize))));
        }
    }
    let mine = domain.atoms();
    for atom in mine.clone() {
        atoms.partners().for_each_of(atom, |partner| {
            if !mine.contains(&partner.site()) {
                found.push((mesh.triangles + partner.site()) as u32);
            }
        });
    }
    found.sort_unstable();
    found.dedup();
    found
}
