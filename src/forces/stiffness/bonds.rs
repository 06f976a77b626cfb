//! The bonds of an element, one by one.

use crate::forces::affine::Affine;
use crate::forces::summation::Sample;
use crate::forces::{Forces, Planes, interface};
use crate::potential::{CutPotential, PairShape, PairValue};

/// A bond as one element sees it.
pub(super) struct Bond {
    pub vector: [f64; 2],
    /// How many bonds it stands for, as its rule of summation weighs it.
    pub count: f64,
    pub kind: BondKind,
}

pub(super) enum BondKind {
    /// Inside a triangle, along this lattice vector in local coordinates.
    Inside { local: [i32; 2] },
    /// Between this place of the element, in local coordinates, and another element, which counts the bond too.
    Across { local: [f64; 2], severed: bool },
}

impl Forces {
    /// Calls with every bond of an element: those inside it once, those to other elements as seen from its side.
    /// Lists and site positions must be up to date.
    pub(super) fn for_each_bond(&self, element: usize, position: &Planes, mut call: impl FnMut(Bond)) {
        let shape = &self.mesh.elements[element];
        let cutoff = self.material.interaction.cutoff();
        if !shape.is_atom() {
            let affine = Affine::of_triangle(&self.mesh, element, position);
            for bond in self.bulk.within(shape.size, &affine, self.material.spacing, cutoff) {
                let kind = BondKind::Inside { local: bond.local };
                call(Bond {
                    vector: affine.vector(bond.local),
                    count: bond.count,
                    kind,
                });
            }
            for &number in self
                .interfaces
                .of(element)
                .iter()
                .filter(|&&number| !self.is_open(number as usize))
            {
                self.for_each_string_bond(element, number as usize, position, &mut call);
            }
        }
        for site in self.contacts.sites_of(&self.mesh, element) {
            let local = self.contacts.local(site).map(f64::from);
            self.contacts.for_each_partner(site, |vector, severed, count| {
                call(Bond {
                    vector,
                    count,
                    kind: BondKind::Across { local, severed },
                });
            });
        }
    }

    fn for_each_string_bond(&self, element: usize, number: usize, position: &Planes, call: &mut impl FnMut(Bond)) {
        let pair = interface::Pair::new(&self.mesh, &self.interfaces, number, position);
        let is_first = self.interfaces.pairs[number].first as usize == element;
        let kind = self.interfaces.pairs[number].kind;
        for sampled in &self.strings.of(kind).strings {
            let string = &sampled.string;
            let [start, step] = pair.string_vectors(string);
            let squared_bend = (step[0] * step[0] + step[1] * step[1]) * (sampled.length * sampled.length);
            let few = sampled.hardly_bent(self.material.spacing);
            let samples = match few.is_some_and(|limit| squared_bend < limit) {
                true => &sampled.few,
                false => &sampled.samples,
            };
            let (site, site_step) = if is_first {
                (string.first, string.first_step)
            } else {
                (string.second, string.second_step)
            };
            for &Sample { at, weight } in samples {
                let vector = [start[0] + at * step[0], start[1] + at * step[1]];
                let local = [0, 1].map(|k| f64::from(site[k]) + at * f64::from(site_step[k]));
                call(Bond {
                    vector,
                    count: weight,
                    kind: BondKind::Across { local, severed: false },
                });
            }
        }
    }

    /// What a pair is worth, bonded or severed.
    #[inline(always)]
    pub(super) fn pair_value<S: PairShape>(&self, law: &CutPotential<S>, squared: f64, severed: bool) -> PairValue {
        if severed {
            law.repulsion(squared, self.material.spacing)
        } else {
            law.evaluate(squared)
        }
    }
}
