//! Two small loops that do nothing but multiply and add, and nothing but read and write.

use std::hint::black_box;

use multiversion::multiversion;

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

/// Numbers of a vector, and vectors that do not wait for each other.
const LANES: usize = 8;
const CHAINS: usize = 12;

fn peak_flops() -> f64 {
    const TIMES: usize = 4_000_000;
    let sample = || {
        let mut sums = [[1.0; LANES]; CHAINS];
        let seconds = clock::core_seconds(|| multiply_add(&mut sums, black_box(0.999_999), black_box(1e-6), TIMES));
        black_box(sums);
        1e-9 * (2 * LANES * CHAINS * TIMES) as f64 / seconds
    };
    clock::median_of(SAMPLES, sample)
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx2+fma", "x86_64+avx2+fma"))]
fn multiply_add(sums: &mut [[f64; LANES]; CHAINS], factor: f64, term: f64, times: usize) {
    let mut here = *sums;
    for _ in 0..times {
        for chain in &mut here {
            for lane in chain {
                *lane = lane.mul_add(factor, term);
            }
        }
    }
    *sums = here;
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

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx2+fma", "x86_64+avx2+fma"))]
fn triad(a: &mut [f64], b: &[f64], c: &[f64], scale: f64) {
    for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
        *a = c.mul_add(scale, *b);
    }
}
