//! What bonds hold beside the forces that they exert: energy, their number and the virial. All of it is a by-product of
//! the forces.

use pulp::Simd;

use super::{ForceError, Forces, Planes};
use crate::domain::{Domain, Halo, Of};
use crate::lanes::Lanes;
use crate::potential::{CutPotential, PairShape};

/// What every element holds at one moment: all of the bonds inside it, half of those it shares.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measure {
    planes: [Vec<f64>; PARTS],
}

/// Energy (eV), pairs within the cutoff (severed ones do not count), and the sum of phi'/r d d: xx, yy, xy (eV).
pub(super) const PARTS: usize = 5;

impl Measure {
    /// Potential energy of the whole specimen, eV. All ranks must call this together.
    pub fn energy(&self, domain: &Domain) -> f64 {
        let [energy] = domain.sum_elements(|element| [self.planes[0][element]]);
        energy
    }

    /// Number of pairs within the cutoff in the whole specimen. All ranks must call this together.
    pub fn pairs(&self, domain: &Domain) -> f64 {
        let [pairs] = domain.sum_elements(|element| [self.planes[1][element]]);
        pairs
    }

    /// The sum over the bonds of an element of phi'/r d d, components xx, yy, xy, eV.
    #[inline(always)]
    pub fn virial(&self, element: usize) -> [f64; 3] {
        [2, 3, 4].map(|part| self.planes[part][element])
    }

    /// Brings to a rank what the elements hold that it has asked for.
    pub fn bring(&mut self, parcels: &mut Halo, domain: &Domain) {
        let planes = self.planes.each_mut().map(Vec::as_mut_slice);
        parcels.bring(domain, Of::Elements, planes);
    }

    /// Makes room for so many elements, untouched zeros where nothing has been measured.
    pub(super) fn fit(&mut self, elements: usize) {
        if self.planes[0].len() != elements {
            self.planes = self.planes.each_ref().map(|_| vec![0.0; elements]);
        }
    }

    /// The planes of the triangles and those of the atoms; empty where nothing is measured.
    pub(super) fn split(&mut self, triangles: usize) -> [[&mut [f64]; PARTS]; 2] {
        let mut halves: [[&mut [f64]; PARTS]; 2] = Default::default();
        for (part, plane) in self.planes.iter_mut().enumerate() {
            let middle = triangles.min(plane.len());
            [halves[0][part], halves[1][part]] = plane.split_at_mut(middle).into();
        }
        halves
    }
}

impl Forces {
    /// What elements hold in the current state.
    pub fn measure(&mut self, position: &Planes) -> Result<Measure, ForceError> {
        let mut unused = position.each_ref().map(|axis| vec![0.0; axis.len()]);
        let mut measure = Measure::default();
        self.compute_and_measure(&mut position.clone(), &mut unused, &mut measure)?;
        Ok(measure)
    }
}

/// Energy and number of bonds on the way through a sum; nothing where they are not `MEASURED`.
#[derive(Clone, Copy)]
pub(super) struct Count<L: Simd, const MEASURED: bool> {
    pub energy: Lanes<L>,
    pub pairs: Lanes<L>,
}

impl<L: Simd, const MEASURED: bool> Count<L, MEASURED> {
    #[inline(always)]
    pub fn new(simd: L) -> Self {
        let zero = Lanes::all(simd, 0.0);
        let [energy, pairs] = [zero; 2];
        Self { energy, pairs }
    }

    /// phi'/r of bonds with these squared lengths, each of which stands for so many. They do not depend on `MEASURED`.
    #[inline(always)]
    pub fn slopes<S: PairShape>(
        &mut self,
        simd: L,
        law: &CutPotential<S>,
        squared: Lanes<L>,
        count: Lanes<L>,
    ) -> Lanes<L> {
        let [energies, slopes] = law.values(simd, squared);
        if MEASURED {
            let within = count.where_or(squared.is_below(law.squared_cutoff()), Lanes::all(simd, 0.0));
            self.energy = energies.mul_add(count, self.energy);
            self.pairs = self.pairs + within;
        }
        slopes
    }
}

/// Cuts planes into so many parts of a length; the last may be shorter, and those of an empty plane are empty.
pub(super) fn in_parts<const N: usize>(
    planes: [&mut [f64]; N],
    length: usize,
    parts: usize,
) -> impl Iterator<Item = [&mut [f64]; N]> {
    in_lengths(planes, std::iter::repeat_n(length, parts))
}

/// Cuts planes into parts of these lengths; the last may be shorter, and those of an empty plane are empty.
pub(super) fn in_lengths<const N: usize>(
    mut planes: [&mut [f64]; N],
    lengths: impl Iterator<Item = usize>,
) -> impl Iterator<Item = [&mut [f64]; N]> {
    lengths.map(move |length| {
        planes.each_mut().map(|plane| {
            let end = length.min(plane.len());
            let (part, rest) = std::mem::take(plane).split_at_mut(end);
            *plane = rest;
            part
        })
    })
}
