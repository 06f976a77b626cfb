//! What a run of a solid leaves behind, column by column. Internal units.

/// All columns have one entry a probe.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// ps
    pub time: Vec<f64>,
    /// Nominal strain; not a number where the loading makes none.
    pub strain: Vec<f64>,
    /// Mean stress xx, yy, zz, yz, xz, xy, eV/nm^3.
    pub stress: Vec<[f64; 6]>,
    /// eV
    pub kinetic: Vec<f64>,
    pub potential: Vec<f64>,
    pub work: Vec<f64>,
    /// Energy gained where pairs crossed the cutoff, eV.
    pub release: Vec<f64>,
    /// Of the loading on the solid, eV/nm.
    pub force: Vec<[f64; 3]>,
    /// Bonds longer than the cutoff.
    pub broken: Vec<f64>,
    /// Of the atoms, K; not a number where there are none.
    pub temperature: Vec<f64>,
    pub gauges: Vec<Gauge>,
}

/// A plane across the solid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Gauge {
    /// From the low face of its axis, nm.
    pub at: f64,
    /// Mean velocity, nm/ps.
    pub velocity: Vec<[f64; 3]>,
    /// Mean stress, eV/nm^3.
    pub stress: Vec<[f64; 6]>,
}

/// Stress in a direction of length 1.
pub fn along(stress: &[f64; 6], [x, y, z]: [f64; 3]) -> f64 {
    let [xx, yy, zz, yz, xz, xy] = *stress;
    xx * x * x + yy * y * y + zz * z * z + 2.0 * (yz * y * z + xz * x * z + xy * x * y)
}

impl Series {
    /// Mean stress in a direction, eV/nm^3.
    pub fn pull(&self, direction: [f64; 3]) -> Vec<f64> {
        self.stress.iter().map(|stress| along(stress, direction)).collect()
    }

    /// Whether the loading makes a nominal strain.
    pub fn has_strain(&self) -> bool {
        self.strain.iter().any(|strain| strain.is_finite())
    }

    /// What to draw over: strain in percent, or time.
    pub fn over(&self) -> Vec<f64> {
        match self.has_strain() {
            true => self.strain.iter().map(|strain| 100.0 * strain).collect(),
            false => self.time.clone(),
        }
    }
}
