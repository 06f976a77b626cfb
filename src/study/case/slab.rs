//! A slab: a sheet of the triangular lattice, pulled by its grips or pushed at a face.

use serde::Serialize;

use super::solid::{PulseShape, Side};
use super::{Material, Ramp};

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Slab {
    pub material: Sheet,
    pub specimen: Specimen,
    pub resolution: Resolution,
    pub crack: Option<Crack>,
    pub loading: Loading,
    /// Where lines across the slab stand whose mean velocity and stress the time series holds, nm from the left edge.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub gauges: Vec<f64>,
}

/// Atoms in a sheet.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sheet {
    #[serde(flatten)]
    pub atoms: Material,
    /// What a 2D stress (force per length) is divided by to become a pressure, nm.
    pub thickness: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Specimen {
    pub lattice: Lattice,
    /// Extent along the crack (x), nm.
    pub length: f64,
    /// Extent across the crack (y), nm.
    pub width: f64,
    /// Atoms an edge of the triangles that lay out the site set, whatever the resolution.
    pub block: u32,
    pub grips: Grips,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Lattice {
    Triangular,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Grips {
    /// u_x = 0 in the grips.
    Clamped,
    /// The grips leave u_x free.
    Sliding,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Resolution {
    /// Atoms an edge of an element; 1 is the single atom.
    pub element: u32,
    /// Where another, finer element is used. The finest region that holds a site decides.
    pub regions: Vec<Region>,
    /// What becomes atoms on the way; `None`: nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refine: Option<Refine>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Refine {
    /// Largest error of the strain in an element, over what its bonds have left before they give way.
    pub error: f64,
    /// Layers of elements around those with a larger one that become atoms with them.
    pub ahead: u32,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Region {
    pub element: u32,
    pub shape: RegionShape,
}

/// x from the left edge of the specimen, y from the crack plane (mid-height), nm.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum RegionShape {
    /// |y| <= half_width.
    Band {
        half_width: f64,
    },
    Box {
        from: [f64; 2],
        to: [f64; 2],
    },
    Disc {
        center: [f64; 2],
        radius: f64,
    },
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Crack {
    pub edge: Edge,
    /// From end to end, nm.
    pub length: f64,
    /// Where the notch ends among the elements along the crack plane; `None`: as long as given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end: Option<NotchEnd>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum NotchEnd {
    /// The nearest corner of elements.
    Corner,
    /// The nearest middle of an element's edge.
    MidEdge,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Edge {
    Left,
    Right,
    None {
        /// Of the middle of the notch from the left edge, nm.
        center: f64,
    },
}

impl Crack {
    /// From where the crack is measured, its edge or the middle of its notch, to the tip, nm.
    pub fn measured(&self) -> f64 {
        match self.edge {
            Edge::Left | Edge::Right => self.length,
            Edge::None { .. } => 0.5 * self.length,
        }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Loading {
    StrainRate {
        mode: Mode,
        /// Nominal strain rate, 1/ps.
        rate: f64,
        ramp: Ramp,
        /// Width of a layer before each grip that takes waves out, nm.
        #[serde(skip_serializing_if = "Option::is_none")]
        sponge: Option<f64>,
        /// Rate at which velocities everywhere approach those of even stretching, 1/ps.
        #[serde(skip_serializing_if = "Option::is_none")]
        damping: Option<f64>,
    },
    /// A pressure on a face that comes and goes, between grips at rest.
    Pulse {
        /// Which of the two across x: the low one is the left.
        face: Side,
        /// At its greatest, into the slab, eV/nm^3.
        pressure: f64,
        shape: PulseShape,
        /// ps
        duration: f64,
    },
}

impl Loading {
    /// Nominal strain rate, 1/ps; `None` where nothing strains the slab evenly.
    pub fn strain_rate(&self) -> Option<f64> {
        match *self {
            Self::StrainRate { rate, .. } => Some(rate),
            Self::Pulse { .. } => None,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Mode {
    I,
}
