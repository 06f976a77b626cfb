//! Lattice and shape of the specimen, and what is cut or held in it.

use super::super::{quantity::Length, reader::Given};
use schemars::JsonSchema;
use serde::Deserialize;

/// The specimen. `lattice: triangular` is a slab, a sheet with a crack between two grips: `length`, `width`, `grips`.
/// `lattice: fcc` is a solid: `blocks`, or `size` and `orientation`.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Specimen {
    pub lattice: Given<Lattice>,
    /// Of a slab: extent along the crack (x).
    pub length: Given<Length>,
    /// Of a slab: extent across the crack (y), grips included.
    pub width: Given<Length>,
    /// Of a solid: blocks of primitive cells along a1, a2 and a3, the vectors to three nearest neighbours, 60 degrees apart.
    /// x runs along a1, a1 and a2 lie in the xy plane, and their plane and all other faces are {111} planes.
    pub blocks: Given<[Given<u32>; 3]>,
    /// Of a solid that is a box: extents along x, y and z.
    pub size: Given<[Given<Length>; 3]>,
    pub orientation: Given<Orientation>,
    /// Atoms per edge of the triangles that lay out a slab, or cells per edge of the blocks that lay out a solid, whatever the
    /// resolution. Where left out it is `resolution.element`, and 10 where that is single atoms.
    pub block: Given<u32>,
    pub grips: Given<Grips>,
}

/// The lattice of the sites.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Lattice {
    /// In two dimensions, with all bonds in the plane.
    Triangular,
    /// Face-centred cubic, in three dimensions.
    Fcc,
}

/// How the crystal lies in a box, as directions of its cube; y completes x and z.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Orientation {
    /// Miller indices of the direction along x, such as [1, 1, -2].
    pub x: Given<[Given<i32>; 3]>,
    /// Miller indices of the direction along z, at right angles to x, such as [1, 1, 1].
    pub z: Given<[Given<i32>; 3]>,
}

/// What the grips of a slab hold; `clamped` where left out.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Grips {
    /// The grips hold x too.
    Clamped,
    /// The grips leave x free, so that a plane wave runs along x unhindered.
    Sliding,
}

/// The notch of a slab from which its crack runs; leave it out for a whole slab.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Crack {
    /// The edge at which the crack begins; `left` where left out.
    pub edge: Given<Edge>,
    /// Where the middle of a notch inside is, from the left edge; for `edge: none` only, and needed there.
    pub center: Given<Length>,
    /// Of the notch, from end to end.
    pub length: Given<Length>,
    /// Where the notch ends among the elements along the crack plane; as long as given where left out. Atoms have neither
    /// corners nor edges: there it is as long as given. Not for `edge: none`.
    pub end: Given<NotchEnd>,
}

#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum NotchEnd {
    /// At the corner of elements that is nearest to the length given: six of them meet there.
    Corner,
    /// In the middle of an edge of an element, the nearest to the length given.
    MidEdge,
}

#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Edge {
    /// The crack runs right.
    Left,
    /// The crack runs left.
    Right,
    /// The notch lies inside and has two tips. The analysis follows the one that runs right, and measures the crack from the
    /// middle of the notch. Pictures and the table of broken bonds show both.
    None,
}

/// What is cut in a solid before anything moves; leave it out for a whole one.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Notch {
    /// A slot: blocks that are left out.
    Blocks(Slot),
    /// A severed plane: nothing is left out.
    Plane(SeveredPlane),
}

/// Blocks that are left out.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Slot {
    /// The first block left out, counted from 0 along a1, a2, a3.
    pub from: Given<[Given<u32>; 3]>,
    /// The first block that is there again, along each.
    pub to: Given<[Given<u32>; 3]>,
}

/// A plane whose bonds are severed from a face on, over the whole width. Its faces push each other and never bond again.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct SeveredPlane {
    /// The axis whose faces the plane is parallel to.
    pub normal: Given<Axis>,
    /// Where, from the low face of that axis; it comes to lie on the nearest border of elements.
    pub at: Given<Length>,
    /// The face from which it is severed.
    pub from: Given<Face>,
    /// How far from that face; in a solid of blocks it ends at the nearest border of elements.
    pub depth: Given<Length>,
}

/// Faces of a solid that do not move.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Held {
    /// Their names.
    pub faces: Given<Vec<Given<Face>>>,
    /// Layers of cells from each face on that are held; those of one block where left out. For `specimen.blocks`.
    pub layers: Given<u32>,
    /// How far from each face they are held. For `specimen.size`.
    pub depth: Given<Length>,
}

/// An axis of a solid: a1, a2, a3 where it is made of blocks, x, y, z where it is a box; x of a slab.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    A1,
    A2,
    A3,
    X,
    Y,
    Z,
}

/// A face: the axis that leads through it, and on which side. A slab has `x-low` and `x-high` between its grips.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Face {
    A1Low,
    A1High,
    A2Low,
    A2High,
    A3Low,
    A3High,
    XLow,
    XHigh,
    YLow,
    YHigh,
    ZLow,
    ZHigh,
}
