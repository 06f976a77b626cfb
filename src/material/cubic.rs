use nalgebra::{Matrix3, SymmetricEigen};

use super::Material;
use crate::lattice::fcc;

/// Constants of a face-centred cubic crystal, along the edges of its cube; the program uses nm, ps, eV.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cubic {
    /// Elastic constants, energy per volume.
    pub c11: f64,
    pub c12: f64,
    pub c44: f64,
    /// Mass per volume.
    pub density: f64,
}

impl Cubic {
    /// Lattice sums over the bonds of the zero-pressure crystal,
    /// C_ijkl = (1/V) sum over half the bonds of (phi'' - phi'/r) b_i b_j b_k b_l / r^2; the pressure terms vanish.
    pub fn of(material: &Material) -> Self {
        let spacing = material.spacing;
        let volume = site_volume(spacing);
        let mut constants = Self {
            c11: 0.0,
            c12: 0.0,
            c44: 0.0,
            density: material.site_mass / volume,
        };
        for bond in fcc::half_vectors_within(material.interaction.cutoff() / spacing) {
            // One of the three equal terms of each constant would do for a whole shell; bonds come by halves of shells.
            let [x, y, z] = fcc::in_the_cube(bond).map(|component| (component * spacing) * (component * spacing));
            let squared = x + y + z;
            let slope = material.interaction.evaluate(squared).slope;
            let stiffness = (material.interaction.curvature(squared.sqrt()) - slope) / (squared * volume);
            constants.c11 += stiffness * (x * x + y * y + z * z) / 3.0;
            constants.c12 += stiffness * (x * y + y * z + x * z) / 3.0;
        }
        constants.c44 = constants.c12;
        constants
    }

    /// Speeds of long waves along a direction given in the cube, slowest first: the roots of Christoffel's equation.
    pub fn wave_speeds(&self, direction: [f64; 3]) -> [f64; 3] {
        let length = direction
            .iter()
            .map(|component| component * component)
            .sum::<f64>()
            .sqrt();
        let n = direction.map(|component| component / length);
        let christoffel = Matrix3::from_fn(|row, column| match row == column {
            true => self.c44 + (self.c11 - self.c44) * n[row] * n[row],
            false => (self.c12 + self.c44) * n[row] * n[column],
        });
        let mut speeds: [f64; 3] = SymmetricEigen::new(christoffel).eigenvalues.into();
        speeds.sort_unstable_by(f64::total_cmp);
        speeds.map(|stiffness| (stiffness / self.density).sqrt())
    }

    /// Young's modulus of a bar along a direction given in the cube that is free to contract.
    pub fn young_modulus(&self, direction: [f64; 3]) -> f64 {
        let squares = direction.map(|component| component * component);
        let sum: f64 = squares.iter().sum();
        let mixed = (squares[0] * squares[1] + squares[1] * squares[2] + squares[0] * squares[2]) / (sum * sum);
        let determinant = (self.c11 - self.c12) * (self.c11 + 2.0 * self.c12);
        let [s11, s12] = [(self.c11 + self.c12) / determinant, -self.c12 / determinant];
        1.0 / (s11 - 2.0 * (s11 - s12 - 0.5 / self.c44) * mixed)
    }

    /// Energy per area to part the crystal along a plane, given by its normal in the cube, without relaxation: every bond
    /// between the two halves loses its energy. Under truncation a bond is worth phi(r_c) - phi(r).
    pub fn parting_energy(material: &Material, normal: [f64; 3]) -> f64 {
        let length = normal.iter().map(|component| component * component).sum::<f64>().sqrt();
        let spacing = material.spacing;
        let jump = material.interaction.jump_at_cutoff();
        let lost = fcc::half_vectors_within(material.interaction.cutoff() / spacing)
            .into_iter()
            .map(|bond| {
                let vector = fcc::in_the_cube(bond).map(|component| component * spacing);
                let through: f64 = vector
                    .iter()
                    .zip(normal)
                    .map(|(vector, normal)| vector * normal / length)
                    .sum();
                let squared: f64 = vector.iter().map(|component| component * component).sum();
                through.abs() * (jump - material.interaction.evaluate(squared).energy)
            });
        lost.sum::<f64>() / site_volume(spacing)
    }
}

fn site_volume(spacing: f64) -> f64 {
    fcc::SITE_VOLUME * spacing * spacing * spacing
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::potential::{AtCutoff, CutPotential, Interaction, LennardJones};

    /// The references of longer cutoffs are printed with three to five digits.
    const PRINTED_DIGITS: f64 = 2e-4;

    fn lennard_jones(cutoff: f64, at_cutoff: AtCutoff) -> Material {
        let shape = LennardJones {
            epsilon: 1.0,
            sigma: 1.0,
        };
        let law = CutPotential::new(shape, cutoff, at_cutoff);
        Material::face_centred_cubic(Interaction::LennardJones(law), 1.0)
            .expect("Lennard-Jones holds a crystal together")
    }

    #[test]
    fn nearest_neighbours_alone_give_72_36_and_36_and_density_1() {
        // Closed forms of the nearest-neighbour crystal in reduced units: C11 = 2 C12 = 2 C44 = 72, E of [100] = 48.
        let material = lennard_jones(1.5, AtCutoff::Truncated);
        let constants = Cubic::of(&material);
        let Cubic { c11, c12, c44, density } = constants;
        let pairs = [(c11, 72.0), (c12, 36.0), (c44, 36.0), (density, 1.0)];
        pairs
            .into_iter()
            .for_each(|(found, expected)| assert!((found / expected - 1.0).abs() < 1e-12, "{found}"));
        assert!((material.spacing - 2f64.powf(1.0 / 6.0)).abs() < 1e-14);
        let along = |direction| constants.wave_speeds(direction);
        let expected = [
            ([1.0, 0.0, 0.0], [6.0, 6.0, 72f64.sqrt()]),
            ([1.0, 1.0, 0.0], [18f64.sqrt(), 6.0, 90f64.sqrt()]),
            ([1.0, 1.0, 1.0], [24f64.sqrt(), 24f64.sqrt(), 96f64.sqrt()]),
        ];
        for (direction, speeds) in expected {
            along(direction)
                .iter()
                .zip(speeds)
                .for_each(|(found, speed)| assert!((found - speed).abs() < 1e-12));
        }
        assert!((constants.young_modulus([1.0, 0.0, 0.0]) - 48.0).abs() < 1e-12);
    }

    #[test]
    fn two_and_a_half_sigma_gives_the_references() {
        let material = lennard_jones(2.5, AtCutoff::Truncated);
        let Cubic { c11, c12, c44, density } = Cubic::of(&material);
        let pairs = [
            (material.spacing, 1.095735),
            (c11, 97.712),
            (c12, 55.627),
            (c44, 55.627),
            (density, 1.07497),
        ];
        for (found, expected) in pairs {
            assert!(
                (found / expected - 1.0).abs() < PRINTED_DIGITS,
                "{found} for {expected}"
            );
        }
    }

    #[test]
    fn parting_the_crystal_costs_its_bonds() {
        // 2 gamma of (111), (100) and (110). With nearest neighbours a bond is worth one well: 3 bonds a site of the (111)
        // plane, whose area is sqrt(3)/2 r0^2, and so on: a closed form.
        let smooth = lennard_jones(1.5, AtCutoff::Smooth { from: 1.4 });
        let square = smooth.spacing * smooth.spacing;
        let planes = [
            ([1.0, 1.0, 1.0], 3.0 / (0.75f64.sqrt() * square)),
            ([1.0, 0.0, 0.0], 4.0 / square),
            ([1.0, 1.0, 0.0], 6.0 / (2f64.sqrt() * square)),
        ];
        for (normal, expected) in planes {
            assert!((Cubic::parting_energy(&smooth, normal) / expected - 1.0).abs() < 1e-8);
        }
    }
}
