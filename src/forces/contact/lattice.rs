//! Atoms that are surrounded by atoms as in the perfect lattice: who their partners are follows from that.

use super::partners::{PairKind, Partner, Partners};
use crate::forces::Planes;
use crate::forces::regular::Regular;
use crate::lattice::triangular;
use crate::mesh::Mesh;

/// The lattice of the single atoms of a mesh, numbered from 0, and where it is disturbed.
pub struct AtomLattice {
    /// Partners in the reference lattice.
    partners: Partners,
    /// Atoms that border anything but atoms: a free surface, a triangle, a cut.
    bordering: Vec<u32>,
    /// Atoms with a nearest-neighbour bond that is not that of a regular lattice.
    disturbed: Vec<bool>,
    /// Atoms whose partners the last search found, ascending; all before the first.
    searched: Vec<u32>,
    regular: Option<Regular>,
}

/// How many rings of partners go with an atom that is disturbed.
const RINGS: u32 = 3;

/// Atoms by what has to be searched.
pub struct Surroundings {
    /// Whether each atom's partners are found by search; the others have those of the lattice.
    pub searched: Vec<bool>,
    /// Those and their partners in the lattice, ascending: among them, and sites of triangles, is searched.
    pub candidates: Vec<u32>,
}

impl AtomLattice {
    /// Partners are all atoms up to `listed` spacings away.
    pub fn new(mesh: &Mesh, listed: f64, regular: Option<Regular>) -> Self {
        let vectors = triangular::vectors_within(listed);
        let mut partners = Partners::default();
        let mut bordering = Vec::new();
        let mut mine = Vec::with_capacity(vectors.len());
        for (atom, element) in mesh.elements[mesh.triangles..].iter().enumerate() {
            let site = element.site([0, 0]);
            mine.clear();
            let mut borders = false;
            for &vector in &vectors {
                let other = [site[0] + vector[0], site[1] + vector[1]];
                match mesh.owner_of(other).and_then(|owner| owner.checked_sub(mesh.triangles)) {
                    Some(_) if mesh.severed(site, other) => borders = true,
                    Some(partner) => mine.push(Partner::new(partner, pair_along(vector))),
                    None => borders = true,
                }
            }
            mine.sort_unstable_by_key(|partner| partner.site());
            partners.push(mine.iter().copied(), false);
            if borders {
                bordering.push(atom as u32);
            }
        }
        partners.finish();
        Self {
            disturbed: vec![false; partners.site_count()],
            searched: (0..partners.site_count() as u32).collect(),
            partners,
            bordering,
            regular,
        }
    }

    pub fn partners(&self) -> &Partners {
        &self.partners
    }

    /// Atoms that border anything but atoms, ascending.
    pub fn bordering(&self) -> &[u32] {
        &self.bordering
    }

    /// Atoms that may have irregular bonds: those whose partners the last search found, ascending; all before the first.
    pub fn searched(&self) -> &[u32] {
        &self.searched
    }

    pub fn is_disturbed(&self, atom: usize) -> bool {
        self.disturbed[atom]
    }

    /// Takes an atom out of the lattice, and those around it: where one bond goes, the next are soon to follow, and each that
    /// is found later costs a search.
    pub fn disturb(&mut self, atom: usize) {
        let Self {
            partners, disturbed, ..
        } = self;
        disturbed[atom] = true;
        let mut ring = vec![atom];
        for _ in 0..RINGS {
            let mut next = Vec::new();
            for &atom in &ring {
                partners.for_each_of(atom, |partner| {
                    if !std::mem::replace(&mut disturbed[partner.site()], true) {
                        next.push(partner.site());
                    }
                });
            }
            ring = next;
        }
    }

    /// Forgets where it is disturbed.
    pub fn calm(&mut self) {
        self.disturbed.fill(false);
        self.searched = (0..self.disturbed.len() as u32).collect();
    }

    /// Which atoms are to be searched at these positions.
    ///
    /// An atom keeps the partners of the lattice while no atom up to the listed length from it borders anything else or is
    /// disturbed: within the cutoff around it lies nothing but a regular lattice (see [`Regular`]).
    pub fn surroundings(&mut self, mesh: &Mesh, position: &Planes) -> Surroundings {
        let atoms = self.disturbed.len();
        let Some(regular) = self.regular else {
            self.searched = (0..atoms as u32).collect();
            return Surroundings {
                searched: vec![true; atoms],
                candidates: (0..atoms as u32).collect(),
            };
        };
        let mut searched = vec![false; atoms];
        let disturbed = (0..atoms as u32).filter(|&atom| self.disturbed[atom as usize]);
        let mut centres: Vec<u32> = self.bordering.iter().copied().chain(disturbed).collect();
        // Around every such atom; whoever turns out to be disturbed there is one, too.
        let mut around = Vec::new();
        while let Some(centre) = centres.pop() {
            around.clear();
            around.push(centre as usize);
            self.partners
                .for_each_of(centre as usize, |partner| around.push(partner.site()));
            for &atom in &around {
                let is_new = !std::mem::replace(&mut searched[atom], true);
                if is_new && !self.disturbed[atom] && self.has_irregular_bond(mesh, regular, atom, position) {
                    self.disturbed[atom] = true;
                    centres.push(atom as u32);
                }
            }
        }
        let mut is_candidate = searched.clone();
        for atom in (0..atoms).filter(|&atom| searched[atom]) {
            self.partners
                .for_each_of(atom, |partner| is_candidate[partner.site()] = true);
        }
        self.searched = (0..atoms as u32).filter(|&atom| searched[atom as usize]).collect();
        Surroundings {
            candidates: (0..atoms as u32).filter(|&atom| is_candidate[atom as usize]).collect(),
            searched,
        }
    }

    fn has_irregular_bond(&self, mesh: &Mesh, regular: Regular, atom: usize, position: &Planes) -> bool {
        let node = |atom: usize| 3 * mesh.triangles + atom;
        let mut irregular = false;
        self.partners.for_each_of(atom, |partner| {
            if partner.is_nearest() {
                let [x, y] = [0, 1].map(|axis| position[axis][node(partner.site())] - position[axis][node(atom)]);
                irregular |= !regular.holds_for(x * x + y * y);
            }
        });
        irregular
    }
}

/// What joins two sites of the lattice that are this far apart.
pub fn pair_along(vector: [i32; 2]) -> PairKind {
    if triangular::squared_length(vector) == 1 {
        PairKind::Nearest
    } else {
        PairKind::Any
    }
}
