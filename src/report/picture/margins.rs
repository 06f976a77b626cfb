//! Sizes of a picture and of the room around it, pixels.

use plotters::style::RGBColor;

pub const WIDTH: u32 = 1240;
pub const EDGE: u32 = 12;
/// Room for the numbers and the name of the y axis.
pub const LEFT: u32 = 110;
/// Room for the scale of colours.
pub const RIGHT: u32 = 190;
pub const TOP: u32 = 16;
/// Room for the numbers and the name of the x axis.
pub const BOTTOM: u32 = 84;
pub const TALLEST: f64 = 1600.0;
pub const TEXT: i32 = 27;
pub const INK: RGBColor = RGBColor(34, 34, 34);
