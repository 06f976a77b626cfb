//! Sizes of a picture and of the room around it, pixels.

use plotters::style::RGBColor;

pub const WIDTH: u32 = 2000;
pub const EDGE: u32 = 20;
/// Room for the numbers and the name of the y axis.
pub const LEFT: u32 = 178;
/// Room for the scale of colours.
pub const RIGHT: u32 = 306;
pub const TOP: u32 = 26;
/// Room for the numbers and the name of the x axis.
pub const BOTTOM: u32 = 136;
pub const TALLEST: f64 = 2580.0;
pub const TEXT: i32 = 44;
pub const INK: RGBColor = RGBColor(34, 34, 34);
