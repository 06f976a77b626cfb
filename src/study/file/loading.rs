//! What moves and loads the specimen.

use super::super::{
    quantity::{Fraction, Length, Rate, Stress, Time, Velocity},
    reader::Given,
};
use super::{Axis, Face};
use schemars::JsonSchema;
use serde::Deserialize;

/// How the specimen is loaded.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Loading {
    /// Of a slab: the grips move apart so that the nominal strain grows at a constant rate.
    StrainRate(StrainRate),
    /// Of a solid: a face moves at a constant velocity.
    Velocity(MovingFace),
    /// Of a solid: a force on a face.
    Traction(Traction),
    /// Of a solid: opposite forces on two faces, offset in the thickness.
    OpposedTractions(OpposedTractions),
    /// Of a solid, or of a slab without a crack: a force on a face that comes and goes.
    Pulse(Pulse),
    /// Of a solid: a rigid ball flies against it.
    Impact(Impact),
}

/// The grips part at a constant rate.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct StrainRate {
    pub mode: Given<Mode>,
    /// Nominal strain rate.
    pub rate: Given<Rate>,
    pub ramp: Given<Ramp>,
    /// Width of a layer before each grip that takes waves out, so that few come back; none where left out.
    pub sponge: Given<Length>,
    /// Rate at which velocities everywhere approach those of even stretching, which takes heat out, and waves as fast;
    /// none where left out.
    pub damping: Given<Rate>,
}

/// Mode of the loading; `I` where left out.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
pub enum Mode {
    /// Opening.
    I,
}

/// How the motion begins; `initial-velocity` where left out.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Ramp {
    /// The interior starts with the velocities of the loading, so that no shock enters.
    InitialVelocity,
    /// The interior starts at rest.
    AtRest,
}

/// A face that moves.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct MovingFace {
    pub face: Given<Face>,
    pub speed: Given<Velocity>,
    /// Where to, as numbers along x, y and z; straight out of the face where left out.
    pub direction: Given<[Given<f64>; 3]>,
    /// Layers of cells from the face on that move; those of one block where left out. For `specimen.blocks`.
    pub layers: Given<u32>,
    /// How far from the face they move. For `specimen.size`.
    pub depth: Given<Length>,
    pub ramp: Given<Ramp>,
}

/// A force on the outermost sites of a face.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Traction {
    pub face: Given<Face>,
    /// Force per area, [x, y, z]; this or a pressure.
    pub stress: Given<[Given<Stress>; 3]>,
    /// Force per area straight into the body; this or a stress.
    pub pressure: Given<Stress>,
    /// Time in which it grows from nothing; at once where left out.
    pub rise_time: Given<Time>,
}

/// Opposite forces on the two faces of an axis.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct OpposedTractions {
    /// The axis through both faces.
    pub axis: Given<Axis>,
    /// The axis along which they are offset: one acts on the high side, the other on the low side.
    pub thickness: Given<Axis>,
    /// The part of the thickness that each acts on; 50 % where left out.
    pub share: Given<Fraction>,
    /// Force per area on the high face, [x, y, z]; the low face gets the opposite. This or a pressure.
    pub stress: Given<[Given<Stress>; 3]>,
    /// Force per area straight into the body; this or a stress.
    pub pressure: Given<Stress>,
    /// Time in which they grow from nothing; at once where left out.
    pub rise_time: Given<Time>,
}

/// A force on the outermost sites of a face, for a while.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Pulse {
    /// Of a slab `x-low`, the left one, or `x-high`.
    pub face: Given<Face>,
    pub shape: Given<PulseShape>,
    pub duration: Given<Time>,
    /// Of a solid: greatest force per area, [x, y, z]; this or a pressure.
    pub stress: Given<[Given<Stress>; 3]>,
    /// Greatest force per area straight into the body; in a solid this or a stress.
    pub pressure: Given<Stress>,
}

/// How a pulse comes and goes; `half-sine` where left out.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PulseShape {
    /// One half of a sine.
    HalfSine,
    /// A Gaussian whose full width at half maximum is a quarter of the duration.
    Gaussian,
}

/// A rigid ball.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Impact {
    /// The face that it hits, straight.
    pub face: Given<Face>,
    pub radius: Given<Length>,
    pub speed: Given<Velocity>,
    /// Its middle at the start, [x, y, z]; before the middle of the face where left out.
    pub center: Given<[Given<Length>; 3]>,
    /// Between the ball and the face at the start; 0.5 nm where left out. Not with `center`.
    pub gap: Given<Length>,
}
