//! The parts of a slab with the keys and units of a study file.

use serde_json::{Value, json};

use super::{length, pulse_shape, quantity, ramp, time};
use crate::study::case::solid::Side;
use crate::study::case::{Crack, Edge, Grips, Lattice, Loading, Mode, NotchEnd, Refine, Region, RegionShape, Specimen};
use crate::units::Dimension;

pub fn specimen(specimen: &Specimen) -> Value {
    let Lattice::Triangular = specimen.lattice;
    json!({
        "lattice": "triangular",
        "length": length(specimen.length),
        "width": length(specimen.width),
        "block": specimen.block,
        "grips": match specimen.grips {
            Grips::Clamped => "clamped",
            Grips::Sliding => "sliding",
        },
    })
}

pub fn region(region: &Region) -> Value {
    let element = region.element;
    match region.shape {
        RegionShape::Band { half_width } => json!({ "band": { "half-width": length(half_width), "element": element } }),
        RegionShape::Box { from, to } => {
            json!({ "box": { "from": from.map(length), "to": to.map(length), "element": element } })
        }
        RegionShape::Disc { center, radius } => {
            json!({ "disc": { "center": center.map(length), "radius": length(radius), "element": element } })
        }
    }
}

pub fn refine(refine: &Refine) -> Value {
    let Refine { error, ahead } = *refine;
    json!({ "to": 1, "error": quantity(error, Dimension::Fraction), "ahead": ahead })
}

pub fn notch(crack: &Crack) -> Value {
    let Crack {
        edge,
        length: extent,
        end,
    } = *crack;
    let mut spelled = match edge {
        Edge::Left => json!({ "edge": "left" }),
        Edge::Right => json!({ "edge": "right" }),
        Edge::None { center } => json!({ "edge": "none", "center": length(center) }),
    };
    spelled["length"] = length(extent);
    if let Some(end) = end {
        spelled["end"] = match end {
            NotchEnd::Corner => "corner".into(),
            NotchEnd::MidEdge => "mid-edge".into(),
        };
    }
    spelled
}

pub fn load(loading: &Loading) -> Value {
    match *loading {
        Loading::StrainRate {
            mode: Mode::I,
            rate,
            ramp: start,
            sponge,
            damping,
        } => {
            let rate = quantity(rate, Dimension::Rate);
            let mut spelled = json!({ "mode": "I", "rate": rate, "ramp": ramp(start) });
            if let Some(width) = sponge {
                spelled["sponge"] = length(width);
            }
            if let Some(rate) = damping {
                spelled["damping"] = quantity(rate, Dimension::Rate);
            }
            json!({ "strain-rate": spelled })
        }
        Loading::Pulse {
            face,
            pressure,
            shape,
            duration,
        } => json!({ "pulse": {
            "face": match face {
                Side::Low => "x-low",
                Side::High => "x-high",
            },
            "shape": pulse_shape(shape),
            "duration": time(duration),
            "pressure": quantity(pressure, Dimension::Stress),
        } }),
    }
}

pub fn gauges(at: &[f64]) -> Value {
    let at: Vec<Value> = at.iter().copied().map(length).collect();
    json!({ "axis": "x", "at": at })
}
