//! Sizes of a picture and of the room around it, pixels.

use plotters::style::RGBColor;

pub const WIDTH: u32 = 2000;
pub const EDGE: u32 = 20;
/// Room for the numbers and the name of the y axis.
pub const LEFT: u32 = 234;
/// Room for the half of the last number of the x axis.
pub const RIGHT: u32 = 76;
/// Room for the scale of colours.
pub const TOP: u32 = 186;
/// Room for the numbers and the name of the x axis.
pub const BOTTOM: u32 = 160;
pub const TALLEST: f64 = 2580.0;
/// On a phone a picture is a sixth as wide: ten pixels are left of its text.
pub const TEXT: i32 = 60;
pub const INK: RGBColor = RGBColor(34, 34, 34);
