//! A few places along a string that stand for all its bonds to less than the rounding of their sum, and how much the string
//! may be bent for that.

use super::regular::Regular;
use super::summation::{Sample, gauss_rule};
use crate::material::Material;

/// Gauss points of the sum over the bonds of a string: exact for polynomials of a degree below twice their number.
const POINTS: usize = 4;

/// Largest error of the force of a string and of its moment over half its length, over the force of as many bonds at 1 %
/// strain.
pub const ERROR: f64 = 1e-12;
const STRAIN: f64 = 0.01;

/// The bend, change of the bonds along a string in spacings, at which the error is measured: it is far above rounding there.
/// It falls with the power 2 `POINTS` of the bend, that of the moment with one less; further terms fall faster.
const PROBE: f64 = 0.06;
const ORDER: i32 = 2 * POINTS as i32 - 1;

/// Of the bend that the error allows so much is used.
const ROOM: f64 = 0.8;

/// Lengths of the bond in the middle and angles between it and the bend at which the error is measured.
const LENGTHS: u32 = 16;
const ANGLES: u32 = 12;

/// What few places along regular strings of nearest neighbours are good for, with one potential.
#[derive(Clone, Copy, Debug)]
pub struct Certificate<'a> {
    pub material: &'a Material,
    /// Bonds are in this range.
    pub regular: Regular,
}

impl Certificate<'_> {
    /// Where to look at a string of so many bonds, and its largest bend, in spacings. `None` where that gains nothing.
    pub fn few(&self, count: i32) -> Option<(Vec<Sample>, f64)> {
        let is_worth_it = count as usize > POINTS + 1;
        is_worth_it.then(|| {
            let rule = gauss_rule(count as usize, POINTS);
            let lengths = 0..=LENGTHS;
            let angles = 0..=ANGLES;
            let cases = lengths.flat_map(|length| angles.clone().map(move |angle| [length, angle]));
            let error = cases
                .map(|[length, angle]| {
                    let [least, most] = self.regular.lengths();
                    let length = least + (most - least) * f64::from(length) / f64::from(LENGTHS);
                    let angle = std::f64::consts::FRAC_PI_2 * f64::from(angle) / f64::from(ANGLES);
                    self.error(&rule, count, length, [PROBE, angle])
                })
                .fold(0.0, f64::max);
            let allowed = PROBE * (ERROR / error).powf(1.0 / f64::from(ORDER));
            (rule, (ROOM * allowed).min(PROBE))
        })
    }

    /// The error of a rule on a string of so many bonds, of which the one in the middle has this length, nm, with this bend, in
    /// spacings, and angle between the two.
    fn error(&self, rule: &[Sample], count: i32, length: f64, [bend, angle]: [f64; 2]) -> f64 {
        let Material {
            interaction, spacing, ..
        } = self.material;
        let half = 0.5 * f64::from(count - 1);
        let step = 0.5 * bend * spacing / half;
        let [step_x, step_y] = [step * angle.cos(), step * angle.sin()];
        let mut sums = [[0.0; 2]; 2];
        let mut add = |at: f64, weight: f64| {
            let place = at - half;
            let bond = [length + place * step_x, place * step_y];
            let slope = interaction.evaluate(bond[0] * bond[0] + bond[1] * bond[1]).slope;
            for (axis, component) in bond.into_iter().enumerate() {
                let force = weight * slope * component;
                sums[0][axis] += force;
                sums[1][axis] += force * place / half;
            }
        };
        (0..count).for_each(|bond| add(f64::from(bond), 1.0));
        rule.iter().for_each(|sample| add(sample.at, -sample.weight));
        let unit = f64::from(count) * interaction.curvature(*spacing) * STRAIN * spacing;
        sums.map(|[x, y]| x.hypot(y) / unit).into_iter().fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::forces::Forces;
    use crate::forces::interface::IntactLimit;
    use crate::lattice::triangular;
    use crate::potential::{AtCutoff, CutPotential, HarmonicBond, Interaction, LennardJones, Morse};

    /// Rounding of the sums that are compared: some 40 forces of ten times the unit.
    const ROUNDING: f64 = 1e-13;

    fn materials() -> Vec<Material> {
        let lennard_jones = |epsilon: f64, sigma: f64, cutoff: f64, at_cutoff: AtCutoff| {
            let shape = LennardJones { epsilon, sigma };
            Interaction::LennardJones(CutPotential::new(shape, cutoff, at_cutoff))
        };
        let morse = Morse {
            depth: 1.0,
            decay: 5.0,
            distance: 1.1,
        };
        let harmonic = HarmonicBond {
            stiffness: 60.0,
            distance: 1.1,
        };
        let interactions = [
            lennard_jones(0.415, 0.2277, 0.34, AtCutoff::Truncated),
            lennard_jones(0.415, 0.2277, 0.57, AtCutoff::Shifted),
            lennard_jones(1e3, 2.0, 3.8, AtCutoff::Smooth { from: 3.0 }),
            Interaction::Morse(CutPotential::new(morse, 2.0, AtCutoff::Smooth { from: 1.5 })),
            Interaction::HarmonicBond(CutPotential::new(harmonic, 1.4, AtCutoff::Truncated)),
        ];
        interactions
            .map(|interaction| Material::new(interaction, 1.0).expect("the potential binds"))
            .to_vec()
    }

    #[test]
    fn four_points_are_all_bonds_within_the_promised_error_wherever_strings_are_regular_and_hardly_bent() {
        const FINER: u32 = 4;
        for material in materials() {
            let limit = IntactLimit::new(&material, triangular::next_length(Forces::listed(&material)));
            let certificate = Certificate {
                material: &material,
                regular: limit.untouched.expect("regular bonds are not near the cutoff"),
            };
            let [least, most] = certificate.regular.lengths();
            for count in 6..=40 {
                let (rule, bend) = certificate.few(count).expect("four places are fewer");
                assert!(bend > 4e-3, "{count} bonds of {material:?}: {bend}");
                let mut worst = 0.0f64;
                for length in 0..=FINER * LENGTHS {
                    let length = least + (most - least) * f64::from(length) / f64::from(FINER * LENGTHS);
                    for angle in 0..=FINER * ANGLES {
                        let angle = std::f64::consts::FRAC_PI_2 * f64::from(angle) / f64::from(FINER * ANGLES);
                        for share in [1.0, 0.97, 0.7] {
                            worst = worst.max(certificate.error(&rule, count, length, [share * bend, angle]));
                        }
                    }
                }
                assert!(worst < ERROR + ROUNDING, "{count} bonds of {material:?}: {worst:e}");
            }
        }
    }

    #[test]
    fn a_string_that_is_bent_more_is_not_summed_that_well() {
        let material = materials()[0];
        let limit = IntactLimit::new(&material, triangular::next_length(Forces::listed(&material)));
        let certificate = Certificate {
            material: &material,
            regular: limit.untouched.expect("regular bonds are not near the cutoff"),
        };
        let (rule, bend) = certificate.few(10).expect("four places are fewer");
        let [least, _] = certificate.regular.lengths();
        let error = certificate.error(&rule, 10, least, [2.0 * bend, 0.0]);
        assert!(error > ERROR, "{error:e}");
        assert!(certificate.few(5).is_none());
    }
}
