//! What a lattice and a potential make together: spacing at zero pressure, elastic constants, wave speeds, surfaces.

mod cubic;
mod elasticity;
mod release;
mod spacing;

pub use cubic::Cubic;
pub use elasticity::{Elasticity, WaveSpeeds};
use spacing::zero_pressure_spacing;

use crate::lattice::{fcc, triangular};
use crate::potential::Interaction;

/// A crystal at rest and without pressure. Any consistent units; the program uses nm, ps, eV.
#[derive(Clone, Copy, Debug)]
pub struct Material {
    pub interaction: Interaction,
    /// Lattice spacing r0.
    pub spacing: f64,
    /// Mass of one site, energy time^2 / length^2.
    pub site_mass: f64,
}

impl Material {
    /// The triangular crystal of this potential in its zero-pressure state; `None` where the potential holds none together.
    pub fn new(interaction: Interaction, site_mass: f64) -> Option<Self> {
        Self::of_shells(interaction, site_mass, |radius| {
            let bonds = triangular::half_vectors_within(radius).into_iter();
            bonds.map(|bond| f64::from(triangular::squared_length(bond))).collect()
        })
    }

    /// The same of the face-centred cubic crystal, whose constants are those of [`Cubic`].
    pub fn face_centred_cubic(interaction: Interaction, site_mass: f64) -> Option<Self> {
        Self::of_shells(interaction, site_mass, |radius| {
            let bonds = fcc::half_vectors_within(radius).into_iter();
            bonds.map(|bond| f64::from(fcc::squared_length(bond))).collect()
        })
    }

    fn of_shells(interaction: Interaction, site_mass: f64, shells: spacing::Shells) -> Option<Self> {
        let spacing = zero_pressure_spacing(&interaction, shells)?;
        Some(Self {
            interaction,
            spacing,
            site_mass,
        })
    }

    /// Mass per area.
    pub fn density(&self) -> f64 {
        self.site_mass / (triangular::SITE_AREA * self.spacing * self.spacing)
    }

    /// Energy per length to part the crystal along a close-packed row, without relaxation: every bond between the
    /// two halves loses its energy. Under truncation a bond is worth phi(r_c) - phi(r).
    pub fn fracture_energy(&self) -> f64 {
        let jump = self.interaction.jump_at_cutoff();
        let reach = self.interaction.cutoff() / self.spacing;
        let bonds = triangular::half_vectors_within(reach)
            .into_iter()
            .filter(|vector| vector[1] > 0);
        let lost = bonds.map(|vector| {
            let squared = f64::from(triangular::squared_length(vector)) * self.spacing * self.spacing;
            f64::from(vector[1]) * (jump - self.interaction.evaluate(squared).energy)
        });
        lost.sum::<f64>() / self.spacing
    }

    /// Stretch of a bond between nearest neighbours, over its length, from which on it pulls less the longer it is; where that
    /// never comes, the one at which it breaks.
    pub fn critical_strain(&self) -> f64 {
        const LOOKS: i32 = 1000;
        let breaks = self.breaking_length() / self.spacing - 1.0;
        let strains = (1..LOOKS).map(|look| breaks * f64::from(look) / f64::from(LOOKS));
        let softens = |strain: &f64| self.interaction.curvature(self.spacing * (1.0 + strain)) <= 0.0;
        strains.into_iter().find(softens).unwrap_or(breaks)
    }

    /// Distance beyond which a bond between nearest neighbours counts as broken: the cutoff, or where longer ranges
    /// would hide the break, one and a half spacings.
    pub fn breaking_length(&self) -> f64 {
        const FARTHEST_BREAK: f64 = 1.5;
        self.interaction.cutoff().min(FARTHEST_BREAK * self.spacing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::potential::{AtCutoff, CutPotential, LennardJones};

    pub(crate) fn lennard_jones(cutoff: f64) -> Material {
        let shape = LennardJones {
            epsilon: 1.0,
            sigma: 1.0,
        };
        let law = CutPotential::new(shape, cutoff, AtCutoff::Truncated);
        Material::new(Interaction::LennardJones(law), 1.0).expect("Lennard-Jones has a zero-pressure lattice")
    }

    /// The references are printed with four to six digits.
    const PRINTED_DIGITS: f64 = 6e-5;

    #[test]
    fn spacing_moduli_speeds_and_surface_energy_are_the_references_of_each_cutoff() {
        // cutoff, spacing, C11, C12, E, c_L, c_T, c_R, fracture energy of a row (with jump at the cutoff removed)
        let references = [
            (1.5, 1.122462, 74.235, 24.745, 65.987, 9.0, 5.1962, 4.7774),
            (2.0, 1.115934, 80.662, 26.887, 71.700, 9.3269, 5.3849, 4.9509),
            (2.5, 1.113201, 83.499, 27.833, 74.222, 9.4663, 5.4654, 5.0249),
        ];
        for (cutoff, spacing, c11, c12, young, c_l, c_t, c_r) in references {
            let material = lennard_jones(cutoff);
            let elasticity = Elasticity::of(&material);
            let speeds = WaveSpeeds::of(&material);
            let pairs = [
                (material.spacing, spacing),
                (elasticity.c11, c11),
                (elasticity.c12, c12),
                (elasticity.c66, c12),
                (elasticity.young_modulus(), young),
                (speeds.longitudinal, c_l),
                (speeds.transverse, c_t),
                (speeds.rayleigh, c_r),
            ];
            for (found, expected) in pairs {
                assert!(
                    (found / expected - 1.0).abs() < PRINTED_DIGITS,
                    "cutoff {cutoff}: {found} for {expected}"
                );
            }
        }
    }

    #[test]
    fn nearest_neighbour_wave_speeds_are_9_and_root_27_exactly() {
        let speeds = WaveSpeeds::of(&lennard_jones(1.5));
        assert!((speeds.longitudinal - 9.0).abs() < 1e-12);
        assert!((speeds.transverse - 27f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_bond_is_broken_at_the_cutoff_or_else_one_and_a_half_spacings_apart() {
        // The spacings printed above.
        for (cutoff, expected) in [(1.5, 1.5), (2.0, 1.5 * 1.115934), (2.5, 1.5 * 1.113201)] {
            let found = lennard_jones(cutoff).breaking_length();
            assert!((found / expected - 1.0).abs() < PRINTED_DIGITS, "{found} at {cutoff}");
        }
    }

    #[test]
    fn a_bond_of_lennard_jones_pulls_hardest_at_its_inflection() {
        // phi'' = 0 at r/sigma = (26/7)^(1/6); one look in a thousand on the way to the cutoff.
        const LOOK: f64 = 4e-4;
        let material = lennard_jones(1.5);
        let expected = (26.0_f64 / 7.0).powf(1.0 / 6.0) / material.spacing - 1.0;
        assert!((material.critical_strain() - expected).abs() < LOOK);
        let harmonic = crate::potential::HarmonicBond {
            stiffness: 1.0,
            distance: 1.0,
        };
        let law = CutPotential::new(harmonic, 1.2, AtCutoff::Truncated);
        let snaps = Material::new(Interaction::HarmonicBond(law), 1.0).unwrap();
        assert!((snaps.critical_strain() - 0.2).abs() < LOOK);
    }

    #[test]
    fn central_forces_give_a_triangular_sheet_a_poisson_ratio_of_a_third_at_any_range() {
        for cutoff in [1.5, 2.0, 2.5, 4.0] {
            let ratio = Elasticity::of(&lennard_jones(cutoff)).poisson_ratio();
            assert!((ratio - 1.0 / 3.0).abs() < 1e-9, "cutoff {cutoff}: {ratio}");
        }
    }

    #[test]
    fn parting_a_row_costs_two_full_wells_a_spacing_unless_truncated() {
        let shape = LennardJones {
            epsilon: 1.0,
            sigma: 1.0,
        };
        let smooth = CutPotential::new(shape, 1.9, AtCutoff::Smooth { from: 1.5 });
        let material = Material::new(Interaction::LennardJones(smooth), 1.0).unwrap();
        assert!((material.fracture_energy() - 1.7818).abs() < PRINTED_DIGITS);
        let truncated = lennard_jones(0.34 / 0.2277);
        assert!((truncated.fracture_energy() / 1.7818 - 0.672).abs() < 5e-4);
    }
}
