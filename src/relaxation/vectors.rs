//! Algebra of node vectors. A weight of zero marks a component whose motion is prescribed.

use crate::forces::Planes;

/// Sum of weight a b.
pub fn dot(weight: &Planes, a: &Planes, b: &Planes) -> f64 {
    let plane = |axis: usize| {
        let terms = weight[axis].iter().zip(&a[axis]).zip(&b[axis]);
        terms.map(|((weight, a), b)| weight * a * b).sum::<f64>()
    };
    plane(0) + plane(1)
}

/// Sum of a b.
pub fn plain_dot(a: &Planes, b: &Planes) -> f64 {
    let plane = |axis: usize| a[axis].iter().zip(&b[axis]).map(|(a, b)| a * b).sum::<f64>();
    plane(0) + plane(1)
}

/// target += factor vector
pub fn add(target: &mut Planes, factor: f64, vector: &Planes) {
    for axis in 0..2 {
        let pairs = target[axis].iter_mut().zip(&vector[axis]);
        pairs.for_each(|(target, value)| *target += factor * value);
    }
}

/// target = kept target + factor weight vector
pub fn turn(target: &mut Planes, kept: f64, factor: f64, weight: &Planes, vector: &Planes) {
    for axis in 0..2 {
        let terms = weight[axis].iter().zip(&vector[axis]);
        let pairs = target[axis].iter_mut().zip(terms);
        pairs.for_each(|(target, (weight, value))| *target = kept * *target + factor * weight * value);
    }
}

pub fn zeros_like(vector: &Planes) -> Planes {
    [vec![0.0; vector[0].len()], vec![0.0; vector[1].len()]]
}

/// Largest component by size.
pub fn largest(vector: &Planes) -> f64 {
    vector
        .iter()
        .flatten()
        .fold(0.0, |largest, value| largest.max(value.abs()))
}

/// Largest component, by size, among those whose weight is not zero.
pub fn largest_free(vector: &Planes, weight: &Planes) -> f64 {
    let components = vector.iter().flatten().zip(weight.iter().flatten());
    let free = components.filter(|(_, weight)| **weight > 0.0);
    free.fold(0.0, |largest, (value, _)| largest.max(value.abs()))
}
