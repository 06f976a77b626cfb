use super::PairShape;

/// phi(r) = stiffness/2 (r - distance)^2 up to the cutoff, where the bond snaps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HarmonicBond {
    /// eV/nm^2
    pub stiffness: f64,
    /// nm
    pub distance: f64,
}

impl PairShape for HarmonicBond {
    #[inline(always)]
    fn energy_and_slope(&self, squared_distance: f64) -> (f64, f64) {
        let distance = squared_distance.sqrt();
        let stretch = distance - self.distance;
        (
            0.5 * self.stiffness * stretch * stretch,
            self.stiffness * stretch / distance,
        )
    }

    fn curvature(&self, _distance: f64) -> f64 {
        self.stiffness
    }

    fn minimum(&self) -> f64 {
        self.distance
    }
}
