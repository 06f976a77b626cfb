use pulp::Simd;

use super::PairShape;
use crate::lanes::Lanes;

/// phi(r) = 4 epsilon ((sigma/r)^12 - (sigma/r)^6), the source's material in chapters 4 to 6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LennardJones {
    /// eV
    pub epsilon: f64,
    /// nm
    pub sigma: f64,
}

impl PairShape for LennardJones {
    #[inline(always)]
    fn energy_and_slope(&self, squared_distance: f64) -> (f64, f64) {
        let inverse = 1.0 / squared_distance;
        let ratio = self.sigma * self.sigma * inverse;
        let sixth = ratio * ratio * ratio;
        let energy = 4.0 * self.epsilon * sixth * (sixth - 1.0);
        let slope = 24.0 * self.epsilon * sixth * (1.0 - 2.0 * sixth) * inverse;
        (energy, slope)
    }

    #[inline(always)]
    fn energies_and_slopes<L: Simd>(&self, simd: L, squared_distances: Lanes<L>) -> [Lanes<L>; 2] {
        let sixth = self.sigma.powi(6);
        let [attraction, repulsion] = [4.0 * self.epsilon * sixth, 4.0 * self.epsilon * sixth * sixth];
        let inverse = squared_distances.inverse();
        let cubed = inverse * inverse * inverse;
        let energies = cubed.times_add(repulsion, Lanes::all(simd, -attraction)) * cubed;
        let slopes = cubed.times_add(-12.0 * repulsion, Lanes::all(simd, 6.0 * attraction)) * (inverse * cubed);
        [energies, slopes]
    }

    #[inline(always)]
    fn curvatures<L: Simd>(&self, simd: L, squared_distances: Lanes<L>) -> Lanes<L> {
        let sixth = self.sigma.powi(6);
        let [attraction, repulsion] = [4.0 * self.epsilon * sixth, 4.0 * self.epsilon * sixth * sixth];
        let inverse = squared_distances.inverse();
        let cubed = inverse * inverse * inverse;
        cubed.times_add(156.0 * repulsion, Lanes::all(simd, -42.0 * attraction)) * (inverse * cubed)
    }

    fn curvature(&self, distance: f64) -> f64 {
        let inverse = 1.0 / (distance * distance);
        let ratio = self.sigma * self.sigma * inverse;
        let sixth = ratio * ratio * ratio;
        24.0 * self.epsilon * sixth * (26.0 * sixth - 7.0) * inverse
    }

    fn minimum(&self) -> f64 {
        2f64.powf(1.0 / 6.0) * self.sigma
    }
}
