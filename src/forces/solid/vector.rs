//! Vectors of space, several side by side.

use std::ops::{Add, Sub};

use pulp::Simd;

use crate::lanes::{Lanes, Mask};

#[derive(Clone, Copy)]
pub struct Vector<L: Simd> {
    pub x: Lanes<L>,
    pub y: Lanes<L>,
    pub z: Lanes<L>,
}

impl<L: Simd> Vector<L> {
    #[inline(always)]
    pub fn zero(simd: L) -> Self {
        let zero = Lanes::all(simd, 0.0);
        Self {
            x: zero,
            y: zero,
            z: zero,
        }
    }

    /// So many vectors of three planes from a place on, and zeros after them.
    #[inline(always)]
    pub fn load(simd: L, [x, y, z]: [&[f64]; 3], from: usize, count: usize) -> Self {
        Self {
            x: Lanes::load_some(simd, x, from, count),
            y: Lanes::load_some(simd, y, from, count),
            z: Lanes::load_some(simd, z, from, count),
        }
    }

    /// Puts so many of these into three planes from a place on.
    #[inline(always)]
    pub fn store(self, [x, y, z]: &mut [&mut [f64]; 3], from: usize, count: usize) {
        self.x.store(x, from, count);
        self.y.store(y, from, count);
        self.z.store(z, from, count);
    }

    /// Adds so many of these to the vectors of three planes from a place on.
    #[inline(always)]
    pub fn add_to(self, planes: &mut [&mut [f64]; 3], from: usize, count: usize) {
        let simd = self.x.simd();
        let present = Self::load(simd, [planes[0], planes[1], planes[2]], from, count);
        (present + self).store(planes, from, count);
    }

    /// The vectors where a mask says yes, those of the other elsewhere.
    #[inline(always)]
    pub fn where_or(self, mask: Mask<L>, other: Self) -> Self {
        Self {
            x: self.x.where_or(mask, other.x),
            y: self.y.where_or(mask, other.y),
            z: self.z.where_or(mask, other.z),
        }
    }

    /// self times a factor
    #[inline(always)]
    pub fn times(self, factor: Lanes<L>) -> Self {
        Self {
            x: self.x * factor,
            y: self.y * factor,
            z: self.z * factor,
        }
    }

    /// self times the same factor in all lanes
    #[inline(always)]
    pub fn scaled(self, factor: f64) -> Self {
        self.times(Lanes::all(self.x.simd(), factor))
    }

    /// self * factor + term, each component rounded once.
    #[inline(always)]
    pub fn times_add(self, factor: Lanes<L>, term: Self) -> Self {
        Self {
            x: self.x.mul_add(factor, term.x),
            y: self.y.mul_add(factor, term.y),
            z: self.z.mul_add(factor, term.z),
        }
    }

    /// self * factor + term for the same factor in all lanes.
    #[inline(always)]
    pub fn scaled_add(self, factor: f64, term: Self) -> Self {
        self.times_add(Lanes::all(self.x.simd(), factor), term)
    }

    #[inline(always)]
    pub fn dot(self, other: Self) -> Lanes<L> {
        self.x.mul_add(other.x, self.y.mul_add(other.y, self.z * other.z))
    }

    #[inline(always)]
    pub fn squared(self) -> Lanes<L> {
        self.dot(self)
    }
}

impl<L: Simd> Add for Vector<L> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            x: self.x + other.x,
            y: self.y + other.y,
            z: self.z + other.z,
        }
    }
}

impl<L: Simd> Sub for Vector<L> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self {
            x: self.x - other.x,
            y: self.y - other.y,
            z: self.z - other.z,
        }
    }
}
