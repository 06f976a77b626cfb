//! When waves sent out by the starting crack come back to its tip.

use super::series::Setting;

/// A wave and the face that sends it back. Times in ps after the crack starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    pub wave: Wave,
    pub face: Face,
    pub predicted: f64,
    /// Picked from the computed fields; not done yet.
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

/// Straight paths at the speeds of long waves, with the tip (nm from the left edge) standing still. A Rayleigh wave
/// runs along the crack faces only, so none comes from the top and bottom.
pub fn predicted(tip: Option<f64>, setting: &Setting) -> Vec<Arrival> {
    let Some(tip) = tip else {
        return Vec::new();
    };
    let arrival = |wave, face| {
        let path = match face {
            Face::Left => 2.0 * tip,
            Face::TopAndBottom => setting.height,
        };
        let speed = match wave {
            Wave::Longitudinal => setting.longitudinal_speed,
            Wave::Transverse => setting.transverse_speed,
            Wave::Rayleigh => setting.rayleigh_speed,
        };
        Arrival {
            wave,
            face,
            predicted: path / speed,
            measured: None,
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
