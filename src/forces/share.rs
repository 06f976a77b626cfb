//! What falls to each rank, and what it needs of others.

use super::contact::lattice::AtomLattice;
use super::{Forces, IntactLimit, State, tile};
use crate::domain::{Burden, Domain, Halo};
use crate::lattice::triangular;
use crate::material::Material;
use crate::mesh::Mesh;
use crate::mesh::interfaces::Interfaces;

/// Costs of a triangle and of each site along its edges, whose bonds are looked at one by one, and of such a site where it
/// meets others by search; microseconds on one core, but only their ratios matter.
const TRIANGLE: f64 = 0.2;
const EDGE_SITE: f64 = 0.015;
const SEARCHED_SITE: f64 = 0.1;

/// By how much the work of the busiest rank may exceed the mean before the specimen is cut anew.
const IMBALANCE: f64 = 0.1;

impl Forces {
    /// Whether some rank has had much more to do than the others since this was last asked. All ranks ask together, and
    /// get the same answer.
    pub fn is_unbalanced(&mut self) -> bool {
        let ranks = self.domain.ranks();
        let spent = std::mem::take(&mut self.spent);
        if ranks.count() == 1 {
            return false;
        }
        let mut slots = vec![0.0; 2 * ranks.count()];
        let has_atoms = self.mesh.elements.len() > self.mesh.triangles;
        // Contacts are mostly those of atoms, if there are any.
        let [of_triangles, of_atoms] = if has_atoms { spent } else { [spent[0] + spent[1], 0.0] };
        slots[ranks.rank()] = of_triangles;
        slots[ranks.count() + ranks.rank()] = of_atoms;
        self.spent_by_all = ranks.merge(&slots);
        let (triangles, atoms) = self.spent_by_all.split_at(ranks.count());
        let works: Vec<f64> = triangles.iter().zip(atoms).map(|(a, b)| a + b).collect();
        let most = works.iter().copied().fold(0.0, f64::max);
        most * works.len() as f64 > (1.0 + IMBALANCE) * works.iter().sum::<f64>()
    }

    /// Cuts the specimen anew, after [`Self::is_unbalanced`].
    pub fn cut_anew(&mut self) {
        let spent = self.spent_by_all.split_at(self.domain.ranks().count()).into();
        let costs = costs(&self.mesh, self.interfaces.exposed());
        self.domain.cut_anew(&self.mesh, costs, spent);
        let listed = Self::listed(&self.material);
        self.interfaces = self.interfaces.of_others(&self.mesh, listed, self.domain.grouped());
        self.strings.go_over_to(&self.interfaces, self.summation);
        self.states = vec![State::Tight; self.interfaces.pairs.len()];
        self.tiles = tile::tiles(&self.mesh, &self.interfaces, &self.strings, self.domain.grouped());
        self.bordering = bordering(&self.domain, &self.mesh, &self.interfaces, &self.atoms);
        self.halo = Halo::ask(&self.domain, &self.mesh, &self.bordering);
        self.watched.clear();
        let loosened = std::mem::take(&mut self.loosened);
        self.watch(&loosened);
        self.contacts.forget();
    }
}

/// What falls to the busiest of so many ranks, for several numbers of them, as long as no crack opens the specimen further.
pub fn burdens(mesh: &Mesh, material: &Material, counts: &[u32]) -> Vec<Burden> {
    let listed = Forces::listed(material);
    let interfaces = Interfaces::new(mesh, listed);
    let limit = IntactLimit::new(material, triangular::next_length(listed));
    let atoms = AtomLattice::new(mesh, listed, limit.regular);
    let cost = costs(mesh, interfaces.exposed());
    let classes = [0..mesh.triangles, mesh.triangles..mesh.elements.len()];
    let whole = classes.map(|elements| elements.map(cost).sum::<f64>());
    let burden = |&ranks: &u32| {
        let idle = Burden {
            ranks,
            work: 0.0,
            messages: 0,
            bytes: 0,
        };
        Domain::parts(ranks as usize, mesh, cost).fold(idle, |most, part| {
            let shares = part.elements().into_iter().zip(whole);
            let shares = shares.filter(|(elements, _)| !elements.is_empty());
            let shares = shares.map(|(elements, whole)| elements.map(cost).sum::<f64>() / whole);
            let needed = bordering(&part, mesh, &interfaces, &atoms);
            let nodes = needed
                .iter()
                .map(|&element| mesh.elements[element as usize].node_count());
            let bytes = (2 * size_of::<f64>() * nodes.sum::<usize>()) as u64;
            let mut peers: Vec<usize> = needed.iter().map(|&element| part.owner(element as usize)).collect();
            peers.sort_unstable();
            peers.dedup();
            Burden {
                ranks,
                work: shares.fold(most.work, f64::max),
                messages: most.messages.max(peers.len() as u32),
                bytes: most.bytes.max(bytes),
            }
        })
    };
    counts.iter().map(burden).collect()
}

/// Estimates what an element costs in a step; `exposed` are triangles that meet more than others, ascending.
pub fn costs<'a>(mesh: &'a Mesh, exposed: &'a [u32]) -> impl Fn(usize) -> f64 + Copy + use<'a> {
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

/// Others' elements that border mine in the lattice, ascending: neighbours of triangles, partners of atoms, and across the
/// border between triangles and atoms those with nearest-neighbour bonds, which are looked at even when they are broken.
pub fn bordering(domain: &Domain, mesh: &Mesh, interfaces: &Interfaces, atoms: &AtomLattice) -> Vec<u32> {
    if domain.count() == 1 {
        return Vec::new();
    }
    let mut found = Vec::new();
    let triangles = domain.grouped();
    for triangle in triangles.clone() {
        for &number in interfaces.of(triangle) {
            let pair = interfaces.pairs[number as usize];
            let others = pair.both().into_iter();
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
    let at_atoms = interfaces.exposed().iter().map(|&triangle| triangle as usize);
    let at_triangles = atoms.bordering().iter().map(|&atom| mesh.triangles + atom as usize);
    for element in at_atoms.chain(at_triangles).filter(|&element| domain.is_mine(element)) {
        let shape = &mesh.elements[element];
        let sites = shape.locals().map(|local| shape.site(local));
        let beside = sites.flat_map(|site| triangular::NEAREST.map(|[i, j]| [site[0] + i, site[1] + j]));
        let owners = beside
            .filter(|&site| !shape.contains(site))
            .filter_map(|site| mesh.owner_of(site));
        found.extend(owners.filter(|&owner| !domain.is_mine(owner)).map(|owner| owner as u32));
    }
    found.sort_unstable();
    found.dedup();
    found
}
