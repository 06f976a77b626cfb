//! What energy a crack through a crystal releases for its stress intensity.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};

use super::Cubic;

/// Angles over which the integral is summed: it has a period, so that the error falls as a power of their number.
const ANGLES: u32 = 200;

impl Cubic {
    /// E' in G = K^2/E' of a crack in mode I and plane strain, in the plane of this normal, that runs into a direction at right
    /// angles to it, both given in the cube. Of an isotropic crystal it is E/(1 - nu^2).
    ///
    /// G is half of K^2 times the entry of the normal in the inverse of L, the mean over the angles of Q - R T^-1 R^T with
    /// Q = C n n, R = C n m and T = C m m, n and m at right angles in the plane normal to the front: [Barnett1973].
    pub fn release_modulus(&self, normal: [f64; 3], ahead: [f64; 3]) -> f64 {
        let [y, x] = [normal, ahead].map(|direction| Vector3::from(direction).normalize());
        let mut sum = Matrix3::zeros();
        for angle in 0..ANGLES {
            let (sine, cosine) = (PI * f64::from(angle) / f64::from(ANGLES)).sin_cos();
            let [n, m] = [x * cosine + y * sine, y * cosine - x * sine];
            let [q, r, t] = [[n, n], [n, m], [m, m]].map(|[one, other]| self.contracted(one, other));
            let inverse = t.try_inverse().expect("a crystal at rest resists every shift");
            sum += q - r * inverse * r.transpose();
        }
        let inverse = (sum / f64::from(ANGLES))
            .try_inverse()
            .expect("a crystal resists every crack");
        2.0 / y.dot(&(inverse * y))
    }

    /// C_ijkl n_j m_l along the edges of the cube.
    fn contracted(&self, n: Vector3<f64>, m: Vector3<f64>) -> Matrix3<f64> {
        let even = n * m.transpose() * self.c12 + m * n.transpose() * self.c44;
        let along_edges = Matrix3::from_diagonal(&n.component_mul(&m)) * (self.c11 - self.c12 - 2.0 * self.c44);
        even + Matrix3::identity() * (self.c44 * n.dot(&m)) + along_edges
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROUNDING: f64 = 1e-9;

    fn cubic(c11: f64, c12: f64, c44: f64) -> Cubic {
        Cubic {
            c11,
            c12,
            c44,
            density: 1.0,
        }
    }

    #[test]
    fn an_isotropic_crystal_releases_k_squared_over_the_modulus_of_plane_strain() {
        // [Barnett1973]: C44 = (C11 - C12)/2; E = 2.5, nu = 0.25.
        let crystal = cubic(3.0, 1.0, 1.0);
        for (normal, ahead) in [
            ([0.0, 1.0, 0.0], [1.0, 0.0, 0.0]),
            ([1.0, 1.0, 1.0], [1.0, 1.0, -2.0]),
            ([1.0, 0.2, 0.0], [0.0, 0.0, 1.0]),
        ] {
            let found = crystal.release_modulus(normal, ahead);
            assert!((found / (2.5 / (1.0 - 0.0625)) - 1.0).abs() < ROUNDING, "{found}");
        }
    }

    #[test]
    fn along_the_edges_of_the_cube_it_is_the_closed_form_of_orthotropic_bodies() {
        // [Sih1965]: 1/E' = sqrt(b11 b22/2) sqrt(sqrt(b22/b11) + (2 b12 + b66)/(2 b11)), here b11 = b22.
        let crystal = cubic(72.0, 36.0, 36.0);
        let determinant = 36.0 * 144.0;
        let [s11, s12, s44] = [108.0 / determinant, -36.0 / determinant, 1.0 / 36.0];
        let [b11, b12] = [s11 - s12 * s12 / s11, s12 - s12 * s12 / s11];
        let expected = (b11 * b11 / 2.0_f64).sqrt() * (1.0 + (2.0 * b12 + s44) / (2.0 * b11)).sqrt();
        let found = crystal.release_modulus([0.0, 1.0, 0.0], [1.0, 0.0, 0.0]);
        assert!((found * expected - 1.0).abs() < ROUNDING, "{found} {}", 1.0 / expected);
    }

    #[test]
    fn on_a_slip_plane_it_lies_near_the_moduli_of_isotropic_means() {
        // [Barnett1973] for a front along <110> of nearest neighbours, C11 = 2 C12 = 2 C44, beside plane strain of the mean of
        // Voigt.
        const NEAR: f64 = 0.15;
        let crystal = cubic(72.0, 36.0, 36.0);
        let (bulk, shear) = (48.0, 0.2 * 36.0 + 0.6 * 36.0);
        let young = 9.0 * bulk * shear / (3.0 * bulk + shear);
        let ratio = young / (2.0 * shear) - 1.0;
        let found = crystal.release_modulus([1.0, 1.0, 1.0], [1.0, 1.0, -2.0]);
        let expected = young / (1.0 - ratio * ratio);
        assert!((found / expected - 1.0).abs() < NEAR, "{found} {expected}");
        assert!(found > crystal.release_modulus([0.0, 1.0, 0.0], [1.0, 0.0, 0.0]));
    }
}
