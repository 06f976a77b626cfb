//! Elements, and where finer ones are.

use super::super::{
    quantity::{Fraction, Length},
    reader::Given,
};
use schemars::JsonSchema;
use serde::Deserialize;

/// How many atoms an element stands for, and where finer ones are.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Resolution {
    /// Atoms per edge of a triangle, or cells per edge of the block of a solid's elements; 1 is the single atom.
    pub element: Given<u32>,
    /// Where finer elements are used; the finest region that holds a site decides.
    pub regions: Given<Vec<Given<Region>>>,
    /// Elements of a slab become atoms on the way, where its crack comes.
    pub refine: Given<Refine>,
}

/// Which elements become atoms while the specimen moves.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Refine {
    /// Atoms per edge of what they become: 1, single atoms.
    pub to: Given<u32>,
    /// Largest error of the strain in an element, told by the difference to its neighbours, over what its bonds have left
    /// before they give way; `2 %` where left out.
    pub error: Given<Fraction>,
    /// How many layers of elements around those with too large an error become atoms with them; 2 where left out.
    pub ahead: Given<u32>,
}

/// A part of the specimen. In a slab x is measured from the left edge, y from the crack plane; in a solid all is measured from
/// its first site, the corner of its low faces.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Region {
    /// In a slab: both sides of the crack plane.
    Band(Band),
    Box(Rectangle),
    /// In a slab.
    Disc(Disc),
    /// In a solid: both sides of a plane.
    Slab(PlaneRegion),
    /// In a solid.
    Ball(Ball),
    /// In a solid.
    Cylinder(Cylinder),
}

/// A band along the crack plane with elements of its own.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Band {
    pub half_width: Given<Length>,
    /// Atoms per edge of an element here; 1 is the single atom.
    pub element: Given<u32>,
}

/// A rectangle of a slab or a box of a solid with elements of its own.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
#[schemars(rename = "Box")]
pub struct Rectangle {
    /// Lower left corner, [x, y] or [x, y, z].
    pub from: Given<Point>,
    /// Upper right corner, [x, y] or [x, y, z].
    pub to: Given<Point>,
    /// Atoms per edge of an element here; 1 is the single atom.
    pub element: Given<u32>,
}

/// A disc with elements of its own.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Disc {
    /// [x, y]
    pub center: Given<Point>,
    pub radius: Given<Length>,
    /// Atoms per edge of an element here; 1 is the single atom.
    pub element: Given<u32>,
}

/// A slice of a solid with elements of its own.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct PlaneRegion {
    /// The axis whose faces the plane is parallel to.
    pub normal: Given<super::Axis>,
    /// Where the plane is, from the low face of that axis.
    pub at: Given<Length>,
    pub half_width: Given<Length>,
    /// Cells per edge of an element's block here; 1 is the single atom.
    pub element: Given<u32>,
}

/// A ball inside a solid with elements of its own.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Ball {
    /// [x, y, z]
    pub center: Given<Point>,
    pub radius: Given<Length>,
    /// Cells per edge of an element's block here; 1 is the single atom.
    pub element: Given<u32>,
}

/// A cylinder through a solid with elements of its own.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Cylinder {
    /// Its direction.
    pub along: Given<super::Axis>,
    /// A point on its middle line, [x, y, z].
    pub center: Given<Point>,
    pub radius: Given<Length>,
    /// Cells per edge of an element's block here; 1 is the single atom.
    pub element: Given<u32>,
}

/// [x, y] in a slab, [x, y, z] in a solid.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct Point(#[schemars(length(min = 2, max = 3))] pub Vec<Given<Length>>);
