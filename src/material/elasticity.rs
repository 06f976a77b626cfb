use super::Material;
use crate::lattice::triangular;

/// Linear elastic constants of the crystal (2D: force per length), eV/nm^2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elasticity {
    pub c11: f64,
    pub c12: f64,
    pub c66: f64,
}

impl Elasticity {
    /// Lattice sums over the bonds of the zero-pressure crystal,
    /// C_ijkl = (1/A) sum over half the bonds of (phi'' - phi'/r) b_i b_j b_k b_l / r^2; the pressure terms vanish.
    pub fn of(material: &Material) -> Self {
        let spacing = material.spacing;
        let area = triangular::SITE_AREA * spacing * spacing;
        let mut constants = Self {
            c11: 0.0,
            c12: 0.0,
            c66: 0.0,
        };
        for bond in triangular::half_vectors_within(material.interaction.cutoff() / spacing) {
            let [x, y] = triangular::position(bond).map(|component| component * spacing);
            let squared = x * x + y * y;
            let slope = material.interaction.evaluate(squared).slope;
            let stiffness = (material.interaction.curvature(squared.sqrt()) - slope) / (squared * area);
            constants.c11 += stiffness * x * x * x * x;
            constants.c12 += stiffness * x * x * y * y;
            constants.c66 += stiffness * x * x * y * y;
        }
        constants
    }

    /// Young's modulus of the sheet.
    pub fn young_modulus(&self) -> f64 {
        (self.c11 * self.c11 - self.c12 * self.c12) / self.c11
    }

    /// Poisson's ratio of the sheet; 1/3 for central forces.
    pub fn poisson_ratio(&self) -> f64 {
        self.c12 / self.c11
    }
}

/// Speeds of long waves, nm/ps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaveSpeeds {
    pub longitudinal: f64,
    pub transverse: f64,
    pub rayleigh: f64,
}

impl WaveSpeeds {
    pub fn of(material: &Material) -> Self {
        let constants = Elasticity::of(material);
        let longitudinal = (constants.c11 / material.density()).sqrt();
        let transverse = (constants.c66 / material.density()).sqrt();
        Self {
            longitudinal,
            transverse,
            rayleigh: rayleigh_speed(longitudinal, transverse),
        }
    }
}

/// Root of (2 - x^2)^2 = 4 sqrt(1 - x^2) sqrt(1 - x^2 c_T^2/c_L^2), x = c_R/c_T: the surface wave of an isotropic solid.
fn rayleigh_speed(longitudinal: f64, transverse: f64) -> f64 {
    let ratio = (transverse / longitudinal) * (transverse / longitudinal);
    let excess = |x: f64| {
        let squared = x * x;
        (2.0 - squared) * (2.0 - squared) - 4.0 * ((1.0 - squared) * (1.0 - squared * ratio)).sqrt()
    };
    let [mut low, mut high] = [0.5, 1.0 - 1e-12];
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if excess(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high) * transverse
}
