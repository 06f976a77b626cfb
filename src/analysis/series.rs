//! What a run leaves behind for the analysis: rows of probes, profiles along the crack plane, bond events.

/// The time series of one case. All quantities in internal units (nm, ps, eV).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    pub probes: Vec<Probe>,
    /// Centres of the bins of every profile along the crack plane, x in nm from the left edge (reference configuration).
    pub profile_x: Vec<f64>,
    /// One profile a probe: `[sigma_xx, sigma_yy, sigma_xy]` in eV/nm^3 a bin; length `probes.len() * profile_x.len()`, probe-major.
    pub profiles: Vec<[f64; 3]>,
    /// Traction x, y across the crack plane in the same bins, eV/nm^3; empty in runs of older versions.
    pub tractions: Vec<[f64; 2]>,
    /// Where the wave gauges stand, nm from the left edge and from the crack plane.
    pub gauge_places: Vec<[f64; 2]>,
    /// Mean velocity x, y (nm/ps) and stress xx, yy, xy (eV/nm^3) of every gauge; probe-major as `profiles`.
    pub gauges: Vec<[f64; 5]>,
    /// Bonds that broke or healed since the probe before, in order of time.
    pub bonds: Vec<BondEvent>,
}

impl Series {
    /// Area under the average stress across the crack plane over the strain, eV/nm^3, by trapezoids: the work that parts the
    /// specimen, a volume. `None` with fewer than two probes.
    pub fn work_density(&self) -> Option<f64> {
        let strip = |ends: &[Probe]| 0.5 * (ends[0].sigma_yy + ends[1].sigma_yy) * (ends[1].strain - ends[0].strain);
        (self.probes.len() > 1).then(|| self.probes.windows(2).map(strip).sum())
    }
}

/// One row of the time series.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Probe {
    pub step: u64,
    /// ps
    pub time: f64,
    /// Nominal strain.
    pub strain: f64,
    /// Average virial stress of everything between the grips, eV/nm^3.
    pub sigma_xx: f64,
    pub sigma_yy: f64,
    pub sigma_xy: f64,
    /// Force of the grips on the specimen over its cross-section, eV/nm^3.
    pub grip_stress: f64,
    /// eV; potential relative to the start of the run, kinetic in full.
    pub kinetic: f64,
    pub potential: f64,
    /// Work of the grips since the start, less what sponges and damping took out, eV.
    pub work: f64,
    /// Energy gained where pairs crossed the cutoff since the start, eV.
    pub cutoff_release: f64,
    /// Energy that the specimen has gained where its mesh was refined, eV; NaN in runs of older versions, as the next two.
    pub refined_energy: f64,
    /// How many nodes the mesh has.
    pub nodes: f64,
    /// How many interfaces between triangles have opened in a mesh that is refined on the way: the crack was there first.
    pub outruns: f64,
    /// Kinetic temperature of the atomic regions, K; NaN where there are none.
    pub temperature: f64,
    /// J-integral in each of the rings around the tip, from the innermost on, eV/nm; NaN where there are none.
    pub j_integral: [f64; RINGS],
}

/// Rings around the tip over each of which the J-integral is taken.
pub const RINGS: usize = 3;

/// A nearest-neighbour bond of the reference lattice that broke (or closed again) between two probes.
///
/// The bond joins site (column, row) to its neighbour in `direction`: 0 is (1, 0), 1 is (0, 1), 2 is (-1, 1) in
/// lattice coordinates, where site (i, j) stands at x = (i + j/2) r0, y = j sqrt(3)/2 r0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BondEvent {
    /// Index of the probe at which the change was seen.
    pub probe: u32,
    pub column: i32,
    pub row: i32,
    pub direction: u8,
    /// `false`: the bond closed again.
    pub broken: bool,
}

/// Where a crack comes from, and so from where its length is measured. nm from the left edge.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum CrackFrom {
    /// The left edge.
    #[default]
    Left,
    /// The right edge, which is here; the crack runs left.
    Right { edge: f64 },
    /// The middle of a notch that reaches no edge; of its two tips the one that runs right is followed.
    Inside { center: f64 },
}

/// What the analysis must know of the specimen and the material besides the series. Internal units.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Lattice spacing r0, nm.
    pub spacing: f64,
    /// Specimen length (x), as built, nm. The left edge of the specimen is x = 0 = lattice x - `left_x`.
    pub length: f64,
    /// Lattice x of the specimen's left edge, nm.
    pub left_x: f64,
    /// Height between the inner edges of the grips, nm.
    pub height: f64,
    /// The crack is cut between lattice rows `crack_row - 1` and `crack_row`; `None`: no crack.
    pub crack_row: Option<i32>,
    pub crack_from: CrackFrom,
    /// From where the crack is measured, its edge or its middle, to the end of the cut, nm.
    pub crack_length: f64,
    /// Strain rate, 1/ps.
    pub strain_rate: f64,
    /// 2D thickness, nm.
    pub thickness: f64,
    /// Longitudinal, transverse and Rayleigh wave speed of this lattice and cutoff, nm/ps.
    pub longitudinal_speed: f64,
    pub transverse_speed: f64,
    pub rayleigh_speed: f64,
    /// Young's modulus (2D, plane, force per length), eV/nm^2, and Poisson's ratio (2D).
    pub young_modulus: f64,
    pub poisson_ratio: f64,
    /// Energy to make two new surfaces along a close-packed row, per length, eV/nm.
    pub fracture_energy: f64,
    /// Atoms an edge of the elements along the crack plane (1: atoms).
    pub element_at_crack: u32,
    pub nodes: u64,
    pub elements: u64,
    pub represented_atoms: u64,
}

impl Setting {
    /// Both ends of the notch, nm from the left edge.
    pub fn notch(&self) -> [f64; 2] {
        let length = self.crack_length;
        match self.crack_from {
            CrackFrom::Left => [0.0, length],
            CrackFrom::Right { edge } => [edge - length, edge],
            CrackFrom::Inside { center } => [center - length, center + length],
        }
    }

    /// Whether the notch reaches no edge.
    pub fn is_crack_inside(&self) -> bool {
        matches!(self.crack_from, CrackFrom::Inside { .. })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_work_is_the_area_under_the_curve() {
        let probe = |(strain, sigma_yy): (f64, f64)| Probe {
            strain,
            sigma_yy,
            ..Probe::default()
        };
        let series = |points: &[(f64, f64)]| Series {
            probes: points.iter().copied().map(probe).collect(),
            ..Series::default()
        };
        // A triangle of base 0.03 and height 4, whose sides are straight between the probes.
        let triangle = series(&[(0.0, 0.0), (0.01, 2.0), (0.02, 4.0), (0.03, 0.0)]);
        assert!((triangle.work_density().unwrap() - 0.06).abs() < 1e-15);
        assert_eq!(series(&[(0.0, 1.0)]).work_density(), None);
    }
}
