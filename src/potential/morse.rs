use super::PairShape;

/// phi(r) = depth ((1 - exp(-decay (r - distance)))^2 - 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Morse {
    /// eV
    pub depth: f64,
    /// 1/nm
    pub decay: f64,
    /// nm
    pub distance: f64,
}

impl PairShape for Morse {
    #[inline(always)]
    fn energy_and_slope(&self, squared_distance: f64) -> (f64, f64) {
        let distance = squared_distance.sqrt();
        let factor = (-self.decay * (distance - self.distance)).exp();
        let energy = self.depth * factor * (factor - 2.0);
        let slope = 2.0 * self.depth * self.decay * factor * (1.0 - factor) / distance;
        (energy, slope)
    }

    fn curvature(&self, distance: f64) -> f64 {
        let factor = (-self.decay * (distance - self.distance)).exp();
        2.0 * self.depth * self.decay * self.decay * factor * (2.0 * factor - 1.0)
    }

    fn minimum(&self) -> f64 {
        self.distance
    }
}
