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
    /// At the tip where it has run to by then, between two probes; `None` where the run ends before. What belongs to the
    /// running crack is told by this alone: times at the end of the notch do not come in the same order.
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
    /// There and back along the crack, which comes from there; in the frame of the crack that is the left.
    Left,
    Right,
    /// From the crack plane to the grips and back: the height of the specimen.
    TopAndBottom,
}

impl Face {
    /// From the end of the notch to the face and back to a tip, nm: to the nearer of the grips.
    fn path(self, notch: &Tip, tip: &Tip, setting: &Setting) -> f64 {
        match self {
            Self::Left | Self::Right => notch.x + tip.x,
            Self::TopAndBottom => (setting.height - tip.y.abs()).hypot(tip.x - notch.x),
        }
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
/// speeds of long waves. A Rayleigh wave runs along the crack faces only, so none comes from the top and bottom. The faces of a
/// notch inside lead to no side of the specimen.
pub fn arrivals(tips: &[Tip], initiation: Option<Initiation>, series: &Series, setting: &Setting) -> Vec<Arrival> {
    let Some(notch) = tips.first() else {
        return Vec::new();
    };
    let arrival = |wave: Wave, face: Face| {
        let path = face.path(notch, notch, setting);
        let speed = wave.speed(setting);
        let at_running_tip = initiation.and_then(|start| {
            // By how far the wave is past the tip, nm.
            let past = |probe: usize| {
                let time = series.probes[probe].time - start.time;
                (time, speed * time - face.path(notch, &tips[probe], setting))
            };
            let met = (start.probe..tips.len()).find(|&probe| past(probe).1 >= 0.0)?;
            let [(before, short), (after, long)] = [past(met.checked_sub(1)?), past(met)];
            Some(before + (after - before) * short / (short - long))
        });
        Arrival {
            wave,
            face,
            predicted: path / speed,
            at_running_tip,
            measured: initiation.and_then(|start| picking::pick(wave, face, path, start, series, setting)),
        }
    };
    let ways = [
        (Wave::Longitudinal, Face::Left),
        (Wave::Transverse, Face::Left),
        (Wave::Rayleigh, Face::Left),
        (Wave::Longitudinal, Face::TopAndBottom),
        (Wave::Transverse, Face::TopAndBottom),
    ];
    let ways = ways
        .into_iter()
        .filter(|(_, face)| *face == Face::TopAndBottom || !setting.is_crack_inside());
    ways.map(|(wave, face)| arrival(wave, face)).collect()
}
