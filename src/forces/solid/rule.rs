//! A few places of a patch of bonds that stand for all of them.
//!
//! A rule is exact for all polynomials up to a degree, summed over the bonds of the patch (not integrated over the triangle).
//! Its places come in orbits of the symmetries of the triangle. It is found by Newton's method on the sums of symmetric
//! polynomials, from the known rule of the triangle on, as the sums go over from the one to the other.

use nalgebra::{DMatrix, DVector};

/// A place of a patch, in steps along its two edges from its first corner, and how many bonds it stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    pub at: [f64; 2],
    pub weight: f64,
}

/// Places that the symmetries of the triangle carry over into each other, and the weight of each.
#[derive(Clone, Copy, Debug)]
enum Orbit {
    /// The middle.
    One { weight: f64 },
    /// Volume coordinates (1 - 2 a, a, a) in any order.
    Three { weight: f64, a: f64 },
    /// Volume coordinates (1 - a - b, a, b) in any order.
    Six { weight: f64, a: f64, b: f64 },
}

/// How many places a rule has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Places {
    /// Exact up to degree 2.
    Three,
    /// Exact up to degree 4.
    Six,
    /// Exact up to degree 8.
    Sixteen,
}

impl Places {
    pub fn count(self) -> usize {
        match self {
            Self::Three => 3,
            Self::Six => 6,
            Self::Sixteen => 16,
        }
    }

    pub fn degree(self) -> i32 {
        match self {
            Self::Three => 2,
            Self::Six => 4,
            Self::Sixteen => 8,
        }
    }

    /// The rules of the triangle with the weights of its area 1: Strang and Fix; Dunavant 1985.
    fn of_triangle(self) -> Vec<Orbit> {
        let three = |weight: f64, a: f64| Orbit::Three { weight, a };
        match self {
            Self::Three => vec![three(1.0 / 3.0, 1.0 / 6.0)],
            Self::Six => vec![
                three(0.223_381_589_678_011, 0.445_948_490_915_965),
                three(0.109_951_743_655_322, 0.091_576_213_509_771),
            ],
            Self::Sixteen => vec![
                Orbit::One {
                    weight: 0.144_315_607_677_787,
                },
                three(0.095_091_634_267_285, 0.459_292_588_292_723),
                three(0.103_217_370_534_718, 0.170_569_307_751_760),
                three(0.032_458_497_623_198, 0.050_547_228_317_031),
                Orbit::Six {
                    weight: 0.027_230_314_174_435,
                    a: 0.263_112_829_634_638,
                    b: 0.008_394_777_409_958,
                },
            ],
        }
    }
}

/// Powers of l1 l2 + l2 l3 + l3 l1 and of l1 l2 l3: the symmetric polynomials up to a degree.
fn powers(degree: i32) -> Vec<[i32; 2]> {
    let all = (0..=degree).flat_map(|first| (0..=degree).map(move |second| [first, second]));
    all.filter(|[first, second]| 2 * first + 3 * second <= degree).collect()
}

fn value([first, second]: [i32; 2], [a, b, c]: [f64; 3]) -> f64 {
    (a * b + b * c + c * a).powi(first) * (a * b * c).powi(second)
}

/// The bonds of a patch with so many steps along an edge, in volume coordinates.
fn bonds(steps: i32) -> impl Iterator<Item = [f64; 3]> {
    let of = move |q: i32| {
        (0..=steps - q).map(move |p| [steps - p - q, p, q].map(|part| f64::from(part) / f64::from(steps.max(1))))
    };
    (0..=steps).flat_map(of)
}

/// The rule with so many places for a patch with so many steps along an edge; `None` where it has no fewer places than bonds or
/// cannot be found.
pub fn rule(places: Places, steps: i32) -> Option<Vec<Sample>> {
    let count = (steps + 1) * (steps + 2) / 2;
    if count as usize <= places.count() {
        return None;
    }
    let powers = powers(places.degree());
    let of_bonds: Vec<f64> = powers
        .iter()
        .map(|&power| bonds(steps).map(|place| value(power, place)).sum::<f64>() / f64::from(count))
        .collect();
    let mut unknowns = flattened(&places.of_triangle());
    let shapes = places.of_triangle();
    let of_triangle = sums(&shapes, &unknowns, &powers);
    for stage in 1..=STAGES {
        let share = f64::from(stage) / f64::from(STAGES);
        let target: Vec<f64> = of_triangle
            .iter()
            .zip(&of_bonds)
            .map(|(a, b)| a + share * (b - a))
            .collect();
        solve(&shapes, &mut unknowns, &powers, &target)?;
    }
    let [whole, length] = [f64::from(count), f64::from(steps)];
    let samples = placed(&shapes, &unknowns)
        .into_iter()
        .map(|(weight, [_, p, q])| Sample {
            at: [p * length, q * length],
            weight: weight * whole,
        });
    Some(samples.collect())
}

/// In so many stages the sums go over from the triangle to the bonds.
const STAGES: u32 = 20;

/// Newton's method ends after so many rounds.
const ROUNDS: u32 = 30;

/// What may be left of the sums' errors: their rounding.
const LEFT: f64 = 1e-15;

/// Step of the numerical derivatives.
const STEP: f64 = 1e-6;

fn solve(shapes: &[Orbit], unknowns: &mut DVector<f64>, powers: &[[i32; 2]], target: &[f64]) -> Option<()> {
    // Sums of high powers are small; all are asked to be good to their own size.
    let scale: Vec<f64> = target
        .iter()
        .map(|sum| 1.0 / sum.abs().max(f64::MIN_POSITIVE))
        .collect();
    let errors = |unknowns: &DVector<f64>| {
        let sums = sums(shapes, unknowns, powers);
        DVector::from_iterator(
            powers.len(),
            (0..powers.len()).map(|k| (sums[k] - target[k]) * scale[k]),
        )
    };
    let mut best = f64::INFINITY;
    for _ in 0..ROUNDS {
        let error = errors(unknowns);
        let size = error.amax();
        if size < LEFT || size >= best && size < 100.0 * LEFT {
            return Some(());
        }
        best = best.min(size);
        let mut slopes = DMatrix::zeros(powers.len(), unknowns.len());
        for column in 0..unknowns.len() {
            let moved = |way: f64| {
                let mut there = unknowns.clone();
                there[column] += way;
                errors(&there)
            };
            slopes.set_column(column, &((moved(STEP) - moved(-STEP)) / (2.0 * STEP)));
        }
        *unknowns -= slopes.lu().solve(&error)?;
    }
    None
}

fn flattened(orbits: &[Orbit]) -> DVector<f64> {
    let numbers = orbits.iter().flat_map(|orbit| match *orbit {
        Orbit::One { weight } => vec![weight],
        Orbit::Three { weight, a } => vec![weight, a],
        Orbit::Six { weight, a, b } => vec![weight, a, b],
    });
    DVector::from_vec(numbers.collect())
}

/// Weights and volume coordinates of all places.
fn placed(shapes: &[Orbit], unknowns: &DVector<f64>) -> Vec<(f64, [f64; 3])> {
    let mut numbers = unknowns.iter().copied();
    let mut next = || numbers.next().unwrap_or(0.0);
    let mut places = Vec::new();
    for shape in shapes {
        let weight = next();
        match shape {
            Orbit::One { .. } => places.push((weight, [1.0 / 3.0; 3])),
            Orbit::Three { .. } => {
                let a = next();
                let c = 1.0 - 2.0 * a;
                places.extend([[c, a, a], [a, c, a], [a, a, c]].map(|place| (weight, place)));
            }
            Orbit::Six { .. } => {
                let [a, b] = [next(), next()];
                let c = 1.0 - a - b;
                let orders = [[a, b, c], [a, c, b], [b, a, c], [b, c, a], [c, a, b], [c, b, a]];
                places.extend(orders.map(|place| (weight, place)));
            }
        }
    }
    places
}

fn sums(shapes: &[Orbit], unknowns: &DVector<f64>, powers: &[[i32; 2]]) -> Vec<f64> {
    let places = placed(shapes, unknowns);
    let sum = |&power: &[i32; 2]| places.iter().map(|&(weight, place)| weight * value(power, place)).sum();
    powers.iter().map(sum).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sums of some hundred terms of up to one.
    const ROUNDING: f64 = 1e-11;

    #[test]
    fn rules_sum_polynomials_of_their_degree_over_the_bonds_exactly() {
        for places in [Places::Three, Places::Six, Places::Sixteen] {
            for steps in 1..=38 {
                let Some(rule) = rule(places, steps) else {
                    assert!(
                        (steps + 1) * (steps + 2) / 2 <= places.count() as i32,
                        "{places:?} of {steps} steps"
                    );
                    continue;
                };
                assert_eq!(rule.len(), places.count());
                let length = f64::from(steps);
                for first in 0..=places.degree() {
                    for second in 0..=places.degree() - first {
                        let value = |[p, q]: [f64; 2]| (p / length).powi(first) * (q / length).powi(second);
                        let all: f64 = bonds(steps).map(|[_, p, q]| value([p * length, q * length])).sum();
                        let few: f64 = rule.iter().map(|sample| sample.weight * value(sample.at)).sum();
                        assert!(
                            (few - all).abs() < ROUNDING * all.max(1.0),
                            "{places:?}, {steps} steps: {few} for {all}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn three_and_six_places_of_ten_atoms_are_those_known() {
        let steps = 8;
        let three = rule(Places::Three, steps).expect("45 bonds are more than three");
        assert!(three.iter().all(|sample| (sample.weight - 15.0).abs() < 1e-9));
        assert!((three[1].at[1] / 8.0 - 0.137_899_343).abs() < 1e-9, "{three:?}");
        let six = rule(Places::Six, steps).expect("45 bonds are more than six");
        let mut weights: Vec<f64> = six.iter().map(|sample| sample.weight).collect();
        weights.sort_unstable_by(f64::total_cmp);
        assert!(
            (weights[0] - 5.182_242_366).abs() < 1e-8 && (weights[5] - 9.817_757_634).abs() < 1e-8,
            "{weights:?}"
        );
    }
}
