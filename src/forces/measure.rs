//! What is not needed in every step: energy, pairs within the cutoff and virial stress.

mod elements;
mod strings;

use rayon::prelude::*;

use super::affine::Affine;
use super::summation::Sample;
use super::{CHUNK, ForceError, Forces, Planes, interface};
use crate::potential::{CutPotential, PairShape, PairValue, with_law};

/// Totals and per-element sums at one moment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measure {
    /// Potential energy, eV.
    pub energy: f64,
    /// Number of pairs within the cutoff; severed pairs do not count.
    pub pairs: f64,
    /// For every element the sum over its bonds of phi'/r d d (half of those it shares), components xx, yy, xy, eV.
    pub virial: Vec<[f64; 3]>,
}

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
    /// Energy, pairs and virial of the current state.
    pub fn measure(&mut self, position: &Planes) -> Result<Measure, ForceError> {
        self.refresh(position)?;
        self.contacts.place_sites(&self.mesh, position);
        Ok(self.measure_computed(position))
    }

    /// The same at positions for which forces have just been computed: lists and interfaces are those of this state.
    pub fn measure_computed(&self, position: &Planes) -> Measure {
        with_law!(self.material.interaction, law => self.measure_with(&law, position))
    }

    fn measure_with<S: PairShape>(&self, law: &CutPotential<S>, position: &Planes) -> Measure {
        let across = strings::sum(self, law);
        let mut virial = vec![[0.0; 3]; self.mesh.elements.len()];
        let chunks = virial.par_chunks_mut(CHUNK).enumerate();
        let parts: Vec<[f64; 2]> = chunks
            .map(|(chunk, virial)| elements::sum(self, law, &across.virial, chunk * CHUNK, virial, position))
            .collect();
        // In the order of the elements, so that threads leave no trace.
        let start = [across.energy, across.pairs];
        let [energy, pairs] = parts
            .into_iter()
            .fold(start, |sum, part| [sum[0] + part[0], sum[1] + part[1]]);
        Measure { energy, pairs, virial }
    }

    /// Calls with every bond of an element: those inside it once, those to other elements as seen from its side.
    /// Lists and site positions must be up to date.
    pub(super) fn for_each_bond(&self, element: usize, position: &Planes, mut call: impl FnMut(Bond)) {
        let shape = &self.mesh.elements[element];
        let cutoff = self.material.interaction.cutoff();
        if !shape.is_atom() {
            let affine = Affine::of_triangle(shape.size, self.mesh.first_node(element), position);
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
