//! A solid: a body of the FCC lattice, held and loaded at its faces.
//!
//! Coordinates in nm. Those of a body of blocks are measured from its first site, x along a1, a1 and a2 in the xy plane;
//! those of a box from its lower corner, along its edges.

use serde::Serialize;

use super::{Material, Ramp};

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Solid {
    pub material: Material,
    pub specimen: Specimen,
    pub resolution: Resolution,
    pub notch: Option<Notch>,
    pub held: Option<Held>,
    pub loading: Loading,
    pub gauges: Option<Gauges>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Specimen {
    pub lattice: Lattice,
    pub shape: Shape,
    /// Primitive cells an edge of the blocks that lay out the specimen, whatever the resolution.
    pub block: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Lattice {
    Fcc,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Shape {
    /// So many blocks along a1, a2, a3: a rhombohedron of primitive vectors.
    Blocks([u32; 3]),
    Box {
        /// Along x, y, z, nm.
        size: [f64; 3],
        /// Directions of the crystal along x and z; y completes them.
        x: [i32; 3],
        z: [i32; 3],
    },
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Resolution {
    /// Primitive cells an edge of an element's block; 1 is the single atom.
    pub element: u32,
    /// Where another, finer element is used. The finest region that holds a site decides.
    pub regions: Vec<Region>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Region {
    pub element: u32,
    pub shape: RegionShape,
}

/// nm
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum RegionShape {
    Box {
        from: [f64; 3],
        to: [f64; 3],
    },
    /// Not farther than `half_width` from a plane parallel to the faces of an axis, `at` from its low face.
    Slab {
        normal: Axis,
        at: f64,
        half_width: f64,
    },
    Ball {
        center: [f64; 3],
        radius: f64,
    },
    /// Of any length along its axis.
    Cylinder {
        along: Axis,
        center: [f64; 3],
        radius: f64,
    },
}

/// An axis of the specimen: of the blocks a1, a2, a3, of a box x, y, z. A face is named by the axis that leads through it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Axis {
    First,
    Second,
    Third,
}

impl Axis {
    pub fn index(self) -> usize {
        self as usize
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Face {
    pub axis: Axis,
    pub side: Side,
}

impl Face {
    /// The other face of its axis.
    pub fn opposite(self) -> Self {
        let side = match self.side {
            Side::Low => Side::High,
            Side::High => Side::Low,
        };
        Self { side, ..self }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Side {
    Low,
    High,
}

/// What is cut before anything moves.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Notch {
    /// These blocks are left out, `to` not among them.
    Slot { from: [u32; 3], to: [u32; 3] },
    /// Bonds through this plane are severed; nothing is removed.
    Plane {
        normal: Axis,
        /// From the low face of the axis, nm.
        at: f64,
        /// The face from which it is severed, and how far, nm.
        from: Face,
        depth: f64,
    },
}

/// Faces whose sites do not move.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Held {
    pub faces: Vec<Face>,
    /// How far from the face, nm or cells.
    pub depth: Depth,
}

/// Thickness of what belongs to a face.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Depth {
    /// Primitive cells.
    Layers(u32),
    /// nm
    Length(f64),
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Loading {
    /// A face moves at a constant velocity.
    Velocity {
        face: Face,
        /// nm/ps
        speed: f64,
        /// Of length one; `None`: out of the face.
        direction: Option<[f64; 3]>,
        depth: Depth,
        ramp: Ramp,
    },
    /// A force on the outermost sites of a face.
    Traction {
        face: Face,
        pull: Pull,
        /// From none to all, ps; 0: at once.
        rise_time: f64,
    },
    /// Opposite forces on the two faces of an axis, each on a part of the thickness.
    OpposedTractions {
        axis: Axis,
        /// The axis along which the two are offset.
        thickness: Axis,
        /// The part of the thickness that each acts on: the high face on the high side, the low face on the low side.
        share: f64,
        pull: Pull,
        rise_time: f64,
    },
    /// A force on the outermost sites of a face that comes and goes.
    Pulse {
        face: Face,
        pull: Pull,
        shape: PulseShape,
        /// ps
        duration: f64,
    },
    /// A rigid ball that moves at a constant velocity against a face.
    Impact {
        face: Face,
        /// nm
        radius: f64,
        /// nm/ps
        speed: f64,
        /// Its middle at the start, nm; `None`: before the middle of the face, `gap` from it.
        center: Option<[f64; 3]>,
        gap: f64,
    },
}

/// Force per area, eV/nm^3.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Pull {
    Stress([f64; 3]),
    /// Into the body.
    Pressure(f64),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum PulseShape {
    /// One half of a sine.
    HalfSine,
    /// A Gaussian whose full width at half maximum is a quarter of the duration.
    Gaussian,
}

/// Planes whose mean velocity and stress the time series holds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Gauges {
    pub axis: Axis,
    /// From the low face of the axis, nm.
    pub at: Vec<f64>,
}
