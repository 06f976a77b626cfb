//! From the internal units to those of tables and figures. [CODATA 2018]

/// 1 eV/nm^3 in GPa.
pub const GIGAPASCAL: f64 = 0.160_217_663_4;

/// 1 eV/nm^3 in MJ/m^3.
pub const MEGAJOULE_A_CUBIC_METRE: f64 = 160.217_663_4;

/// 1 eV/nm^2.5 in MPa sqrt(m): 160.2176634 MPa times sqrt(1e-9 m).
pub const MEGAPASCAL_ROOT_METRE: f64 = 160.217_663_4 * 3.162_277_660_168_379_4e-5;

/// 1 nm/ps in m/s.
pub const METRE_PER_SECOND: f64 = 1000.0;

pub const PERCENT: f64 = 100.0;
