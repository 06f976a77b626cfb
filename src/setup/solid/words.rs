//! How a solid is held and loaded, in words.

use super::plan::Laid;
use crate::study::case::Solid;
use crate::study::case::solid::{Face, Held, Loading, Pull, PulseShape, Shape, Side};
use crate::units::{EV_PER_NM3_IN_GPA, NM_PER_PS_IN_M_PER_S};

/// What its axes are called.
pub fn axes(solid: &Solid) -> [&'static str; 3] {
    match solid.specimen.shape {
        Shape::Blocks(_) => ["a1", "a2", "a3"],
        Shape::Box { .. } => ["x", "y", "z"],
    }
}

pub fn face(solid: &Solid, face: Face) -> String {
    let side = match face.side {
        Side::Low => "low",
        Side::High => "high",
    };
    format!("{}-{side}", axes(solid)[face.axis.index()])
}

/// `a2-low, 2.09 nm deep`
pub fn held(solid: &Solid, held: &Held, laid: &Laid) -> String {
    let faces: Vec<String> = held.faces.iter().map(|&one| face(solid, one)).collect();
    let depth = laid.depth(held.faces[0].axis, held.depth);
    format!("{}, {} nm deep", faces.join(", "), short(depth))
}

/// `a2-high at 20 m/s`
pub fn loading(solid: &Solid, laid: &Laid) -> String {
    let speed = |speed: f64| format!("{} m/s", short(speed * NM_PER_PS_IN_M_PER_S));
    match &solid.loading {
        Loading::Velocity {
            face: one,
            speed: fast,
            direction,
            depth,
            ..
        } => {
            let length = laid.strained_length(solid, *one, *direction, *depth);
            let rate = fast / length * 1e12;
            format!("{} at {}, {rate:.3e} /s", face(solid, *one), speed(*fast))
        }
        Loading::Traction {
            face: one,
            pull: force,
            rise_time,
        } => {
            format!("{} on {}{}", pull(*force), face(solid, *one), rise(*rise_time))
        }
        Loading::OpposedTractions {
            axis,
            pull: force,
            rise_time,
            ..
        } => {
            let axis = axes(solid)[axis.index()];
            format!(
                "{} on {axis}-high, opposite on {axis}-low{}",
                pull(*force),
                rise(*rise_time)
            )
        }
        Loading::Pulse {
            face: one,
            pull: force,
            shape,
            duration,
        } => {
            let shape = match shape {
                PulseShape::HalfSine => "half a sine",
                PulseShape::Gaussian => "a Gaussian",
            };
            format!(
                "{} on {}, {shape} of {} ps",
                pull(*force),
                face(solid, *one),
                short(*duration)
            )
        }
        Loading::Impact {
            face: one,
            radius,
            speed: fast,
            ..
        } => format!(
            "ball of {} nm at {} against {}",
            short(*radius),
            speed(*fast),
            face(solid, *one)
        ),
    }
}

fn rise(time: f64) -> String {
    match time {
        0.0 => String::new(),
        time => format!(" within {} ps", short(time)),
    }
}

/// In GPa.
fn pull(pull: Pull) -> String {
    let gigapascal = |stress: f64| short(stress * EV_PER_NM3_IN_GPA);
    match pull {
        Pull::Stress(parts) => format!("[{}] GPa", parts.map(gigapascal).join(", ")),
        Pull::Pressure(pressure) => format!("{} GPa of pressure", gigapascal(pressure)),
    }
}

/// Three digits.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    rounded.to_string()
}
