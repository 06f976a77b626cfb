//! Bonds inside elements: all of one class are the same vector, whatever the element does.

use std::collections::BTreeMap;

use pulp::Simd;

use super::measure::Held;
use super::nodal::{bond_count, site_weight};
use super::vector::Vector;
use crate::forces::Summation;
use crate::lanes::Lanes;
use crate::lattice::fcc;
use crate::mesh::solid::element::{Element, Shape};
use crate::potential::{CutPotential, PairShape};

/// Equal bonds of an element: their vector is the sum of so many steps.
///
/// The steps of a tetrahedron lead from its first node to the others. Those of the octahedron lead from the mean of its nodes
/// to +U, from -U to the mean, and so on: its eight pieces differ in which of the two steps of each axis they take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Class {
    steps: [f64; 6],
    /// How many bonds it stands for.
    count: f64,
}

/// The classes of bonds no longer than a radius, in spacings, that are summed inside an element of this kind.
pub fn classes(summation: Summation, shape: Shape, size: i32, radius: f64) -> Vec<Class> {
    let element = Element::in_block(shape, size);
    let mut classes: BTreeMap<[i32; 6], ([i32; 6], f64)> = BTreeMap::new();
    let vectors = fcc::half_vectors_within(radius);
    for local in element.locals() {
        for vector in &vectors {
            let other = std::array::from_fn(|axis| local[axis] + vector[axis]);
            let ends = [local, other];
            let weights = ends.map(|end| site_weight(summation, element, end));
            if element.has_local(other) && weights != [0.0; 2] {
                let steps = steps(element, local, other);
                classes.entry(of_nodes(shape, steps)).or_insert((steps, 0.0)).1 += bond_count(weights);
            }
        }
    }
    let edge = match shape {
        Shape::Octahedron => f64::from(size - 1),
        _ => f64::from(size - 2),
    };
    let class = |(steps, count): ([i32; 6], f64)| Class {
        steps: steps.map(|step| f64::from(step) / edge),
        count,
    };
    classes.into_values().map(class).collect()
}

/// Six times what the nodes add to steps: the same steps of an octahedron can be taken along different axes.
fn of_nodes(shape: Shape, steps: [i32; 6]) -> [i32; 6] {
    match shape {
        Shape::Octahedron => {
            let of_mean: i32 = (0..6)
                .map(|number| if number % 2 == 0 { -steps[number] } else { steps[number] })
                .sum();
            std::array::from_fn(|node| {
                of_mean
                    + if node % 2 == 0 {
                        6 * steps[node]
                    } else {
                        -6 * steps[node]
                    }
            })
        }
        _ => steps,
    }
}

/// The steps from one site of an element to another, in units of a step between sites.
fn steps(element: Element, from: [i32; 3], to: [i32; 3]) -> [i32; 6] {
    let m = element.size - 1;
    let axes = |[p, q, r]: [i32; 3]| [q + r - m, p + r - m, p + q - m];
    match element.shape {
        Shape::Octahedron => {
            let [from, to] = [axes(from), axes(to)];
            std::array::from_fn(|number| {
                let axis = number / 2;
                match number % 2 {
                    0 => to[axis].max(0) - from[axis].max(0),
                    _ => to[axis].min(0) - from[axis].min(0),
                }
            })
        }
        shape => {
            let sign = if shape == Shape::Low { 1 } else { -1 };
            std::array::from_fn(|axis| if axis < 3 { sign * (to[axis] - from[axis]) } else { 0 })
        }
    }
}

/// Forces on the nodes of tetrahedra with nodes at these places.
#[inline(always)]
pub fn sum_tetrahedron<S: PairShape, L: Simd, const MEASURED: bool>(
    simd: L,
    law: &CutPotential<S>,
    classes: &[Class],
    nodes: [Vector<L>; 4],
) -> ([Vector<L>; 4], Held<L, MEASURED>) {
    let [first, second, third, fourth] = nodes;
    let steps = [second - first, third - first, fourth - first];
    let (pulls, held) = sum::<S, L, 3, MEASURED>(simd, law, classes, steps);
    let zero = Vector::zero(simd);
    let all = pulls[0] + pulls[1] + pulls[2];
    ([all, zero - pulls[0], zero - pulls[1], zero - pulls[2]], held)
}

/// The same of octahedra.
#[inline(always)]
pub fn sum_octahedron<S: PairShape, L: Simd, const MEASURED: bool>(
    simd: L,
    law: &CutPotential<S>,
    classes: &[Class],
    nodes: [Vector<L>; 6],
) -> ([Vector<L>; 6], Held<L, MEASURED>) {
    let sum_of_nodes = nodes[0] + nodes[1] + nodes[2] + nodes[3] + nodes[4] + nodes[5];
    let mean = sum_of_nodes.scaled(1.0 / 6.0);
    let steps = [
        nodes[0] - mean,
        mean - nodes[1],
        nodes[2] - mean,
        mean - nodes[3],
        nodes[4] - mean,
        mean - nodes[5],
    ];
    let (pulls, held) = sum::<S, L, 6, MEASURED>(simd, law, classes, steps);
    // A step to a node pulls the mean along the other way; a sixth of that is each node's.
    let outward = pulls[0] + pulls[2] + pulls[4];
    let inward = pulls[1] + pulls[3] + pulls[5];
    let shared = (outward - inward).scaled(1.0 / 6.0);
    let forces = [
        shared - pulls[0],
        shared + pulls[1],
        shared - pulls[2],
        shared + pulls[3],
        shared - pulls[4],
        shared + pulls[5],
    ];
    (forces, held)
}

/// The derivative of the energy with each step.
#[inline(always)]
fn sum<S: PairShape, L: Simd, const N: usize, const MEASURED: bool>(
    simd: L,
    law: &CutPotential<S>,
    classes: &[Class],
    steps: [Vector<L>; N],
) -> ([Vector<L>; N], Held<L, MEASURED>) {
    let mut pulls = [Vector::zero(simd); N];
    let mut held = Held::new(simd);
    for class in classes {
        let mut bond = Vector::zero(simd);
        for (step, share) in steps.iter().zip(class.steps) {
            if share != 0.0 {
                bond = step.scaled_add(share, bond);
            }
        }
        let squared = bond.squared();
        let values = law.values(simd, squared);
        let count = Lanes::all(simd, class.count);
        if MEASURED {
            held.add(values, bond, within(simd, law, squared), count);
        }
        let pull = bond.times(values[1] * count);
        for (total, share) in pulls.iter_mut().zip(class.steps) {
            if share != 0.0 {
                *total = pull.scaled_add(share, *total);
            }
        }
    }
    (pulls, held)
}

/// One for each bond within the cutoff, zero for others.
#[inline(always)]
pub fn within<S: PairShape, L: Simd>(simd: L, law: &CutPotential<S>, squared: Lanes<L>) -> Lanes<L> {
    let is_within = squared.is_below(law.squared_cutoff());
    Lanes::all(simd, 1.0).where_or(is_within, Lanes::all(simd, 0.0))
}

impl Class {
    /// Vectors of the class in an element with these places of its nodes, and how many bonds it stands for.
    pub fn bond(&self, shape: Shape, nodes: &[[f64; 3]]) -> ([f64; 3], f64) {
        let mean = |axis: usize| nodes.iter().map(|node| node[axis]).sum::<f64>() / nodes.len() as f64;
        let step = |number: usize, axis: usize| match shape {
            Shape::Octahedron if number.is_multiple_of(2) => nodes[number][axis] - mean(axis),
            Shape::Octahedron => mean(axis) - nodes[number][axis],
            _ if number < 3 => nodes[number + 1][axis] - nodes[0][axis],
            _ => 0.0,
        };
        let vector = std::array::from_fn(|axis| (0..6).map(|number| self.steps[number] * step(number, axis)).sum());
        (vector, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(shape: Shape, radius: f64) -> Vec<f64> {
        let mut counts: Vec<f64> = classes(Summation::Exact, shape, 10, radius)
            .into_iter()
            .map(|class| class.count)
            .collect();
        counts.sort_unstable_by(f64::total_cmp);
        counts
    }

    #[test]
    fn a_block_of_ten_has_720_3420_and_720_bonds_in_6_24_and_6_classes() {
        assert_eq!(counts(Shape::Low, 1.0), [120.0; 6]);
        assert_eq!(counts(Shape::High, 1.0), [120.0; 6]);
        assert_eq!(counts(Shape::Octahedron, 1.0), [[120.0; 12], [165.0; 12]].concat());
        let classes_of = [1.0, 1.45, 1.75, 2.0, 2.25].map(|radius| counts(Shape::Octahedron, radius).len());
        assert_eq!(classes_of, [24, 33, 153, 207, 303]);
    }
}
