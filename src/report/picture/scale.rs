//! A scale of colours, and its bar above a picture.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::margins::{EDGE, INK, LEFT, RIGHT, TEXT, WIDTH};
use crate::report::numbers;

/// Rows in which the bar begins and ends, and the length of its ticks, pixels.
const BAR: [i32; 2] = [22, 74];
const TICK: i32 = 11;

/// Which colour stands for which value.
#[derive(Clone, Copy)]
pub struct Scale {
    /// The quantity and its unit.
    pub label: &'static str,
    /// Values of the lowest and of the highest colour.
    pub ends: [f64; 2],
    /// Colour at a place between 0 and 1 along the bar.
    pub colour: fn(f64) -> [u8; 3],
}

impl Scale {
    /// Beyond the ends the end colours.
    pub fn colour_of(&self, value: f64) -> [u8; 3] {
        let [low, high] = self.ends;
        (self.colour)(((value - low) / (high - low)).clamp(0.0, 1.0))
    }

    /// The bar, above a picture and as wide as it, behind its label.
    pub fn draw<'a>(
        &self,
        root: &DrawingArea<BitMapBackend<'a>, Shift>,
    ) -> Result<(), DrawingAreaErrorKind<<BitMapBackend<'a> as DrawingBackend>::ErrorType>> {
        let font = ("sans-serif", TEXT).into_font().color(&INK);
        let (left, right) = ((EDGE + LEFT) as i32, (WIDTH - RIGHT) as i32);
        root.draw(&Text::new(
            self.label,
            (left, (BAR[0] + BAR[1] - TEXT) / 2),
            font.clone(),
        ))?;
        let from = left + root.estimate_text_size(self.label, &font)?.0 as i32 + TEXT;
        for column in from..right {
            let place = f64::from(column - from) / f64::from((right - from - 1).max(1));
            let [red, green, blue] = (self.colour)(place);
            let colour = RGBColor(red, green, blue);
            root.draw(&PathElement::new([(column, BAR[0]), (column, BAR[1])], colour))?;
        }
        let below = font.pos(Pos::new(HPos::Center, VPos::Top));
        let [low, high] = self.ends;
        for place in [0.0, 0.25, 0.5, 0.75, 1.0] {
            let column = from + (f64::from(right - from - 1) * place) as i32;
            root.draw(&PathElement::new(
                [(column, BAR[1]), (column, BAR[1] + TICK)],
                INK.stroke_width(3),
            ))?;
            let number = numbers::tick(numbers::round_significant(low + (high - low) * place, 3));
            root.draw(&Text::new(number, (column, BAR[1] + 2 * TICK), below.clone()))?;
        }
        Ok(())
    }
}
