//! What a run of a solid leaves behind, column by column. Internal units.

/// All columns have one entry a probe.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Whether the loading prescribes the nominal strain.
    pub is_driven: bool,
    /// ps
    pub time: Vec<f64>,
    /// Nominal strain.
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
    /// Pairs that have left the cutoff since the start, less those that have come within it.
    pub broken: Vec<f64>,
    /// Borders between elements that have parted or slipped since the start.
    pub open_interfaces: Vec<f64>,
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

/// Stress in a direction of length 1; components that it has no part in need not be numbers.
pub fn along(stress: &[f64; 6], [x, y, z]: [f64; 3]) -> f64 {
    let weights = [x * x, y * y, z * z, 2.0 * (y * z), 2.0 * (x * z), 2.0 * (x * y)];
    weighted(stress, &weights)
}

/// Component of a vector in a direction of length 1; the same holds of its components.
pub fn component(vector: &[f64; 3], direction: [f64; 3]) -> f64 {
    weighted(vector, &direction)
}

fn weighted(parts: &[f64], weights: &[f64]) -> f64 {
    let both = parts.iter().zip(weights).filter(|(_, weight)| **weight != 0.0);
    both.map(|(part, weight)| part * weight).sum()
}

impl Series {
    /// Mean stress in a direction, eV/nm^3.
    pub fn pull(&self, direction: [f64; 3]) -> Vec<f64> {
        self.stress.iter().map(|stress| along(stress, direction)).collect()
    }

    /// Nominal strain in percent.
    pub fn percent(&self) -> Vec<f64> {
        self.strain.iter().map(|strain| 100.0 * strain).collect()
    }
}
