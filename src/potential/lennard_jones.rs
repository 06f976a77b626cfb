use super::PairShape;

/// phi(r) = 4 epsilon ((sigma/r)^12 - (sigma/r)^6), the source's material in chapters 4 to 6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LennardJones {
    pub epsilon: f64,
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
