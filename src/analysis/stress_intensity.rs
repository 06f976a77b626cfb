//! Stress intensity factors, internal units eV/nm^2.5 (a stress in eV/nm^3 times the root of a length in nm).

pub mod handbook;
mod refusal;

pub use refusal::Refusal;

use std::f64::consts::PI;

use super::crack::Tip;
use super::regression;
use super::series::{Series, Setting};

/// The fit, and the innermost ring of the J-integral, begin this many spacings, and this many element edges, ahead of the tip:
/// nearer, the lattice and the linear elements do not follow the singular field.
pub const FROM_SPACINGS: f64 = 4.0;
pub const FROM_ELEMENTS: f64 = 1.0;

/// The fit ends at this share of the crack length (half of it where the notch is inside), the ligament or the height, whichever
/// is smallest.
pub const TO_SHARE: f64 = 1.0 / 3.0;

/// A tip farther than this, and than an element edge, from the plane of the profile has kinked: the first edge that a
/// coarse mesh opens may lead off the plane, and is still within what the fit and the rings leave out.
pub const OFF_PLANE_SPACINGS: f64 = 2.0;

/// Bins that a fit of two numbers with an error must have.
pub const LEAST_BINS: usize = 3;

/// A fit whose standard error is a larger share of K than this is refused: good ones have 1 %, poor ones 6 % and more.
pub const MOST_ERROR_SHARE: f64 = 0.05;

/// A fit is refused when its correction `c r` at the end of the range is larger than this: then most of the stress that is
/// fitted is not that of the tip. On a field of one crack it is about 1.
pub const MOST_CORRECTION: f64 = 1.25;

/// J is refused when half of what lies between its smallest and largest ring is a larger share of the mean than this.
pub const MOST_RING_SHARE: f64 = 0.1;

/// J is refused when its K is lower than this share of Griffith's: a crack that sets out gets at least what its surfaces
/// cost, and the rings know J to some percent.
pub const LEAST_GRIFFITH_SHARE: f64 = 0.97;

/// The largest radius of the rings of the J-integral in spacings, and in edges of the elements at the crack: what is
/// larger costs more and tells the same.
pub const RING_SPACINGS: f64 = 30.0;
pub const RING_ELEMENTS: f64 = 6.0;

/// How much of the distance to the nearest edge or grip the rings may take.
pub const RING_CLEAR_SHARE: f64 = 0.9;

/// Whether a tip is so near to the crack plane that the field around it is that of a crack along the plane.
pub fn on_plane(tip: Tip, setting: &Setting) -> bool {
    let edge = f64::from(setting.element_at_crack);
    tip.y.abs() <= OFF_PLANE_SPACINGS.max(edge) * setting.spacing
}

/// Result of the fit `sigma_yy sqrt(2 pi r) = K (1 + c r)` ahead of the tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearTip {
    pub value: f64,
    /// Standard error of K in the fit alone: how the stress scatters about it, not how well the definition holds.
    pub error: f64,
    /// Range of r, nm.
    pub from: f64,
    pub to: f64,
    pub bins: usize,
}

/// K from the profile of one probe, or why there is none.
pub fn near_tip(series: &Series, probe: usize, tip: Tip, setting: &Setting) -> Result<NearTip, Refusal> {
    if !on_plane(tip, setting) {
        return Err(Refusal::OffPlane);
    }
    let tip = tip.x;
    let from = setting.spacing * FROM_SPACINGS.max(FROM_ELEMENTS * f64::from(setting.element_at_crack));
    let to = TO_SHARE * tip.min(setting.length - tip).min(setting.height);
    let points: Vec<(f64, f64)> = ahead(series, probe, tip)
        .filter(|bin| (from..=to).contains(&bin.distance) && bin.stress[1].is_finite())
        .map(|bin| (bin.distance, bin.stress[1] * (2.0 * PI * bin.distance).sqrt()))
        .collect();
    if points.len() < LEAST_BINS {
        return Err(Refusal::FewBins);
    }
    let fit = regression::line(&points).ok_or(Refusal::FewBins)?;
    if fit.intercept <= 0.0 {
        return Err(Refusal::NotPositive);
    }
    if fit.intercept_error > MOST_ERROR_SHARE * fit.intercept {
        return Err(Refusal::LargeError);
    }
    if (fit.slope * to).abs() > MOST_CORRECTION * fit.intercept {
        return Err(Refusal::SmallRange);
    }
    Ok(NearTip {
        value: fit.intercept,
        error: fit.intercept_error,
        from,
        to,
        bins: points.len(),
    })
}

/// K of the J-integral, from all rings around the tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FromJ {
    /// Mean of the rings.
    pub value: f64,
    /// Agreement of the rings, half of what lies between the smallest and the largest: no uncertainty of K, because waves
    /// that pass the tip move all rings alike.
    pub spread: f64,
}

/// K = sqrt(E J) of one probe, per thickness, or why there is none.
pub fn from_j(series: &Series, probe: usize, setting: &Setting) -> Result<FromJ, Refusal> {
    let rings = series.probes.get(probe).ok_or(Refusal::NoRings)?.j_integral;
    if !rings.iter().all(|j| j.is_finite()) {
        return Err(Refusal::NoRings);
    }
    if !rings.iter().all(|j| *j > 0.0) {
        return Err(Refusal::Outflow);
    }
    let rings = rings.map(|j| (setting.young_modulus * j).sqrt() / setting.thickness);
    let [low, high] = [
        rings.iter().copied().fold(f64::INFINITY, f64::min),
        rings.iter().copied().fold(0.0, f64::max),
    ];
    let value = rings.iter().sum::<f64>() / rings.len() as f64;
    let spread = 0.5 * (high - low);
    if spread > MOST_RING_SHARE * value {
        return Err(Refusal::UnlikeRings);
    }
    if value < LEAST_GRIFFITH_SHARE * griffith(setting) {
        return Err(Refusal::BelowGriffith);
    }
    Ok(FromJ { value, spread })
}

/// Griffith's K: the energy that the elastic field gives up pays for the two new surfaces, sqrt(2 gamma E), per
/// thickness.
pub fn griffith(setting: &Setting) -> f64 {
    (setting.fracture_energy * setting.young_modulus).sqrt() / setting.thickness
}

/// One bin of a profile ahead of the tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ahead {
    /// ps
    pub time: f64,
    /// From the tip, nm.
    pub distance: f64,
    /// Virial stress xx, yy, xy and traction x, y across the crack plane, eV/nm^3; runs of older versions have no traction.
    pub stress: [f64; 3],
    pub traction: Option<[f64; 2]>,
}

/// The profile of one probe ahead of a tip at x.
pub fn ahead(series: &Series, probe: usize, tip: f64) -> impl Iterator<Item = Ahead> {
    let bins = series.profile_x.len();
    let row = probe * bins..(probe + 1) * bins;
    let stresses = series.profiles.get(row.clone()).unwrap_or_default();
    let tractions = series.tractions.get(row).unwrap_or_default();
    let places = series.profile_x.iter().zip(stresses).enumerate();
    let time = series.probes[probe].time;
    places
        .map(move |(bin, (x, stress))| Ahead {
            time,
            distance: x - tip,
            stress: *stress,
            traction: tractions.get(bin).copied(),
        })
        .filter(|bin| bin.distance > 0.0)
}
