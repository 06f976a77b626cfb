//! What the elements of a solid hold beside the forces that bonds exert: energy, their number and the virial.

use pulp::Simd;

use super::vector::Vector;
use crate::lanes::{Lanes, Mask};

/// What every element holds at one moment: all of the bonds inside it, half of those it shares.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measure {
    planes: [Vec<f64>; PARTS],
}

/// Energy (eV), pairs within the cutoff, and the sum of phi'/r d d: xx, yy, zz, yz, xz, xy (eV).
pub(super) const PARTS: usize = 8;

impl Measure {
    /// Potential energy of an element, eV.
    pub fn energy(&self, element: usize) -> f64 {
        self.planes[0][element]
    }

    /// Pairs within the cutoff that no cut severs, those shared with another element as a half.
    pub fn pairs(&self, element: usize) -> f64 {
        self.planes[1][element]
    }

    /// The sum over the bonds of an element of phi'/r d d, components xx, yy, zz, yz, xz, xy, eV.
    pub fn virial(&self, element: usize) -> [f64; 6] {
        [2, 3, 4, 5, 6, 7].map(|part| self.planes[part][element])
    }

    /// The planes, one number an element each: energy, pairs, virial.
    pub fn planes_mut(&mut self) -> [&mut Vec<f64>; PARTS] {
        self.planes.each_mut()
    }

    /// Makes room for so many elements, untouched zeros where nothing has been measured.
    pub(super) fn fit(&mut self, elements: usize) {
        if self.planes[0].len() != elements {
            self.planes = self.planes.each_ref().map(|_| vec![0.0; elements]);
        }
    }
}

/// Energy, number and virial of bonds on the way through a sum; nothing where they are not `MEASURED`.
#[derive(Clone, Copy)]
pub(super) struct Held<L: Simd, const MEASURED: bool> {
    energy: Lanes<L>,
    pairs: Lanes<L>,
    normal: Vector<L>,
    shear: Vector<L>,
}

impl<L: Simd, const MEASURED: bool> Held<L, MEASURED> {
    #[inline(always)]
    pub fn new(simd: L) -> Self {
        let zero = Lanes::all(simd, 0.0);
        Self {
            energy: zero,
            pairs: zero,
            normal: Vector::zero(simd),
            shear: Vector::zero(simd),
        }
    }

    /// Takes in bonds: their energies, phi'/r, vectors, which of them are within the cutoff, and how many each stands for.
    #[inline(always)]
    pub fn add(&mut self, [energy, slope]: [Lanes<L>; 2], bond: Vector<L>, within: Lanes<L>, count: Lanes<L>) {
        if MEASURED {
            self.energy = energy.mul_add(count, self.energy);
            self.pairs = within.mul_add(count, self.pairs);
            let weighted = bond.times(slope * count);
            self.normal = Vector {
                x: weighted.x.mul_add(bond.x, self.normal.x),
                y: weighted.y.mul_add(bond.y, self.normal.y),
                z: weighted.z.mul_add(bond.z, self.normal.z),
            };
            self.shear = Vector {
                x: weighted.y.mul_add(bond.z, self.shear.x),
                y: weighted.x.mul_add(bond.z, self.shear.y),
                z: weighted.x.mul_add(bond.y, self.shear.z),
            };
        }
    }

    #[inline(always)]
    fn parts(self) -> [Lanes<L>; PARTS] {
        let Self {
            energy,
            pairs,
            normal,
            shear,
        } = self;
        [energy, pairs, normal.x, normal.y, normal.z, shear.x, shear.y, shear.z]
    }

    /// The same where a mask says yes, the other elsewhere.
    #[inline(always)]
    pub fn where_or(self, mask: Mask<L>, other: Self) -> Self {
        match MEASURED {
            false => self,
            true => Self {
                energy: self.energy.where_or(mask, other.energy),
                pairs: self.pairs.where_or(mask, other.pairs),
                normal: self.normal.where_or(mask, other.normal),
                shear: self.shear.where_or(mask, other.shear),
            },
        }
    }

    /// Takes in what others have found.
    #[inline(always)]
    pub fn join(&mut self, other: Self) {
        if MEASURED {
            self.energy = self.energy + other.energy;
            self.pairs = self.pairs + other.pairs;
            self.normal = self.normal + other.normal;
            self.shear = self.shear + other.shear;
        }
    }

    /// Puts what so many elements side by side hold, the first of which has this place.
    #[inline(always)]
    pub fn store(self, planes: &mut [&mut [f64]; PARTS], at: usize, count: usize) {
        if MEASURED {
            for (plane, part) in planes.iter_mut().zip(self.parts()) {
                part.store(plane, at, count);
            }
        }
    }

    /// Adds half of it to what so many elements side by side hold.
    #[inline(always)]
    pub fn add_half_to(self, planes: &mut [&mut [f64]; PARTS], at: usize, count: usize) {
        if MEASURED {
            for (plane, part) in planes.iter_mut().zip(self.parts()) {
                let present = Lanes::load_some(part.simd(), plane, at, count);
                part.times_add(0.5, present).store(plane, at, count);
            }
        }
    }
}
