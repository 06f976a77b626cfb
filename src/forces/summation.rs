//! Which bonds are looked at, and how many each stands for.

use nalgebra::DMatrix;
use pulp::Simd;

use crate::lanes::Lanes;
use crate::lattice::triangular;
use crate::mesh::element::Element;
use crate::mesh::interfaces::BondString;

/// A rule by which the sum over all bonds is taken. Each is one energy, and its forces are the gradient of that.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Summation {
    /// Every bond; where it is certified, few places along a string stand for all of its bonds.
    #[default]
    Exact,
    /// Of each string of bonds between two triangles its ends, where the nodes are, with weight 1 and this many Gauss
    /// points between them: [Deng2011] Eq. (3-31). Bonds inside triangles and contacts are summed exactly.
    Gauss { points: u32 },
    /// The same for every bond of the lattice between two triangles, however far these part; what comes together anew is
    /// summed pair by pair. So it is one energy without a jump, coarse where bonds part.
    StrictGauss { points: u32 },
    /// Only the bonds of sites that are nodes; each such site stands for its share of the element. Half the energy of a
    /// bond belongs to either end, which makes it [Deng2011] Eq. (3-33).
    Nodal,
}

impl Summation {
    /// How many sites a site stands for. A bond counts as much as its two ends do on average.
    #[inline(always)]
    pub fn site_weight(self, element: &Element, [p, q]: [i32; 2]) -> f64 {
        let last = element.size - 1;
        match self {
            Self::Exact | Self::Gauss { .. } | Self::StrictGauss { .. } => 1.0,
            Self::Nodal if [[0, 0], [last, 0], [0, last]].contains(&[p, q]) => element.lumped_mass(),
            Self::Nodal => 0.0,
        }
    }

    /// How many bonds along a lattice vector a triangle holds inside.
    pub fn bulk_count(self, size: i32, vector: [i32; 2]) -> f64 {
        if self != Self::Nodal {
            // A triangle overlaps itself, moved by a lattice vector, in a smaller triangle.
            let [i, j] = vector;
            let overlap = (size - (i.abs() + j.abs() + (i + j).abs()) / 2).max(0);
            return f64::from(overlap * (overlap + 1) / 2);
        }
        let element = Element {
            size,
            ..Element::atom([0, 0])
        };
        let bonds = element.locals().filter_map(|[p, q]| {
            let other = [p + vector[0], q + vector[1]];
            let weight = |local| self.site_weight(&element, local);
            element.contains(other).then(|| 0.5 * (weight([p, q]) + weight(other)))
        });
        bonds.sum()
    }

    /// Whether strings are summed by their rule even when they are bent or their triangles have parted.
    pub fn keeps_strings(self) -> bool {
        matches!(self, Self::StrictGauss { .. })
    }

    /// How much the bonds of a string may change along it, in spacings, for it to be looked at in few places: beyond, the
    /// energy along it is no longer close to a polynomial. There the sum is off by some 1e-4 of a bond's energy, and that
    /// is by how much the energy jumps. `None`: strings are always looked at alike.
    fn hardly_bent(self) -> Option<f64> {
        match self {
            Self::Exact | Self::Nodal | Self::StrictGauss { .. } => None,
            Self::Gauss { points: 1 } => Some(0.005),
            Self::Gauss { .. } => Some(0.05),
        }
    }
}

/// A place along a string, not always that of a bond, and how many bonds it stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    pub at: f64,
    pub weight: f64,
}

/// A string of bonds and where it is looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledString {
    pub string: BondString,
    pub samples: Vec<Sample>,
    /// Whether these are all its bonds, each counted once.
    pub every_bond: bool,
    /// Where it is looked at while it is hardly bent.
    pub few: Vec<Sample>,
    /// Change of its bonds along it, in spacings, up to which it counts as such; none without `few`.
    bend: Option<f64>,
    /// Whether its bonds are those of nearest neighbours.
    pub is_nearest: bool,
    /// Local coordinates of its first bond's ends in the first and in the second triangle, and their steps.
    pub ends: [StringEnd; 2],
    /// From its first bond to its last.
    pub length: f64,
}

/// Where the ends of a string's bonds lie in a triangle, in local coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StringEnd {
    pub start: [f64; 2],
    pub step: [f64; 2],
}

impl SampledString {
    pub fn new(summation: Summation, elements: &[Element; 2], string: BondString) -> Self {
        let rule = samples(summation, elements, &string);
        let every_bond = samples(Summation::Exact, elements, &string);
        // Where the few places are those of all bonds, nothing is gained.
        let bend = summation.hardly_bent().filter(|_| rule != every_bond);
        let samples = match summation {
            Summation::Nodal | Summation::StrictGauss { .. } => &rule,
            Summation::Exact | Summation::Gauss { .. } => &every_bond,
        };
        Self {
            string,
            every_bond: *samples == every_bond,
            samples: samples.clone(),
            few: bend.map_or_else(Vec::new, |_| rule),
            bend,
            is_nearest: triangular::squared_length(string.bond) == 1,
            ends: [(string.first, string.first_step), (string.second, string.second_step)].map(|(start, step)| {
                StringEnd {
                    start: start.map(f64::from),
                    step: step.map(f64::from),
                }
            }),
            length: f64::from(string.count - 1),
        }
    }

    /// Where it is looked at while it is hardly bent, and the change of its bonds along it, in spacings, up to which it is.
    pub fn few_places(&self) -> Option<(&[Sample], f64)> {
        self.bend.map(|bend| (self.few.as_slice(), bend))
    }

    /// Squared change of its bonds along a string of this kind, nm^2, up to which it is looked at in few places.
    #[inline(always)]
    pub fn hardly_bent(&self, spacing: f64) -> Option<f64> {
        self.bend.map(|bend| (bend * spacing) * (bend * spacing))
    }

    /// Where some strings of this kind are looked at, by their squared bends, nm^2: places, and 1 for those strings that are
    /// looked at there, 0 for the others.
    #[inline(always)]
    pub fn looks<L: Simd>(&self, simd: L, spacing: f64, squared_bend: Lanes<L>) -> [(&[Sample], Lanes<L>); 2] {
        let [none, all] = [Lanes::all(simd, 0.0), Lanes::all(simd, 1.0)];
        let few = match self.hardly_bent(spacing) {
            None => none,
            Some(limit) => all.where_or(squared_bend.is_below(limit), none),
        };
        [(&self.few, few), (&self.samples, all - few)]
    }
}

fn samples(summation: Summation, [first, second]: &[Element; 2], string: &BondString) -> Vec<Sample> {
    let bonds = 0..string.count;
    match summation {
        Summation::Exact => bonds
            .map(|t| Sample {
                at: f64::from(t),
                weight: 1.0,
            })
            .collect(),
        Summation::Gauss { points } | Summation::StrictGauss { points } => {
            ends_and_gauss_points(string.count, points as usize)
        }
        Summation::Nodal => bonds
            .filter_map(|t| {
                let [a, b] = string.ends(t);
                let weight = 0.5 * (summation.site_weight(first, a) + summation.site_weight(second, b));
                (weight > 0.0).then_some(Sample {
                    at: f64::from(t),
                    weight,
                })
            })
            .collect(),
    }
}

/// The two ends of a string, and between them the Gauss rule for the sum over the bonds there: exact for polynomials
/// of a degree below twice the number of points.
fn ends_and_gauss_points(count: i32, points: usize) -> Vec<Sample> {
    let inside = (count - 2).max(0) as usize;
    if points >= inside {
        return (0..count)
            .map(|t| Sample {
                at: f64::from(t),
                weight: 1.0,
            })
            .collect();
    }
    let end = |at: i32| Sample {
        at: f64::from(at),
        weight: 1.0,
    };
    let mut samples = vec![end(0)];
    samples.extend(
        gauss_rule(inside, points)
            .into_iter()
            .map(|Sample { at, weight }| Sample { at: at + 1.0, weight }),
    );
    samples.push(end(count - 1));
    samples
}

/// The Gauss rule of the sum over 0, 1, .. `count` - 1 from the recurrence of its orthogonal polynomials (the discrete
/// Chebyshev or Gram polynomials): places are the eigenvalues of the Jacobi matrix, weights come from its eigenvectors
/// ([Golub1969]).
pub fn gauss_rule(count: usize, points: usize) -> Vec<Sample> {
    let sites = count as f64;
    let middle = 0.5 * (sites - 1.0);
    let jacobi = DMatrix::from_fn(points, points, |row, column| {
        let j = row.max(column) as f64;
        match row.abs_diff(column) {
            0 => middle,
            1 => (j * j * (sites * sites - j * j) / (4.0 * (4.0 * j * j - 1.0))).sqrt(),
            _ => 0.0,
        }
    });
    let eigen = jacobi.symmetric_eigen();
    let mut rule: Vec<Sample> = (0..points)
        .map(|k| Sample {
            at: eigen.eigenvalues[k],
            weight: sites * eigen.eigenvectors[(0, k)].powi(2),
        })
        .collect();
    rule.sort_by(|a, b| a.at.total_cmp(&b.at));
    rule
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Eigenvalues of a matrix of a few rows are good to some rounding errors.
    const ROUNDING: f64 = 1e-12;

    #[test]
    fn gauss_points_sum_polynomials_of_less_than_twice_their_number_exactly() {
        // [Deng2011] Eq. (3-31): nodes with weight 1, Gauss points between them.
        for count in 3..=39 {
            for points in 1..=4 {
                let rule = ends_and_gauss_points(count, points);
                assert_eq!(rule.len(), (points + 2).min(count as usize));
                for power in 0..2 * points as i32 {
                    let scaled = |at: f64| (at / f64::from(count)).powi(power);
                    let exact: f64 = (0..count).map(|t| scaled(f64::from(t))).sum();
                    let found: f64 = rule.iter().map(|sample| sample.weight * scaled(sample.at)).sum();
                    assert!(
                        (found / exact - 1.0).abs() < ROUNDING,
                        "{count} bonds, {points} points, power {power}"
                    );
                }
            }
        }
    }

    #[test]
    fn nodal_sites_stand_for_all_sites_of_their_element() {
        // [Deng2011] Eq. (3-33)
        for size in [1, 4, 10] {
            let element = Element {
                size,
                sign: -1,
                column: 3,
                row: 5,
            };
            let total: f64 = element
                .locals()
                .map(|local| Summation::Nodal.site_weight(&element, local))
                .sum();
            assert!((total - element.site_count() as f64).abs() < ROUNDING);
        }
        // Two of the three corners of a triangle have an inner neighbour along each close-packed direction.
        let counts = triangular::NEAREST.map(|vector| Summation::Nodal.bulk_count(10, vector));
        counts
            .iter()
            .for_each(|count| assert!((count - 55.0 / 3.0).abs() < ROUNDING));
    }

    #[test]
    fn the_55_site_triangle_has_45_bonds_of_each_nearest_neighbour_vector() {
        assert_eq!(
            triangular::NEAREST.map(|vector| Summation::Exact.bulk_count(10, vector)),
            [45.0; 3]
        );
    }

    #[test]
    fn bond_counts_are_those_found_site_by_site() {
        let element = Element {
            size: 6,
            sign: -1,
            column: 2,
            row: 3,
        };
        for vector in triangular::half_vectors_within(6.0) {
            let ends = element.locals().filter(|&[p, q]| {
                let [p, q] = [p + vector[0], q + vector[1]];
                p >= 0 && q >= 0 && p + q < 6
            });
            assert_eq!(
                Summation::Exact.bulk_count(6, vector),
                ends.count() as f64,
                "{vector:?}"
            );
        }
    }
}
