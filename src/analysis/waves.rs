//! When waves sent out by the starting crack come back to its tip.

mod picking;

pub use picking::{AFTER_SHARE, BEFORE_SHARE, LEAST_RIVALS, LEAST_SCATTERS, WINDOW};

use super::crack::Tip;
use super::initiation::Initiation;
use super::series::{Series, Setting};

/// A wave and the face that sends it back. Times in ps after the crack starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    pub wave: Wave,
    pub face: Face,
    /// At the end of the notch.
    pub predicted: f64,
    /// At the tip where it has run to by then; `None` where the run ends before.
    pub at_running_tip: Option<f64>,
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

impl Face {
    /// From the end of the notch to the face and back to a tip, nm: to the nearer of the grips.
    fn path(self, notch: &Tip, tip: &Tip, setting: &Setting) -> f64 {
        match self {
            Self::Left => notch.x + tip.x,
            Self::TopAndBottom => (setting.height - tip.y.abs()).hypot(tip.x - notch.x),
        }
    }
}

impl Arrival {
    /// At the tip, wherever it is.
    pub fn at_tip(&self) -> f64 {
        self.at_running_tip.unwrap_or(self.predicted)
    }
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

/// Every wave on its way, sent out from the end of the notch when the crack starts. Predicted are straight paths at the
/// speeds of long waves. A Rayleigh wave runs along the crack faces only, so none comes from the top and bottom.
pub fn arrivals(tips: &[Tip], initiation: Option<Initiation>, series: &Series, setting: &Setting) -> Vec<Arrival> {
    let Some(notch) = tips.first() else {
        return Vec::new();
    };
    let arrival = |wave: Wave, face: Face| {
        let path = face.path(notch, notch, setting);
        let speed = wave.speed(setting);
        let at_running_tip = initiation.and_then(|start| {
            let mut later = series.probes.iter().zip(tips).skip(start.probe);
            let met = later.find(|(row, tip)| speed * (row.time - start.time) >= face.path(notch, tip, setting))?;
            Some(met.0.time - start.time)
        });
        Arrival {
            wave,
            face,
            predicted: path / speed,
            at_running_tip,
            measured: initiation.and_then(|start| picking::pick(wave, face, path, start, series, setting)),
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
