//! Stress intensity factors, internal units eV/nm^2.5 (a stress in eV/nm^3 times the root of a length in nm).

pub mod handbook;

use std::f64::consts::PI;

use super::crack::Tip;
use super::regression;
use super::series::{Series, Setting};

/// The fit, and the innermost ring of the J-integral, begin this many spacings, and this many element edges, ahead of the tip: nearer, the lattice and the
/// linear elements do not follow the singular field.
pub const FROM_SPACINGS: f64 = 4.0;
pub const FROM_ELEMENTS: f64 = 1.0;

/// The fit ends at this share of the crack length, the ligament or the height, whichever is smallest.
pub const TO_SHARE: f64 = 1.0 / 3.0;

/// A tip farther than this, and than an element edge, from the plane of the profile has kinked: the first edge that a
/// coarse mesh opens may lead off the plane, and is still within what the fit and the rings leave out.
pub const OFF_PLANE_SPACINGS: f64 = 2.0;

/// Bins that a fit of two numbers with an error must have.
pub const LEAST_BINS: usize = 3;

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
    /// K and its standard error.
    pub value: f64,
    pub error: f64,
    /// Range of r, nm.
    pub from: f64,
    pub to: f64,
    pub bins: usize,
}

/// K from the profile of one probe; `None` where the range holds too few bins, and where the tip has left the plane
/// of the profile, so that the field ahead of it is not the one measured.
pub fn near_tip(series: &Series, probe: usize, tip: Tip, setting: &Setting) -> Option<NearTip> {
    if !on_plane(tip, setting) {
        return None;
    }
    let tip = tip.x;
    let from = setting.spacing * FROM_SPACINGS.max(FROM_ELEMENTS * f64::from(setting.element_at_crack));
    let to = TO_SHARE * tip.min(setting.length - tip).min(setting.height);
    let points: Vec<(f64, f64)> = ahead(series, probe, tip)
        .filter(|(r, stress, _)| (from..=to).contains(r) && stress[1].is_finite())
        .map(|(r, stress, _)| (r, stress[1] * (2.0 * PI * r).sqrt()))
        .collect();
    if points.len() < LEAST_BINS {
        return None;
    }
    let fit = regression::line(&points)?;
    Some(NearTip {
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
    /// Half of what lies between the smallest and the largest.
    pub spread: f64,
}

/// K = sqrt(E J) of one probe, per thickness; `None` without rings, and where waves take more energy out of one of
/// them than flows in.
pub fn from_j(series: &Series, probe: usize, setting: &Setting) -> Option<FromJ> {
    let rings = series.probes.get(probe)?.j_integral;
    if !rings.iter().all(|j| *j > 0.0) {
        return None;
    }
    let rings = rings.map(|j| (setting.young_modulus * j).sqrt() / setting.thickness);
    let [low, high] = [
        rings.iter().copied().fold(f64::INFINITY, f64::min),
        rings.iter().copied().fold(0.0, f64::max),
    ];
    Some(FromJ {
        value: rings.iter().sum::<f64>() / rings.len() as f64,
        spread: 0.5 * (high - low),
    })
}

/// Griffith's K: the energy that the elastic field gives up pays for the two new surfaces, sqrt(2 gamma E), per
/// thickness.
pub fn griffith(setting: &Setting) -> f64 {
    (setting.fracture_energy * setting.young_modulus).sqrt() / setting.thickness
}

/// The profile of one probe ahead of a tip: distance (nm), stress xx, yy, xy and, where it was recorded, traction x, y
/// (eV/nm^3) of each bin.
pub fn ahead(series: &Series, probe: usize, tip: f64) -> impl Iterator<Item = (f64, [f64; 3], Option<[f64; 2]>)> {
    let bins = series.profile_x.len();
    let row = probe * bins..(probe + 1) * bins;
    let stresses = series.profiles.get(row.clone()).unwrap_or_default();
    let tractions = series.tractions.get(row).unwrap_or_default();
    let places = series.profile_x.iter().zip(stresses).enumerate();
    places
        .map(move |(bin, (x, stress))| (x - tip, *stress, tractions.get(bin).copied()))
        .filter(|(r, ..)| *r > 0.0)
}
