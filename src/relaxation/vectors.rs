//! Algebra of node vectors. A weight of zero marks a component whose motion is prescribed.
//!
//! Threads share the work by parts of fixed length, and sums of parts are added in their order: the number of threads leaves no
//! trace.

use rayon::prelude::*;

use crate::forces::Planes;

/// Numbers that a thread takes at once.
const PART: usize = 1 << 14;

/// Numbers that are computed side by side.
const LANES: usize = 8;

/// Sum of the terms of all components.
pub fn sum<const N: usize, const D: usize>(vectors: [&Planes<D>; N], term: impl Fn([f64; N]) -> f64 + Sync) -> f64 {
    let plane = |axis: usize| {
        let planes = vectors.map(|vector| &vector[axis]);
        let parts = 0..planes[0].len().div_ceil(PART);
        let part = |number: usize| sum_of_part(planes.map(|plane| part_of(plane, number)), &term);
        let sums: Vec<f64> = parts.into_par_iter().map(part).collect();
        sums.iter().sum::<f64>()
    };
    (0..D).map(plane).sum()
}

fn sum_of_part<const N: usize>(slices: [&[f64]; N], term: impl Fn([f64; N]) -> f64) -> f64 {
    let split = slices.map(|slice| slice.as_chunks::<LANES>());
    let mut sums = [0.0; LANES];
    for k in 0..split[0].0.len() {
        let blocks = split.map(|(blocks, _)| &blocks[k]);
        for lane in 0..LANES {
            sums[lane] += term(blocks.map(|block| block[lane]));
        }
    }
    let rest = (0..split[0].1.len()).map(|k| term(split.map(|(_, rest)| rest[k])));
    sums.into_iter().chain(rest).sum()
}

/// Puts what the rule makes of every component and those of other vectors in its place.
pub fn change<const N: usize, const D: usize>(
    target: &mut Planes<D>,
    vectors: [&Planes<D>; N],
    rule: impl Fn(f64, [f64; N]) -> f64 + Sync,
) {
    for axis in 0..D {
        let parts = target[axis].par_chunks_mut(PART).enumerate();
        parts.for_each(|(number, values)| {
            change_part(values, vectors.map(|vector| part_of(&vector[axis], number)), &rule);
        });
    }
}

fn change_part<const N: usize>(target: &mut [f64], slices: [&[f64]; N], rule: impl Fn(f64, [f64; N]) -> f64) {
    let (target, rest_of_target) = target.as_chunks_mut::<LANES>();
    let split = slices.map(|slice| slice.as_chunks::<LANES>());
    for (k, values) in target.iter_mut().enumerate() {
        let blocks = split.map(|(blocks, _)| &blocks[k]);
        for lane in 0..LANES {
            values[lane] = rule(values[lane], blocks.map(|block| block[lane]));
        }
    }
    for (k, value) in rest_of_target.iter_mut().enumerate() {
        *value = rule(*value, split.map(|(_, rest)| rest[k]));
    }
}

fn part_of(plane: &[f64], number: usize) -> &[f64] {
    let rest = &plane[number * PART..];
    &rest[..rest.len().min(PART)]
}

/// Sum of weight a b.
pub fn dot<const D: usize>(weight: &Planes<D>, a: &Planes<D>, b: &Planes<D>) -> f64 {
    sum([weight, a, b], |[weight, a, b]| weight * a * b)
}

/// Sum of a b.
pub fn plain_dot<const D: usize>(a: &Planes<D>, b: &Planes<D>) -> f64 {
    sum([a, b], |[a, b]| a * b)
}

/// target += factor vector
pub fn add<const D: usize>(target: &mut Planes<D>, factor: f64, vector: &Planes<D>) {
    change(target, [vector], |target, [value]| target + factor * value);
}

/// target = kept target + factor weight vector
pub fn turn<const D: usize>(target: &mut Planes<D>, kept: f64, factor: f64, weight: &Planes<D>, vector: &Planes<D>) {
    change(target, [weight, vector], |target, [weight, value]| {
        kept * target + factor * weight * value
    });
}

pub fn zeros_like<const D: usize>(vector: &Planes<D>) -> Planes<D> {
    vector.each_ref().map(|plane| vec![0.0; plane.len()])
}

/// Largest component by size.
pub fn largest<const D: usize>(vector: &Planes<D>) -> f64 {
    let sizes = |plane: &Vec<f64>| {
        plane
            .par_iter()
            .with_min_len(PART)
            .map(|value| value.abs())
            .reduce(|| 0.0, f64::max)
    };
    vector.iter().map(sizes).fold(0.0, f64::max)
}

/// Largest component, by size, among those whose weight is not zero.
pub fn largest_free<const D: usize>(vector: &Planes<D>, weight: &Planes<D>) -> f64 {
    let sizes = |axis: usize| {
        let components = vector[axis].par_iter().zip(&weight[axis]).with_min_len(PART);
        let free = components.map(|(value, weight)| if *weight > 0.0 { value.abs() } else { 0.0 });
        free.reduce(|| 0.0, f64::max)
    };
    (0..D).map(sizes).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whole numbers, so that sums are exact in any order; neither parts nor lanes come out even.
    fn ramp(step: f64) -> Planes {
        let plane = |first: f64| {
            (0..2 * PART + LANES + 3)
                .map(|k| first + step * (k % 100) as f64)
                .collect()
        };
        [plane(1.0), plane(-7.0)]
    }

    #[test]
    fn parts_and_lanes_leave_nothing_out() {
        let (a, b) = (ramp(1.0), ramp(-2.0));
        let flat = |vector: &Planes| vector.concat();
        let plain: f64 = flat(&a).iter().zip(flat(&b)).map(|(a, b)| a * b).sum();
        assert_eq!(plain_dot(&a, &b), plain);
        let mut turned = a.clone();
        turn(&mut turned, 3.0, 0.5, &b, &a);
        let wanted = flat(&a).into_iter().zip(flat(&b)).map(|(a, b)| 3.0 * a + 0.5 * b * a);
        assert_eq!(flat(&turned), wanted.collect::<Vec<_>>());
        assert_eq!(largest(&b), 205.0);
    }
}
