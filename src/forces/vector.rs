//! Vectors of the plane, several side by side.

use std::ops::{Add, Sub};

use pulp::Simd;

use crate::lanes::Lanes;

#[derive(Clone, Copy)]
pub struct Vector<L: Simd> {
    pub x: Lanes<L>,
    pub y: Lanes<L>,
}

impl<L: Simd> Vector<L> {
    #[inline(always)]
    pub fn zero(simd: L) -> Self {
        let zero = Lanes::all(simd, 0.0);
        Self { x: zero, y: zero }
    }

    /// The vectors of two planes from a place on.
    #[inline(always)]
    pub fn load(simd: L, x: &[f64], y: &[f64], from: usize) -> Self {
        Self {
            x: Lanes::load(simd, x, from),
            y: Lanes::load(simd, y, from),
        }
    }

    /// Adds these to the vectors of two planes from a place on.
    #[inline(always)]
    pub fn add_to(self, x: &mut [f64], y: &mut [f64], from: usize) {
        (Lanes::load(self.x.simd(), x, from) + self.x).store(x, from, Lanes::<L>::COUNT);
        (Lanes::load(self.x.simd(), y, from) + self.y).store(y, from, Lanes::<L>::COUNT);
    }

    /// self times a factor
    #[inline(always)]
    pub fn times(self, factor: Lanes<L>) -> Self {
        Self {
            x: self.x * factor,
            y: self.y * factor,
        }
    }

    /// self * factor + term, each component rounded once.
    #[inline(always)]
    pub fn times_add(self, factor: Lanes<L>, term: Self) -> Self {
        Self {
            x: self.x.mul_add(factor, term.x),
            y: self.y.mul_add(factor, term.y),
        }
    }

    /// term - self * factor, each component rounded once.
    #[inline(always)]
    pub fn times_taken_from(self, factor: Lanes<L>, term: Self) -> Self {
        Self {
            x: self.x.negative_mul_add(factor, term.x),
            y: self.y.negative_mul_add(factor, term.y),
        }
    }

    #[inline(always)]
    pub fn dot(self, other: Self) -> Lanes<L> {
        self.x.mul_add(other.x, self.y * other.y)
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
        }
    }
}
