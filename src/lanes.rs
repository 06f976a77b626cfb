//! The same arithmetic on several numbers at once, as many as the processor has room for.
//!
//! Lanes never mix and multiply-adds round once on every processor, so results have the same bits whatever the width.

use std::ops::{Add, Mul, Range, Sub};

use pulp::Simd;
use rayon::prelude::*;

/// Numbers side by side. `simd` says which instructions the processor has.
#[derive(Clone, Copy, Debug)]
pub struct Lanes<S: Simd> {
    simd: S,
    value: S::f64s,
}

/// A yes or no for each of some lanes.
#[derive(Clone, Copy, Debug)]
pub struct Mask<S: Simd> {
    simd: S,
    value: S::m64s,
}

impl<S: Simd> Lanes<S> {
    /// How many lanes there are.
    pub const COUNT: usize = S::F64_LANES;

    #[inline(always)]
    pub fn all(simd: S, value: f64) -> Self {
        let value = simd.splat_f64s(value);
        Self { simd, value }
    }

    /// The instructions that the processor has.
    #[inline(always)]
    pub fn simd(self) -> S {
        self.simd
    }

    /// What a function of the lane's number gives; slower than arithmetic.
    #[inline(always)]
    pub fn each(simd: S, of_lane: impl FnMut(usize) -> f64) -> Self {
        let lanes: [f64; MOST] = std::array::from_fn(of_lane);
        Self::load(simd, &lanes, 0)
    }

    /// The numbers from a place of a plane on.
    #[inline(always)]
    pub fn load(simd: S, plane: &[f64], from: usize) -> Self {
        let value = S::as_simd_f64s(&plane[from..from + Self::COUNT]).0[0];
        Self { simd, value }
    }

    /// So many numbers from a place of a plane on, and zeros after them.
    #[inline(always)]
    pub fn load_some(simd: S, plane: &[f64], from: usize, count: usize) -> Self {
        if count >= Self::COUNT {
            return Self::load(simd, plane, from);
        }
        let value = simd.partial_load_f64s(&plane[from..from + count]);
        Self { simd, value }
    }

    /// Puts so many numbers from a place of a plane on.
    #[inline(always)]
    pub fn store(self, plane: &mut [f64], from: usize, count: usize) {
        if count >= Self::COUNT {
            S::as_mut_simd_f64s(&mut plane[from..from + Self::COUNT]).0[0] = self.value;
        } else {
            self.simd.partial_store_f64s(&mut plane[from..from + count], self.value);
        }
    }

    /// The numbers of all lanes, zeros after them.
    #[inline(always)]
    pub fn numbers(self) -> [f64; MOST] {
        let mut numbers = [0.0; MOST];
        self.store(&mut numbers, 0, Self::COUNT);
        numbers
    }

    /// self * factor + term, rounded once.
    #[inline(always)]
    pub fn mul_add(self, factor: Self, term: Self) -> Self {
        let value = self.simd.mul_add_f64s(self.value, factor.value, term.value);
        Self { value, ..self }
    }

    /// self * factor + term for the same factor in all lanes.
    #[inline(always)]
    pub fn times_add(self, factor: f64, term: Self) -> Self {
        self.mul_add(Self::all(self.simd, factor), term)
    }

    /// term - self * factor, rounded once.
    #[inline(always)]
    pub fn negative_mul_add(self, factor: Self, term: Self) -> Self {
        let negative = self.simd.neg_f64s(self.value);
        let value = self.simd.mul_add_f64s(negative, factor.value, term.value);
        Self { value, ..self }
    }

    #[inline(always)]
    pub fn absolute(self) -> Self {
        let value = self.simd.abs_f64s(self.value);
        Self { value, ..self }
    }

    /// 1 / self
    #[inline(always)]
    pub fn inverse(self) -> Self {
        let value = self.simd.div_f64s(self.simd.splat_f64s(1.0), self.value);
        Self { value, ..self }
    }

    #[inline(always)]
    pub fn square_root(self) -> Self {
        let value = self.simd.sqrt_f64s(self.value);
        Self { value, ..self }
    }

    #[inline(always)]
    pub fn is_below(self, limit: f64) -> Mask<S> {
        let value = self.simd.less_than_f64s(self.value, self.simd.splat_f64s(limit));
        Mask { simd: self.simd, value }
    }

    #[inline(always)]
    pub fn is_above(self, limit: f64) -> Mask<S> {
        let value = self.simd.greater_than_f64s(self.value, self.simd.splat_f64s(limit));
        Mask { simd: self.simd, value }
    }

    /// The numbers where the mask says yes, those of the other elsewhere.
    #[inline(always)]
    pub fn where_or(self, mask: Mask<S>, other: Self) -> Self {
        let value = self.simd.select_f64s(mask.value, self.value, other.value);
        Self { value, ..self }
    }
}

/// Has the processor fetch from memory what will be needed, so that nothing waits for it then. Corners of a row of triangles
/// are too many streams, each too short, for it to guess.
#[inline(always)]
#[cfg_attr(
    target_arch = "x86_64",
    allow(
        unsafe_code,
        reason = "a hint to the processor: it reads nothing, whatever the address"
    )
)]
pub fn prefetch(plane: &[f64], at: usize) {
    #[cfg(target_arch = "x86_64")]
    unsafe {
        use core::arch::x86_64::{_MM_HINT_T1, _mm_prefetch};
        _mm_prefetch::<_MM_HINT_T1>(plane.as_ptr().wrapping_add(at).cast());
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (plane, at);
}

/// The most lanes any processor has.
pub const MOST: usize = 8;

/// Terms of a sum that are added before any others join them.
pub const BLOCK: usize = 4096;

/// Some sums of so many terms in an order that only their number sets: block by block.
pub fn sums<const N: usize>(count: usize, term: impl Fn(usize) -> [f64; N] + Sync) -> [f64; N] {
    let starts = (0..count).into_par_iter().step_by(BLOCK);
    let blocks: Vec<[f64; N]> = starts
        .map(|start| block_sums(start..count.min(start + BLOCK), &term))
        .collect();
    in_order(&blocks)
}

/// The sums of one block: as many side by side as there may be lanes.
pub fn block_sums<const N: usize>(block: Range<usize>, term: impl Fn(usize) -> [f64; N]) -> [f64; N] {
    let mut sums = [[0.0; MOST]; N];
    let mut add = |lane: usize, terms: [f64; N]| (0..N).for_each(|k| sums[k][lane] += terms[k]);
    let mut at = block.start;
    while at + MOST <= block.end {
        (0..MOST).for_each(|lane| add(lane, term(at + lane)));
        at += MOST;
    }
    (at..block.end).for_each(|k| add(k - at, term(k)));
    sums.map(|lanes| lanes.iter().sum())
}

/// The sums of blocks that follow each other.
pub fn in_order<const N: usize>(blocks: &[[f64; N]]) -> [f64; N] {
    std::array::from_fn(|k| blocks.iter().map(|sums| sums[k]).sum())
}

impl<S: Simd> Mask<S> {
    #[inline(always)]
    pub fn all(simd: S, answer: bool) -> Self {
        Lanes::all(simd, f64::from(u8::from(answer))).is_above(0.0)
    }

    #[inline(always)]
    pub fn or(self, other: Self) -> Self {
        let value = self.simd.or_m64s(self.value, other.value);
        Self { value, ..self }
    }

    #[inline(always)]
    pub fn and(self, other: Self) -> Self {
        let value = self.simd.and_m64s(self.value, other.value);
        Self { value, ..self }
    }

    /// No where it says yes, and yes elsewhere.
    #[inline(always)]
    pub fn opposite(self) -> Self {
        let value = self.simd.not_m64s(self.value);
        Self { value, ..self }
    }

    /// Whether it says yes in any lane.
    #[inline(always)]
    pub fn any(self) -> bool {
        self.simd.first_true_m64s(self.value) < Lanes::<S>::COUNT
    }

    /// Whether it says yes in all lanes.
    #[inline(always)]
    pub fn every(self) -> bool {
        !self.opposite().any()
    }

    /// What it says in each lane, and no after them.
    #[inline(always)]
    pub fn answers(self) -> [bool; MOST] {
        let yes = Lanes::all(self.simd, 1.0).where_or(self, Lanes::all(self.simd, 0.0));
        yes.numbers().map(|number| number > 0.0)
    }
}

impl<S: Simd> Add for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let value = self.simd.add_f64s(self.value, other.value);
        Self { value, ..self }
    }
}

impl<S: Simd> Sub for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        let value = self.simd.sub_f64s(self.value, other.value);
        Self { value, ..self }
    }
}

impl<S: Simd> Mul for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let value = self.simd.mul_f64s(self.value, other.value);
        Self { value, ..self }
    }
}

impl<S: Simd> Mul<f64> for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self * Self::all(self.simd, factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_takes_every_term_once_and_has_the_same_bits_on_any_number_of_threads() {
        for count in [0, 1, MOST, BLOCK - 3, BLOCK, 3 * BLOCK + MOST + 5] {
            let whole = (count * count.saturating_sub(1) / 2) as f64;
            assert_eq!(sums(count, |k| [k as f64]), [whole]);
            let on = |threads: usize| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
                pool.expect("threads can be started")
                    .install(|| sums(count, |k| [(k as f64).sqrt()]))
            };
            assert_eq!(on(1).map(f64::to_bits), on(3).map(f64::to_bits));
        }
    }
}
