//! Two small loops that do nothing but multiply and add, and nothing but read and write.

use std::hint::black_box;

use cgaft::lanes::{Lanes, MOST};
use pulp::{Arch, Simd, WithSimd};

use super::Roof;
use crate::performance::clock;

const SAMPLES: usize = 5;

pub fn roof() -> Roof {
    Roof {
        flops: peak_flops(),
        // Each of the three arrays several times as large as any cache, and small enough for that of a core.
        memory: bandwidth(1 << 24, 1),
        cache: bandwidth(1 << 14, 1 << 10),
    }
}

/// Vectors that do not wait for each other.
const CHAINS: usize = 12;

fn peak_flops() -> f64 {
    const TIMES: usize = 4_000_000;
    let sample = || {
        let mut sum = [0.0; MOST];
        let mut lanes = 0;
        let seconds = clock::core_seconds(|| {
            lanes = Arch::new().dispatch(MultiplyAdd {
                sum: &mut sum,
                factor: black_box(0.999_999),
                term: black_box(1e-6),
                times: TIMES,
            });
        });
        black_box(sum);
        1e-9 * (2 * lanes * CHAINS * TIMES) as f64 / seconds
    };
    clock::median_of(SAMPLES, sample)
}

/// Multiplies and adds so many times in every lane of every chain; gives the number of lanes.
struct MultiplyAdd<'a> {
    sum: &'a mut [f64; MOST],
    factor: f64,
    term: f64,
    times: usize,
}

impl WithSimd for MultiplyAdd<'_> {
    type Output = usize;

    #[inline(always)]
    fn with_simd<L: Simd>(self, simd: L) -> usize {
        let [factor, term] = [self.factor, self.term].map(|number| Lanes::all(simd, number));
        // Different starts, or one chain would do for all.
        let mut chains: [Lanes<L>; CHAINS] = std::array::from_fn(|chain| Lanes::all(simd, chain as f64));
        for _ in 0..self.times {
            for chain in &mut chains {
                *chain = chain.mul_add(factor, term);
            }
        }
        let mut sum = chains[0];
        for chain in &chains[1..] {
            sum = sum + *chain;
        }
        *self.sum = sum.numbers();
        Lanes::<L>::COUNT
    }
}

/// a = b + s c over arrays of this length: two numbers read and one written, 24 bytes.
fn bandwidth(length: usize, times: usize) -> f64 {
    let [mut a, b, c] = [0.0, 1.0, 2.0].map(|value| vec![value; length]);
    let mut sample = || {
        let seconds = clock::core_seconds(|| {
            for _ in 0..times {
                triad(&mut a, &b, &c, black_box(3.0));
            }
        });
        1e-9 * (24 * length * times) as f64 / seconds
    };
    sample();
    clock::median_of(SAMPLES, sample)
}

fn triad(a: &mut [f64], b: &[f64], c: &[f64], scale: f64) {
    Arch::new().dispatch(Triad { a, b, c, scale });
}

struct Triad<'a> {
    a: &'a mut [f64],
    b: &'a [f64],
    c: &'a [f64],
    scale: f64,
}

impl WithSimd for Triad<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<L: Simd>(self, _: L) {
        for ((a, b), c) in self.a.iter_mut().zip(self.b).zip(self.c) {
            *a = c.mul_add(self.scale, *b);
        }
    }
}
