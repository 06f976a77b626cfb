//! A scale of colours, and its bar beside a picture.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::margins::{INK, RIGHT, TEXT, TOP, WIDTH};
use crate::report::numbers;

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

    /// The bar, right of a picture of this height and as high as it.
    pub fn draw<'a>(
        &self,
        root: &DrawingArea<BitMapBackend<'a>, Shift>,
        height: i32,
    ) -> Result<(), DrawingAreaErrorKind<<BitMapBackend<'a> as DrawingBackend>::ErrorType>> {
        let font = ("sans-serif", TEXT).into_font().color(&INK);
        let (left, right, top) = ((WIDTH - RIGHT) as i32 + 45, (WIDTH - RIGHT) as i32 + 97, TOP as i32);
        let (from, to) = (top + 84, top + height - TEXT / 2);
        for row in from..to {
            let place = 1.0 - f64::from(row - from) / f64::from((to - from - 1).max(1));
            let [red, green, blue] = (self.colour)(place);
            let colour = RGBColor(red, green, blue);
            root.draw(&PathElement::new([(left, row), (right, row)], colour))?;
        }
        root.draw(&Text::new(self.label, (left - 10, top - 3), font.clone()))?;
        let centred = font.pos(Pos::new(HPos::Left, VPos::Center));
        let [low, high] = self.ends;
        for place in [0.0, 0.25, 0.5, 0.75, 1.0] {
            let row = to - 1 - (f64::from(to - from - 1) * place) as i32;
            root.draw(&PathElement::new(
                [(right, row), (right + 11, row)],
                INK.stroke_width(3),
            ))?;
            let number = numbers::tick(numbers::round_significant(low + (high - low) * place, 3));
            root.draw(&Text::new(number, (right + 22, row), centred.clone()))?;
        }
        Ok(())
    }
}
