//! The parts of a solid with the keys and units of a study file.

use serde_json::{Value, json};

use super::{length, pulse_shape, quantity, ramp, time};
use crate::study::case::Solid;
use crate::study::case::solid::{
    Axis, Depth, Face, Gauges, Held, Lattice, Loading, Notch, Pull, Region, RegionShape, Shape, Side, Specimen,
};
use crate::units::Dimension;

/// Everything between the material and the run, and the gauges.
pub struct Spelled {
    pub specimen: Value,
    pub resolution: Value,
    pub notch: Option<Value>,
    pub held: Option<Value>,
    pub loading: Value,
    pub gauges: Option<Value>,
}

pub fn spelled(solid: &Solid) -> Spelled {
    let names = Names::of(&solid.specimen);
    let regions: Vec<Value> = solid.resolution.regions.iter().map(|one| names.region(one)).collect();
    Spelled {
        specimen: specimen(&solid.specimen),
        resolution: json!({ "element": solid.resolution.element, "regions": regions }),
        notch: solid.notch.as_ref().map(|notch| names.notch(notch)),
        held: solid.held.as_ref().map(|held| names.held(held)),
        loading: names.loading(&solid.loading),
        gauges: solid.gauges.as_ref().map(|gauges| names.gauges(gauges)),
    }
}

fn specimen(specimen: &Specimen) -> Value {
    let Lattice::Fcc = specimen.lattice;
    let mut spelled = json!({ "lattice": "fcc" });
    match specimen.shape {
        Shape::Blocks(blocks) => spelled["blocks"] = json!(blocks),
        Shape::Box { size, x, z } => {
            spelled["size"] = json!(size.map(length));
            spelled["orientation"] = json!({ "x": x, "z": z });
        }
    }
    spelled["block"] = specimen.block.into();
    spelled
}

/// The axes of a specimen: a1, a2, a3 or x, y, z.
struct Names([&'static str; 3]);

impl Names {
    fn of(specimen: &Specimen) -> Self {
        Self(match specimen.shape {
            Shape::Blocks(_) => ["a1", "a2", "a3"],
            Shape::Box { .. } => ["x", "y", "z"],
        })
    }

    fn axis(&self, axis: Axis) -> &'static str {
        self.0[axis.index()]
    }

    fn face(&self, face: Face) -> String {
        let side = match face.side {
            Side::Low => "low",
            Side::High => "high",
        };
        format!("{}-{side}", self.axis(face.axis))
    }

    fn region(&self, region: &Region) -> Value {
        let element = region.element;
        match region.shape {
            RegionShape::Box { from, to } => {
                json!({ "box": { "from": from.map(length), "to": to.map(length), "element": element } })
            }
            RegionShape::Slab { normal, at, half_width } => json!({ "slab": {
                "normal": self.axis(normal), "at": length(at), "half-width": length(half_width), "element": element,
            } }),
            RegionShape::Ball { center, radius } => {
                json!({ "ball": { "center": center.map(length), "radius": length(radius), "element": element } })
            }
            RegionShape::Cylinder { along, center, radius } => json!({ "cylinder": {
                "along": self.axis(along), "center": center.map(length), "radius": length(radius), "element": element,
            } }),
        }
    }

    fn notch(&self, notch: &Notch) -> Value {
        match *notch {
            Notch::Slot { from, to } => json!({ "blocks": { "from": from, "to": to } }),
            Notch::Plane {
                normal,
                at,
                from,
                depth,
            } => json!({ "plane": {
                "normal": self.axis(normal), "at": length(at), "from": self.face(from), "depth": length(depth),
            } }),
        }
    }

    fn held(&self, held: &Held) -> Value {
        let faces: Vec<String> = held.faces.iter().map(|&face| self.face(face)).collect();
        with_depth(json!({ "faces": faces }), held.depth)
    }

    fn gauges(&self, gauges: &Gauges) -> Value {
        let at: Vec<Value> = gauges.at.iter().copied().map(length).collect();
        json!({ "axis": self.axis(gauges.axis), "at": at })
    }

    fn loading(&self, loading: &Loading) -> Value {
        match *loading {
            Loading::Velocity {
                face,
                speed,
                direction,
                depth,
                ramp: start,
            } => {
                let mut spelled = json!({ "face": self.face(face), "speed": quantity(speed, Dimension::Velocity) });
                if let Some(direction) = direction {
                    spelled["direction"] = json!(direction);
                }
                let mut spelled = with_depth(spelled, depth);
                spelled["ramp"] = ramp(start).into();
                json!({ "velocity": spelled })
            }
            Loading::Traction { face, pull, rise_time } => {
                let spelled = with_pull(json!({ "face": self.face(face) }), pull);
                json!({ "traction": with_rise(spelled, rise_time) })
            }
            Loading::OpposedTractions {
                axis,
                thickness,
                share,
                pull,
                rise_time,
            } => {
                let spelled = json!({
                    "axis": self.axis(axis),
                    "thickness": self.axis(thickness),
                    "share": quantity(share, Dimension::Fraction),
                });
                json!({ "opposed-tractions": with_rise(with_pull(spelled, pull), rise_time) })
            }
            Loading::Pulse {
                face,
                pull,
                shape,
                duration,
            } => {
                let shape = pulse_shape(shape);
                let spelled = json!({ "face": self.face(face), "shape": shape, "duration": time(duration) });
                json!({ "pulse": with_pull(spelled, pull) })
            }
            Loading::Impact {
                face,
                radius,
                speed,
                center,
                gap,
            } => {
                let mut spelled = json!({
                    "face": self.face(face), "radius": length(radius), "speed": quantity(speed, Dimension::Velocity),
                });
                match center {
                    Some(center) => spelled["center"] = json!(center.map(length)),
                    None => spelled["gap"] = length(gap),
                }
                json!({ "impact": spelled })
            }
        }
    }
}

fn with_depth(mut spelled: Value, depth: Depth) -> Value {
    match depth {
        Depth::Layers(layers) => spelled["layers"] = layers.into(),
        Depth::Length(deep) => spelled["depth"] = length(deep),
    }
    spelled
}

fn with_pull(mut spelled: Value, pull: Pull) -> Value {
    let stress = |value: f64| quantity(value, Dimension::Stress);
    match pull {
        Pull::Stress(parts) => spelled["stress"] = json!(parts.map(stress)),
        Pull::Pressure(pressure) => spelled["pressure"] = stress(pressure),
    }
    spelled
}

fn with_rise(mut spelled: Value, rise_time: f64) -> Value {
    if rise_time > 0.0 {
        spelled["rise-time"] = time(rise_time);
    }
    spelled
}
