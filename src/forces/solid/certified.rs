//! How much the bonds of a patch may differ for a few places to stand for all of them.

use super::rule::{Places, Sample, rule};
use crate::forces::Summation;
use crate::material::Material;

/// Largest error of the force of a patch and of its moments over a corner's distance, over the force of as many bonds at 1 %
/// strain.
pub const ERROR: f64 = 1e-12;
const STRAIN: f64 = 0.01;

/// The bend, change of the bonds along an edge of a patch in spacings, at which the error is measured: it is far above rounding
/// there. It falls with the power of the degree of the rule and one more, that of the moments with the degree; further terms
/// fall faster.
const PROBE: f64 = 0.04;

/// Of the bend that the error allows so much is used.
const ROOM: f64 = 0.8;

/// The shortest bonds for which the error is measured, spacings.
const SHORTEST: f64 = 0.93;

/// How much bonds may change along a patch for `gauss`, in spacings: beyond, all are summed, as in two dimensions.
const HARDLY_BENT: f64 = 0.05;

/// How far places may lie beyond a corner, over an edge of the patch.
const BEYOND_CORNERS: f64 = 0.25;

/// Lengths of the bond in the middle and angles of the bends with it and with each other at which the error is measured.
const LENGTHS: u32 = 8;
const ANGLES: u32 = 8;

/// Places that stand for all bonds of patches that are hardly bent.
#[derive(Clone, Debug, PartialEq)]
pub struct Few {
    pub samples: Vec<Sample>,
    /// Largest change of the bonds along an edge, squared, nm^2.
    pub squared_bend: f64,
    /// Bonds at the corners are in this range, squared, nm^2.
    pub squared_lengths: [f64; 2],
}

impl Few {
    /// Those for patches with so many steps along an edge; `None` where they gain nothing.
    pub fn new(material: &Material, summation: Summation, steps: i32) -> Option<Self> {
        let spacing = material.spacing;
        let longest = longest(material);
        let few = |places: Places, bend: f64| {
            let samples = rule(places, steps)?;
            let squared_lengths = [SHORTEST * spacing, longest].map(|length| length * length);
            let bend = bend * spacing;
            Some(Self {
                samples,
                squared_bend: bend * bend,
                squared_lengths,
            })
        };
        match summation {
            Summation::Gauss { points: 3 } => few(Places::Three, HARDLY_BENT),
            Summation::Gauss { .. } => few(Places::Six, HARDLY_BENT),
            _ => {
                let samples = rule(Places::Sixteen, steps)?;
                let error = largest_error(material, &samples, steps, PROBE, [SHORTEST * spacing, longest], 1);
                let order = f64::from(Places::Sixteen.degree());
                let allowed = PROBE * (ERROR / error).powf(1.0 / order);
                few(Places::Sixteen, (ROOM * allowed).min(PROBE))
            }
        }
    }
}

/// The longest bonds for which the error is measured, nm: a place may lie a little beyond the corners, and must not be touched by
/// any treatment of the cutoff either.
fn longest(material: &Material) -> f64 {
    material.interaction.squared_untouched().sqrt() - BEYOND_CORNERS * PROBE * material.spacing
}

/// The largest error of a rule over patches whose middle bonds have these lengths, for a bend; so many times as many lengths and
/// angles are looked at.
fn largest_error(
    material: &Material,
    samples: &[Sample],
    steps: i32,
    bend: f64,
    [least, most]: [f64; 2],
    finer: u32,
) -> f64 {
    let angles = ANGLES * finer;
    let turn = |number: u32| std::f64::consts::TAU * f64::from(number) / f64::from(angles);
    let mut largest = 0.0f64;
    for number in 0..=LENGTHS * finer {
        let length = least + (most - least) * f64::from(number) / f64::from(LENGTHS * finer);
        for first in 0..=angles / 2 {
            for second in 0..angles {
                for between in 0..=angles / 4 {
                    let [a, b, c] = [first, second, between].map(turn);
                    let edges = [[a.cos(), a.sin(), 0.0], [b.cos(), b.sin() * c.cos(), b.sin() * c.sin()]];
                    let edges = edges.map(|edge| edge.map(|component| component * bend * material.spacing));
                    largest = largest.max(error(material, samples, steps, length, edges));
                }
            }
        }
    }
    largest
}

/// The error for one patch: the length of its middle bond, nm, and the change of the bonds along its edges.
fn error(material: &Material, samples: &[Sample], steps: i32, length: f64, edges: [[f64; 3]; 2]) -> f64 {
    let per_step = 1.0 / f64::from(steps);
    let bond = |[p, q]: [f64; 2]| -> [f64; 3] {
        std::array::from_fn(|axis| {
            let middle = if axis == 0 { length } else { 0.0 };
            middle + (p - 1.0 / 3.0) * edges[0][axis] + (q - 1.0 / 3.0) * edges[1][axis]
        })
    };
    let squared = |bond: [f64; 3]| bond.iter().map(|component| component * component).sum::<f64>();
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    if corners
        .into_iter()
        .any(|corner| squared(bond(corner)) > longest(material).powi(2))
    {
        // Such a patch is summed bond by bond.
        return 0.0;
    }
    let mut sums = [[0.0; 3]; 3];
    let mut add = |at: [f64; 2], weight: f64| {
        let [p, q] = at.map(|at| at * per_step);
        let bond = bond([p, q]);
        let slope = material.interaction.evaluate(squared(bond)).slope;
        for (sum, share) in sums.iter_mut().zip([1.0, p, q]) {
            (0..3).for_each(|axis| sum[axis] += weight * share * slope * bond[axis]);
        }
    };
    let bonds = (0..=steps).flat_map(|q| (0..=steps - q).map(move |p| [f64::from(p), f64::from(q)]));
    bonds.for_each(|at| add(at, 1.0));
    samples.iter().for_each(|sample| add(sample.at, -sample.weight));
    let count = f64::from((steps + 1) * (steps + 2) / 2);
    let unit = count * material.interaction.curvature(material.spacing) * STRAIN * material.spacing;
    let size = |sum: [f64; 3]| sum.iter().map(|component| component * component).sum::<f64>().sqrt() / unit;
    sums.map(size).into_iter().fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::potential::{AtCutoff, CutPotential, Interaction, LennardJones, Morse};

    /// Rounding of the sums that are compared: some hundred forces of ten times the unit.
    const ROUNDING: f64 = 2e-13;

    fn materials() -> [Material; 3] {
        let lennard_jones = |cutoff: f64, at_cutoff: AtCutoff| {
            let shape = LennardJones {
                epsilon: 0.415,
                sigma: 0.2277,
            };
            Interaction::LennardJones(CutPotential::new(shape, cutoff, at_cutoff))
        };
        let morse = Morse {
            depth: 1.0,
            decay: 5.0,
            distance: 1.1,
        };
        let interactions = [
            lennard_jones(0.34, AtCutoff::Truncated),
            lennard_jones(0.35, AtCutoff::Smooth { from: 0.31 }),
            Interaction::Morse(CutPotential::new(morse, 1.5, AtCutoff::Truncated)),
        ];
        interactions.map(|interaction| Material::face_centred_cubic(interaction, 1.0).expect("the potential binds"))
    }

    #[test]
    fn sixteen_places_are_all_bonds_within_the_promised_error_wherever_patches_are_hardly_bent() {
        for material in materials() {
            for steps in [5, 6, 8, 14, 28] {
                let few = Few::new(&material, Summation::Exact, steps).expect("sixteen places are fewer");
                let bend = few.squared_bend.sqrt() / material.spacing;
                let lengths = few.squared_lengths.map(f64::sqrt);
                assert!(bend > 8e-3, "{steps} steps: {bend}");
                for share in [1.0, 0.7] {
                    let error = largest_error(&material, &few.samples, steps, share * bend, lengths, 2);
                    assert!(error < ERROR + ROUNDING, "{steps} steps of {material:?}: {error:e}");
                }
                let beyond = largest_error(&material, &few.samples, steps, 2.0 * bend, lengths, 1);
                assert!(beyond > ERROR, "{beyond:e}");
            }
        }
    }

    #[test]
    fn small_patches_have_no_fewer_places_than_bonds() {
        assert!(
            materials()
                .iter()
                .all(|material| Few::new(material, Summation::Exact, 4).is_none())
        );
    }
}
