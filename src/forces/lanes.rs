//! The same arithmetic on several numbers at once, in a form that compilers turn into vector instructions.
//!
//! Lanes never mix: what happens in one does not depend on how many there are, so results have the same bits for every
//! width of the vectors and of the hardware.

use std::ops::{Add, AddAssign, Index, Mul, Sub};

#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Lanes<const W: usize>(pub [f64; W]);

impl<const W: usize> Default for Lanes<W> {
    #[inline(always)]
    fn default() -> Self {
        Self::all(0.0)
    }
}

impl<const W: usize> Lanes<W> {
    #[inline(always)]
    pub fn all(value: f64) -> Self {
        Self([value; W])
    }

    /// What a function of the lane's number gives. (A plain loop: compilers take what is more general less well apart.)
    #[inline(always)]
    pub fn each(of_lane: impl Fn(usize) -> f64) -> Self {
        let mut lanes = [0.0; W];
        for lane in 0..W {
            lanes[lane] = of_lane(lane);
        }
        Self(lanes)
    }

    /// The numbers from a place of a plane on.
    #[inline(always)]
    pub fn load(plane: &[f64], from: usize) -> Self {
        let numbers = &plane[from..from + W];
        Self::each(|lane| numbers[lane])
    }

    #[inline(always)]
    pub fn store(self, plane: &mut [f64], from: usize) {
        plane[from..from + W].copy_from_slice(&self.0);
    }

    /// self * factor + term, rounded once.
    #[inline(always)]
    pub fn mul_add(self, factor: Self, term: Self) -> Self {
        Self::each(|lane| self.0[lane].mul_add(factor.0[lane], term.0[lane]))
    }

    /// self * factor + term for the same factor in all lanes.
    #[inline(always)]
    pub fn times_add(self, factor: f64, term: Self) -> Self {
        self.mul_add(Self::all(factor), term)
    }

    /// Whether the numbers of all lanes are as asked.
    #[inline(always)]
    pub fn every(self, asked: impl Fn(f64) -> bool) -> bool {
        // Without leaving early, so that all lanes are compared at once.
        let mut all = true;
        for lane in 0..W {
            all &= asked(self.0[lane]);
        }
        all
    }
}

impl<const W: usize> Index<usize> for Lanes<W> {
    type Output = f64;

    #[inline(always)]
    fn index(&self, lane: usize) -> &f64 {
        &self.0[lane]
    }
}

impl<const W: usize> Add for Lanes<W> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::each(|lane| self.0[lane] + other.0[lane])
    }
}

impl<const W: usize> AddAssign for Lanes<W> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const W: usize> Sub for Lanes<W> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::each(|lane| self.0[lane] - other.0[lane])
    }
}

impl<const W: usize> Mul for Lanes<W> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self::each(|lane| self.0[lane] * other.0[lane])
    }
}

impl<const W: usize> Mul<f64> for Lanes<W> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self * Self::all(factor)
    }
}
