//! When waves sent out by the starting crack come back to its tip.

mod picking;

pub use picking::{AFTER_SHARE, BEFORE_SHARE, LEAST_RIVALS, LEAST_SCATTERS, WINDOW};

use super::initiation::Initiation;
use super::series::{Series, Setting};

/// A wave and the face that sends it back. Times in ps after the crack starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    pub wave: Wave,
    pub face: Face,
    pub predicted: f64,
    /// Picked from the wave gauges; `None` where it does not stand out.
    pub measured: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wave {
    Longitudinal,
    Transverse,
    Rayleigh,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// There and back along the crack.
    Left,
    /// From the crack plane to the grips and back: the height of the specimen.
    TopAndBottom,
}

impl Wave {
    /// nm/ps
    fn speed(self, setting: &Setting) -> f64 {
        match self {
            Self::Longitudinal => setting.longitudinal_speed,
            Self::Transverse => setting.transverse_speed,
            Self::Rayleigh => setting.rayleigh_speed,
        }
    }
}

/// Every wave on its way, with the tip (nm from the left edge) standing still. Predicted are straight paths at the speeds
/// of long waves. A Rayleigh wave runs along the crack faces only, so none comes from the top and bottom.
pub fn arrivals(tip: Option<f64>, initiation: Option<Initiation>, series: &Series, setting: &Setting) -> Vec<Arrival> {
    let Some(tip) = tip else {
        return Vec::new();
    };
    let arrival = |wave: Wave, face| {
        let path = match face {
            Face::Left => 2.0 * tip,
            Face::TopAndBottom => setting.height,
        };
        let predicted = path / wave.speed(setting);
        let measured = initiation.and_then(|start| picking::pick(wave, face, path, start, series, setting));
        Arrival {
            wave,
            face,
            predicted,
            measured,
        }
    };
    vec![
        arrival(Wave::Longitudinal, Face::Left),
        arrival(Wave::Transverse, Face::Left),
        arrival(Wave::Rayleigh, Face::Left),
        arrival(Wave::Longitudinal, Face::TopAndBottom),
        arrival(Wave::Transverse, Face::TopAndBottom),
    ]
}
